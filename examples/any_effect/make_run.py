#!/usr/bin/env python3
"""Writes a user's run of both effects: what the host hands to each pass in each frame.

python3 make_run.py RUN        makes RUN/<effect>.<pass>/<frame>.<step>/uniforms.bin and in.<input>[.L<level>].npy

A real program would dump these from its own frames. Here they are made of whole numbers, sums, products and quotients, which round alike
everywhere, so that the data have the same bytes on every machine.
"""
import pathlib
import struct
import sys

import numpy as np

FRAMES = 4


def write(case, uniforms, inputs):
    """One run of a pass. `inputs`: from a name to an array, or to the list of an image's mip levels."""
    case.mkdir(parents=True, exist_ok=True)
    (case / "uniforms.bin").write_bytes(uniforms)
    for name, levels in inputs.items():
        for level, array in enumerate(levels if isinstance(levels, list) else [levels]):
            np.save(case / (f"in.{name}.L{level}.npy" if level else f"in.{name}.npy"), array)


def number(x, y, salt):
    """A number from 0 to 65535 for two whole numbers from 0 on (or arrays of them): an integer hash."""
    word = (x * 73856093 + y * 19349663 + salt * 83492791) & 0xffffffff
    for _ in range(2):
        word = (word ^ (word >> 15)) * 0x2c1b3c6d & 0xffffffff
    return (word >> 8) & 0xffff


