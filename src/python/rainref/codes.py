"""8-bit codes, which images of the formats r8 to rgba8_srgb hold, and the numbers that they stand for.

A number is first rounded to float32 and clamped to 0..1; NaN gives code 0. The reference stores the same codes, and converts a port's
floats to them.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike


def _decoded(encoded: np.ndarray) -> np.ndarray:
    """Returns the light of an sRGB number from 0 to 1 by IEC 61966-2-1, in double."""
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


_LIGHT = _decoded(np.arange(256) / 255).astype(np.float32)
#: The light half-way between neighbouring codes, at (k + 1/2) / 255. No float32 is so near to one of these that the error of a double
#: matters.
_BETWEEN = _decoded((np.arange(255) + 0.5) / 255)


def _clamped(numbers: ArrayLike) -> np.ndarray:
    return np.clip(np.nan_to_num(np.asarray(numbers, np.float32), nan=0.0), np.float32(0), np.float32(1))


def unorm8(numbers: ArrayLike) -> np.ndarray:
    """Returns the uint8 codes of numbers from 0 to 1 in a linear format: 255 x as a float32, rounded to nearest, a tie to even.

    >>> unorm8([0.0, 0.5, 1.0, -3.0, np.nan])
    array([  0, 128, 255,   0,   0], dtype=uint8)
    """
    return np.rint(_clamped(numbers) * np.float32(255)).astype(np.uint8)


def srgb8(numbers: ArrayLike) -> np.ndarray:
    """Returns the uint8 codes of light from 0 to 1 in an sRGB format: 255 times the encoded number, rounded to nearest. For the alpha of
    rgba8_srgb use unorm8, because it is not encoded.

    >>> srgb8([0.0, 0.5, 1.0])
    array([  0, 188, 255], dtype=uint8)
    """
    return np.searchsorted(_BETWEEN, _clamped(numbers).astype(np.float64)).astype(np.uint8)


def from_unorm8(codes: ArrayLike) -> np.ndarray:
    """Returns code / 255 as float32, rounded once.

    >>> from_unorm8([0, 51, 255])
    array([0. , 0.2, 1. ], dtype=float32)
    """
    return np.asarray(codes, np.uint8).astype(np.float32) / np.float32(255)


def from_srgb8(codes: ArrayLike) -> np.ndarray:
    """Returns the light of sRGB codes as float32, rounded once from double.

    >>> from_srgb8([0, 188, 255])
    array([0.       , 0.5028865, 1.       ], dtype=float32)
    """
    return _LIGHT[np.asarray(codes, np.uint8)]
