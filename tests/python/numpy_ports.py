"""Ports of passes in NumPy, right ones and wrong ones: examples/python/wave_step.py has the formula."""

import sys
from pathlib import Path

import numpy as np

import rainref as rr

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples/python"))
from wave_step import wave_step  # noqa: E402


def beyond(case):
    sampling = case.sampling("wave")
    return sampling.address[0], sampling.border[0]


@rr.port("puddle.wave_step")
def right(i, u, case):
    return wave_step(i, u, beyond(case))


@rr.port("puddle.wave_step")
def levels_exchanged(i, u, case):
    i.wave = i.wave[..., ::-1]
    return wave_step(i, u, beyond(case))


@rr.port("puddle.wave_step")
def zeros(i, u):
    return np.zeros_like(i.wave)