def mip_levels(image, count):
    """8 bits a channel; each level the rounded mean of 2 x 2 texels of the one before, a last odd row or column left out."""
    levels = [image]
    while len(levels) < count:
        last = levels[-1].astype(np.uint32)
        rows, columns = last.shape[0] // 2 * 2, last.shape[1] // 2 * 2
        total = sum(last[j:rows:2, i:columns:2] for j in (0, 1) for i in (0, 1))
        levels.append(((total + 2) // 4).astype(np.uint8))
    return levels


# ---- fogged_glass ----

PANE = 61, 37  # columns, rows
FOG_DROP = np.dtype([("position", "<f4", (2,)), ("velocity", "<f4", (2,)), ("radius", "<f4"), ("strength", "<f4")])


def night_street(columns, rows):
    """What lies behind the pane: an evening sky over a row of houses with lit windows, and a wet road."""
    y, x = np.indices((rows, columns), np.int64)
    image = np.empty((rows, columns, 4), np.uint8)
    sky = y * 70 // rows
    image[..., 0], image[..., 1], image[..., 2], image[..., 3] = 24 + sky, 34 + sky, 74 + sky // 2, 255
    house = x // 12
    roof = rows * 5 // 16 + number(house, 0, 1) % 9
    road = rows * 3 // 4
    walls = (y >= roof) & (y < road)
    for channel, (base, spread) in enumerate(((40, 24), (30, 16), (28, 20))):
        image[..., channel][walls] = (base + number(house, 0, 2 + channel) % spread)[walls]
    lit = walls & (x % 4 >= 1) & (x % 4 <= 2) & (y % 6 >= 2) & (y % 6 <= 4) & (number(x // 4, y // 6, 5) % 3 > 0)
    image[lit, :3] = 250, 196, 108
    image[y >= road, :3] = 34, 36, 44
    for k in range(7):  # lamps of cars, and their light on the road
        column, row = int(number(k, 0, 6)) % (columns - 3), road + 2 + int(number(k, 1, 7)) % 4
        colour = (236, 44, 36) if k % 2 else (246, 244, 216)
        image[row:row + 2, column:column + 3, :3] = colour
        image[row + 3:row + 8, column:column + 3, :3] = [value // 2 for value in colour]
    return image


def slides():
    """Of each frame its drops. Each slides down by its own whole velocity in texels a frame; the last but one rests, the last is none."""
    # column, first row, velocity right and down, radius (all in quarters of a texel), strength in eighths
    drops = [(42, 24, 2, 26, 13, 8), (95, -8, -3, 31, 15, 8), (141, 40, 1, 18, 11, 7), (190, 4, 4, 28, 17, 8), (220, 70, -2, 12, 8, 6),
             (118, 88, 0, 0, 12, 8), (30, 100, 0, 0, 0, 8)]
    for frame in range(FRAMES):
        records = np.zeros(len(drops), FOG_DROP)
        for record, (x, y, right, down, radius, strength) in zip(records, drops):
            record["position"] = (x + right * (frame + 1)) / 4, (y + down * (frame + 1)) / 4
            record["velocity"] = right * 2, down * 2  # texels a second: a frame takes 1/8 s
            record["radius"], record["strength"] = radius / 4, strength / 8
        yield records


def fogged_glass(run):
    columns, rows = PANE
    y, x = np.indices((rows, columns), np.int64)
    breath = 0.75 + number(x // 3, y // 3, 8) / 65536 / 8 + number(x, y, 9) / 65536 / 16  # patches, and grain
    first_fog = breath.astype("<f4")
    street = mip_levels(night_street(96, 58), 4)
    for frame, drops in enumerate(slides()):
        step = f"{frame:04d}.0"
        fog = struct.pack("<3fi4f", 0.125, 4.0, 1.5, len(drops), 0.75, 0.96875, 0.625, 0.0)
        shade = struct.pack("<3fi4f", 3.0, 3.5, 0.375, len(drops), 0.3125, 0.34375, 0.40625, 0.625)
        write(run / "fogged_glass.fog" / step, fog, {"drops": drops, **({"fog": first_fog} if frame == 0 else {})})
        write(run / "fogged_glass.shade" / step, shade, {"background": street, "drops": drops})


# ---- caustics ----

BASIN = 64, 40  # columns, rows
WAVE_DROP = np.dtype([("position", "<f4", (2,)), ("radius", "<f4"), ("depth", "<f4")])


def rainy_water(columns, rows, steps):
    """Height and velocity after some seconds of rain, in steps of 1/4096 texel: waves for the first frame to go on with."""
    y, x = np.indices((rows, columns)) + 0.5
    height, velocity = np.zeros((2, rows, columns))
    for step in range(steps):
        around = np.pad(height, 1, mode="edge")
        mean = (around[1:-1, :-2] + around[1:-1, 2:] + around[:-2, 1:-1] + around[2:, 1:-1]) * 0.25
        velocity = (velocity + (mean - height)) * 0.984375
        height = height + velocity
        if step % 6 == 0:
            column, row = int(number(step, 0, 10)) % (4 * columns) / 4, int(number(step, 1, 11)) % (4 * rows) / 4
            q = np.minimum(((x - column) * (x - column) + (y - row) * (y - row)) / 30.0, 1.0)
            height = height - 1.75 * (1.0 - q) * (1.0 - q)
    return (np.rint(np.stack([height, velocity], axis=2) * 4096) / 4096).astype("<f4")


def tile(side):
    """One tile: mottled blue, with a light joint along two of its sides."""
    y, x = np.indices((side, side), np.int64)
    grain = number(x // 2, y // 2, 12) % 28
    image = np.stack([36 + grain, 84 + grain, 106 + grain, np.full_like(grain, 255)], axis=2)
    image[(x == 0) | (y == 0)] = 142, 148, 140, 255
    return image.astype(np.uint8)


def caustics(run):
    falls = [[(20.5, 11.25, 4.5, 1.0), (49.75, 30.5, 3.0, 0.75)], [(35.0, 22.5, 5.25, 1.25)],
             [(9.25, 33.0, 3.5, 0.875), (57.5, 6.75, 4.0, 1.0), (30.25, 3.5, 2.75, 0.5)], [(44.0, 16.25, 4.0, 1.125)]]
    assert len(falls) == FRAMES
    for frame, drops in enumerate(falls):
        step = f"{frame:04d}.0"
        wave = struct.pack("<3fi", 1.0, 0.9375, 1 / 64, len(drops))
        rays = struct.pack("<8f", 2 / 7, -3 / 7, 6 / 7, 10.0, 1.333, 0.125, 0.0, 0.0)
        floor = struct.pack("<11fi", 0.03125, 0.0078125, 0.005859375, 10.0, -2.25, 3.5, 11.0, 0.125, 0.625, 0.75, 0.875, 3)
        falling = np.array([((x, y), radius, depth) for x, y, radius, depth in drops], WAVE_DROP)
        write(run / "caustics.wave" / step, wave, {"drops": falling, **({"wave": rainy_water(*BASIN, 90)} if frame == 0 else {})})
        write(run / "caustics.caustics" / step, rays, {})
        write(run / "caustics.floor" / step, floor, {"tiles": tile(16)})


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: python3 make_run.py RUN")
    fogged_glass(pathlib.Path(sys.argv[1]))
    caustics(pathlib.Path(sys.argv[1]))
