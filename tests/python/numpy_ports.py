"""Ports of passes in NumPy, written from docs/effects/puddle.md: right ones and wrong ones."""

import numpy as np

import rainref as rr

F = np.float32


def impulse(drops, shape):
    """Heights that drops add: craters (1 - q^2)^2 (1 - 4 q^2)."""
    x = np.arange(shape[1], dtype=F) + F(0.5)
    y = np.arange(shape[0], dtype=F)[:, None] + F(0.5)
    out = np.zeros(shape, F)
    for d in drops:
        s = ((x - d["x"]) / d["radius"]) ** 2 + ((y - d["y"]) / d["radius"]) ** 2
        out += d["amplitude"] * np.maximum(1 - s, 0) ** 2 * (1 - 4 * s)
    return out


def beyond_the_edge(level, sampling):
    """A level with one more texel around it, as the address rule has it."""
    how = {"clamp": {"mode": "edge"}, "repeat": {"mode": "wrap"}, "border": {"mode": "constant", "constant_values": sampling.border[0]}}
    return np.pad(level, 1, **how[sampling.address[0]])


def step(here, previous, i, u, case):
    """The next level and what becomes the previous one."""
    p = beyond_the_edge(here, case.sampling("wave"))
    laplacian = p[1:-1, :-2] + p[1:-1, 2:] + p[:-2, 1:-1] + p[2:, 1:-1] - 4 * here
    add = impulse(i.drops, here.shape)
    shore = i.shore if "shore" in vars(i) else F(1)
    new = here + u.damping * (here - previous) + u.courant_sq * laplacian + add
    return np.stack([u.rest + shore * (new - u.rest), here + shore * add], -1).astype(np.float16)


@rr.port("puddle.wave_step")
def right(i, u, case):
    here, previous = (i.wave[..., k].astype(F) for k in (0, 1))
    return step(here, previous, i, u, case)


@rr.port("puddle.wave_step")
def levels_exchanged(i, u, case):
    previous, here = (i.wave[..., k].astype(F) for k in (0, 1))
    return step(here, previous, i, u, case)


@rr.port("puddle.wave_step")
def zeros(i, u):
    return np.zeros_like(i.wave)
