"""A puddle from Python, cell by cell as in a notebook: render it, measure its waves against theory, judge two ports of them.

Run: python3 examples/python/waves.py [FOLDER]   (pictures into FOLDER where Matplotlib is there)
"""

# %% Render.
import sys
from pathlib import Path

import numpy as np

import rainref as rr
from wave_step import impulse

OUT = Path(sys.argv[1]) if len(sys.argv) > 1 else None
sim = rr.open("puddle", {"run.size": (160, 90), "rain.rate": 40, "puddle.grid": (192, 128), "environment.width": 256})
for frame in sim.frames(30):
    pass
print(sim, "rain", sim.parameters["rain.rate"].value, sim.parameters["rain.rate"].unit)
if OUT:
    sim.write_png(OUT / "puddle.png")

# %% Measure the waves' dispersion. One step of the wave is one frame here; a torus of water has plane waves as its modes.
SIDE, STEPS = 128, 400
sim = rr.open("puddle", {
    "run.size": (8, 8), "environment.width": 64, "run.fps": 240.0, "puddle.step_rate": 240.0, "puddle.grid": (SIDE, SIDE), "puddle.shape": "basin",
    "puddle.boundary": "periodic", "puddle.storage": "rg32f", "puddle.damping": 0.99, "puddle.drop_intensity": 4, "rain.rate": 20})
value = {key: sim.parameters[f"puddle.{key}"].value for key in ("wave_speed", "step_rate", "cell_size")}
courant = value["wave_speed"] / value["step_rate"] / value["cell_size"]

# Each step obeys U(n+1) = a U(n) - b U(n-1) in every mode U(k). Drops are added to both levels of a step alike, so that the levels of the
# step before and these two belong together where none fell: previous level now == newest level then. Least squares give a and b.
normal, right, used, before = np.zeros((2, 2, SIDE, SIDE)), np.zeros((2, SIDE, SIDE)), 0, None
for frame in sim.frames(STEPS):
    wave = frame["wave"].astype(float)
    if before is not None and np.array_equal(wave[..., 1], before[..., 0]):
        now, here, past = (np.fft.fft2(level) for level in (wave[..., 0], before[..., 0], before[..., 1]))
        for i, x in enumerate((here, -past)):
            right[i] += (x.conj() * now).real
            for j, y in enumerate((here, -past)):
                normal[i, j] += (x.conj() * y).real
        used += 1
    before = wave
a, b = np.linalg.solve(np.moveaxis(normal, (0, 1), (-2, -1)), np.moveaxis(right, 0, -1)[..., None])[..., 0].transpose(2, 0, 1)

# Theory: a is 2 sqrt(gamma) cos w and b is gamma, the energy kept in a step. The five-point Laplacian has
# cos w = (1 + gamma) (1 - C^2 (2 - cos kx - cos ky)) / (2 sqrt gamma) for the angle w of a step; water this shallow has w = c k dt.
k = 2 * np.pi * np.fft.fftfreq(SIDE)
kx, ky = np.meshgrid(k, k)
gamma = 0.99 ** (60 / value["step_rate"])  # puddle.damping is of 1/60 s


def angle(kx, ky):
    return np.arccos(np.minimum(1, (1 + gamma) * (1 - courant**2 * (2 - np.cos(kx) - np.cos(ky))) / (2 * np.sqrt(gamma))))


of_theory, measured = angle(kx, ky), np.arccos(np.clip(a / (2 * np.sqrt(np.abs(b))), -1, 1))
length = np.hypot(kx, ky)
strong = (length > 0.1) & (length < 1.2) & (normal[0, 0] > 1e-6 * normal[0, 0].max())  # waves of 5 to 60 cells, which drops excite
error = np.abs(measured - of_theory)[strong] / of_theory[strong]
speed = measured / np.maximum(length, 1e-9) / courant  # in units of the wave speed
print(f"dispersion: {used} steps without a drop, {strong.sum()} waves of 5 to 60 cells; phase speed {speed[strong].min():.3f} to "
      f"{speed[strong].max():.3f} of the wave speed; off the theory by {100 * np.median(error):.4f} % in the median, {100 * error.max():.3f} % at most; "
      f"energy kept in a step {np.median(b[strong]):.6f}, theory {gamma:.6f}")
assert used > 50 and strong.sum() > 500 and error.max() < 1e-3 and abs(np.median(b[strong]) - gamma) < 1e-5

try:
    from matplotlib import pyplot
except ImportError:
    pyplot = None
if OUT and pyplot:
    figure, axes = pyplot.subplots()
    axes.plot(length[strong], speed[strong], ".", ms=3, label="measured")
    along = np.linspace(0.1, 1.2)
    for name, x, y in (("theory, along a row", along, 0 * along), ("theory, diagonal", along / 2**0.5, along / 2**0.5)):
        axes.plot(along, angle(x, y) / along / courant, label=name)
    axes.set(xlabel="wave number [rad/cell]", ylabel="phase speed [wave speed]")
    axes.legend()
    figure.savefig(OUT / "dispersion.png")

# %% Judge ports of a wave step: in Numba where it is there, else in plain Python loops over rows.
try:
    from numba import njit
except ImportError:
    def njit(function):
        return function

F = np.float32


@njit
def wave_step(wave, impulse, shore, damping, courant_sq, rest, centre):
    """docs/effects/puddle.md, on water with reflecting edges. `centre` is the Laplacian's weight of the texel itself."""
    height, width = shore.shape
    out = np.empty((height, width, 2), np.float32)
    for y in range(height):
        for x in range(width):
            here = wave[y, x, 0]
            around = (wave[y, max(x - 1, 0), 0] + wave[y, min(x + 1, width - 1), 0] + wave[max(y - 1, 0), x, 0]
                      + wave[min(y + 1, height - 1), x, 0])
            new = here + damping * (here - wave[y, x, 1]) + courant_sq * (around - centre * here) + impulse[y, x]
            out[y, x, 0] = rest + shore[y, x] * (new - rest)
            out[y, x, 1] = here + shore[y, x] * impulse[y, x]
    return out


def computed(i, u, centre):
    shape = i.wave.shape[:2]
    shore = i.shore if "shore" in vars(i) else np.ones(shape, F)
    return wave_step(i.wave.astype(F), impulse(i.drops, shape), shore, u.damping, u.courant_sq, u.rest, F(centre))


@rr.port("puddle.wave_step")
def right_port(i, u):
    return computed(i, u, 4)


@rr.port("puddle.wave_step")
def wrong_port(i, u):
    return computed(i, u, 3.9)  # a constant that looks harmless


scene = {"effect": "puddle", "run.size": (64, 36), "environment.width": 64, "puddle.grid": (96, 64), "rain.rate": 60}
good = rr.judge(rr.open(scene), right_port, frames=(2, 6))
bad = rr.judge(rr.open(scene), wrong_port, frames=(2, 6))
print(good)
print(bad)
worst = bad["wave_step"].worst[0]
print(f"worst: got {worst.got:.6g} m where {worst.low:.6g} to {worst.high:.6g} m is accepted, at {worst.x}, {worst.y} of {worst.case}")
assert good.status == "PASS" and bad.status == "FAIL" and not worst.low <= worst.got <= worst.high
if OUT:
    bad.html(OUT / "verdict.html")
