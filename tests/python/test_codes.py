"""8-bit codes against theory: each of the 256 codes, and the numbers on both sides of each bound between two codes."""

from decimal import Decimal, localcontext

import numpy as np
import pytest
from conftest import PUDDLE

import rainref as rr

CODES = np.arange(256)


def exact_srgb(light):
    """IEC 61966-2-1 with fifty digits."""
    with localcontext() as context:
        context.prec = 50
        return Decimal("12.92") * light if light <= Decimal("0.0031308") else Decimal("1.055") * light ** (1 / Decimal("2.4")) - Decimal("0.055")


def bound(encode, low, high):
    """The last float32 whose code is `low`, found by bisection of the bits of positive floats, which are in order."""
    a, b = (int(np.float32(x).view(np.uint32)) for x in (low, high))
    while b - a > 1:
        middle = (a + b) // 2
        if encode(np.uint32(middle).view(np.float32)) == encode(np.uint32(a).view(np.float32)):
            a = middle
        else:
            b = middle
    return np.uint32(a).view(np.float32), np.uint32(b).view(np.float32)


@pytest.mark.parametrize("encode, decode", [(rr.unorm8, rr.from_unorm8), (rr.srgb8, rr.from_srgb8)])
def test_every_code_is_its_own(encode, decode):
    numbers = decode(CODES)
    assert numbers.dtype == np.float32 and numbers[0] == 0 and numbers[255] == 1 and (np.diff(numbers) > 0).all()
    np.testing.assert_array_equal(encode(numbers), CODES)
    assert encode(numbers).dtype == np.uint8
    assert encode(0.5).shape == () and encode(np.zeros((2, 3, 4))).shape == (2, 3, 4)


@pytest.mark.parametrize("encode", [rr.unorm8, rr.srgb8])
def test_what_is_no_number_from_0_to_1(encode):
    np.testing.assert_array_equal(encode([-1, -0.0, 1.0000001, 7, np.inf, -np.inf, np.nan]), [0, 0, 255, 255, 255, 0, 0])


def test_unorm8_is_nearest():
    for k in range(255):
        below, above = bound(rr.unorm8, np.float32(k) / 255, np.float32(k + 1) / 255)
        # The product is rounded to a float32 first, so a number may lie half a step of that beyond the middle.
        slack = Decimal(float(np.spacing(np.float32(255 * above)))) / 2
        assert 255 * Decimal(float(below)) <= Decimal(k) + Decimal("0.5") + slack, k
        assert 255 * Decimal(float(above)) >= Decimal(k) + Decimal("0.5") - slack, k
        assert (rr.unorm8(below), rr.unorm8(above)) == (k, k + 1)
    # A tie goes to the even code: 127.5 exactly.
    assert rr.unorm8(0.5) == 128


def test_srgb8_is_nearest():
    light = rr.from_srgb8(CODES)
    for k in range(255):
        below, above = bound(rr.srgb8, light[k], light[k + 1])
        middle = (Decimal(k) + Decimal("0.5")) / 255
        assert exact_srgb(Decimal(float(below))) < middle < exact_srgb(Decimal(float(above))), k
        assert (rr.srgb8(below), rr.srgb8(above)) == (k, k + 1)


def test_the_library_takes_the_same_floats_for_the_same_codes(puddle):
    """Floats near each bound, given as a picture of the pass display, differ from the reference exactly where the codes of unorm8 do."""
    puddle.step()
    cases = rr.Cases.of_simulation(puddle)
    cases.add_next_frame(puddle, ["display"])
    codes = cases[0].expected["picture"]
    beyond = np.random.default_rng(1).choice([-0.5, -0.4999, 0, 0.4999, 0.5], codes.shape)
    floats = np.clip((codes + beyond) / 255, 0, 1).astype(np.float32)
    differing = int((rr.unorm8(floats) != codes).sum())
    again = rr.open("puddle", PUDDLE)
    again.step()
    verdict = rr.judge(again, {"display": lambda i, u: floats}, frames=[1])
    assert verdict["display"].differing == differing > 100
