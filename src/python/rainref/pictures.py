"""Showing buffers as pictures."""

from __future__ import annotations

import struct
import zlib

import numpy as np


def shown(array: np.ndarray) -> np.ndarray:
    """Converts an image for display: uint8 (height, width) or (height, width, 3), top row first.

    Display code stays as it is. Other values are scaled, so that the smallest is black and the largest white.

    >>> shown(np.array([[0.0, 1.0], [2.0, 4.0]]))
    array([[127, 255],
           [  0,  63]], dtype=uint8)
    """
    a = np.asarray(array)[::-1]
    if a.dtype == np.uint8:
        return a[..., :3] if a.ndim == 3 and a.shape[2] >= 3 else a
    a = (a[..., 0] if a.ndim == 3 and a.shape[2] < 3 else a[..., :3] if a.ndim == 3 else a).astype(np.float64)
    finite = a[np.isfinite(a)]
    low, high = (finite.min(), finite.max()) if finite.size else (0.0, 1.0)
    scaled = np.nan_to_num((a - low) / ((high - low) or 1.0), nan=0.0, posinf=1.0, neginf=0.0)
    return (255 * np.clip(scaled, 0, 1)).astype(np.uint8)


def png(pixels: np.ndarray) -> bytes:
    """Returns the bytes of a PNG of uint8 (height, width) or (height, width, 3), top row first.

    >>> png(np.zeros((1, 1), np.uint8))[1:4]
    b'PNG'
    """
    def chunk(kind: bytes, content: bytes) -> bytes:
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    height, width = pixels.shape[:2]
    rows = np.zeros((height, 1 + pixels[0].size), np.uint8)  # each row begins with its filter, which is none
    rows[:, 1:] = pixels.reshape(height, -1)
    head = struct.pack(">IIBBBBB", width, height, 8, 2 if pixels.ndim == 3 else 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows.tobytes())) + chunk(b"IEND", b"")


def show(array: np.ndarray, title: str = "") -> object:
    """Shows an image in a notebook or a window, with Matplotlib. Returns the axes."""
    from matplotlib import pyplot  # type: ignore[import]

    axes = pyplot.subplots()[1]
    axes.imshow(shown(array), cmap="gray", vmin=0, vmax=255)
    axes.set(title=title, xticks=[], yticks=[])
    return axes
