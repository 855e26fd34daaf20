"""Arrays of the library as NumPy arrays.

An image has the shape (height, width) or (height, width, channels) and its storage type: float16, float32, uint32, or uint8 for codes. Row
0 is the bottom row of a picture. Records and uniform blocks are structured arrays; `rainref describe` lists the names of their fields.
"""

from __future__ import annotations

import ctypes as c
import dataclasses
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _structs as s
from ._library import Handle, call, decoded, encoded, filled
from .errors import Error
from .views import View

if TYPE_CHECKING:
    from .simulation import Simulation

_CHANNEL = {1: np.uint8, 2: np.uint8, 3: np.float16, 4: np.float32, 5: np.uint32, 6: np.int32}
_RECORDS = 7


def dtype_of(layout: int) -> np.dtype:
    """Returns the structured dtype of a layout."""
    about = filled("get_layout", s.LayoutInfo, layout)
    fields = []
    for i in range(about.members):
        m = filled("get_member", s.Member, layout, i)
        scalar = np.dtype(_CHANNEL[m.type])
        fields.append((decoded(m.name), scalar if m.components == 1 else (scalar, (m.components,)), m.offset))
    names, formats, offsets = zip(*fields)
    return np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": about.bytes})


@dataclasses.dataclass(frozen=True)
class Place:
    """Position of texels in the library's memory: `length` bytes from `address` on. The first texel is at `offset` in them."""

    address: int
    length: int
    owner: Handle
    dtype: np.dtype
    shape: tuple[int, ...]
    strides: tuple[int, ...]
    offset: int = 0

    def array(self) -> np.ndarray:
        """Returns a read-only view, which cannot be made writeable. It keeps the library's memory alive."""
        memory = (c.c_char * self.length).from_address(self.address)
        memory._owner = self.owner  # type: ignore[attr-defined]
        self.owner.looked_into[id(memory)] = memory
        # From the memoryview itself, ndarray would take the writeable memory behind it.
        unwriteable = np.frombuffer(memoryview(memory).toreadonly(), np.uint8)
        return np.ndarray(self.shape, self.dtype, unwriteable, self.offset, self.strides)  # type: ignore[arg-type]


def _place_of(raw: s.Array, plane: int, owner: Handle) -> Place:
    """Returns the position of a plane, with the shape (height, width, channels in the plane)."""
    scalar = np.dtype(_CHANNEL[raw.type])
    length = (raw.height - 1) * raw.row_bytes + raw.width * raw.texel_bytes
    shape = (raw.height, raw.width, raw.channels if raw.planes == 1 else 1)
    return Place(raw.plane[plane], length, owner, scalar, shape, (raw.row_bytes, raw.texel_bytes, scalar.itemsize))


def copy_of(raw: s.Array, owner: Handle) -> np.ndarray:
    """Returns a copy of an array."""
    if raw.type == _RECORDS:
        dtype = dtype_of(raw.layout)
        out = np.zeros(raw.width, dtype)
        if raw.width:
            c.memmove(out.ctypes.data, raw.plane[0], raw.width * dtype.itemsize)
        return out
    if raw.planes == 1:
        out = _place_of(raw, 0, owner).array().copy()
        return out[..., 0] if raw.channels == 1 else out
    out = np.zeros((raw.height, raw.width, raw.channels), _CHANNEL[raw.type])  # channels beyond the planes are 0
    for p in range(raw.planes):
        out[..., p] = _place_of(raw, p, owner).array()[..., 0]
    return out


def view_of(raw: s.Array, channel: int | None, handle: Handle, now: Simulation) -> View:
    """Returns a view that is valid until `now.changes` changes. If the channels lie in separate planes, `channel` must name one."""
    name = decoded(raw.name)
    if raw.type == _RECORDS:
        raise Error(f"{name}: records have no view, which the next frame could move; take a copy")
    if channel is None and raw.planes > 1:
        raise Error(f"{name}: its {raw.channels} channels lie apart; name one, channel=0")
    if channel is not None and not 0 <= channel < raw.channels:
        raise Error(f"{name}: expected a channel from 0 to {raw.channels - 1}, found {channel}")
    if channel is not None and 1 < raw.planes <= channel:
        raise Error(f"{name}: channel {channel} is 0 everywhere and is not kept; expected one from 0 to {raw.planes - 1}")
    view = View(now, now.changes, _place_of(raw, 0 if raw.planes == 1 else channel or 0, handle))
    return view if channel is None and raw.channels > 1 else view[..., (channel or 0) if raw.planes == 1 else 0]


#: Texel types (rr_type) accepted from ports. Doubles are converted to floats.
_GIVEN = {np.dtype(kind): number for number, kind in _CHANNEL.items() if number in (1, 3, 4, 5)}


def image_given(array: np.ndarray, like: s.Array, place: str) -> tuple[s.Array, np.ndarray]:
    """Returns a port's image as rr_give_image takes it, and the rows that it points to. It keeps surplus channels and floats, because the
    library handles them."""
    rows = np.asarray(array)
    shape = (like.height, like.width) + ((like.channels,) if like.channels > 1 else ())
    texels = rows[..., np.newaxis] if rows.ndim == 2 else rows
    if texels.ndim != 3 or texels.shape[:2] != shape[:2] or not like.channels <= texels.shape[2] <= 4:
        raise Error(f"{place}: expected the shape {shape}, found {rows.shape}")
    own = np.dtype(_CHANNEL[like.type])
    if texels.dtype.kind == "f":
        texels = texels.astype(own if own.kind == "f" else np.float32, copy=False)
    if texels.dtype not in _GIVEN:
        raise Error(f"{place}: expected {own}{'' if own.kind == 'f' else ' or floats'}, found {texels.dtype}")
    texels = np.ascontiguousarray(texels)
    height, width, channels = texels.shape
    pixel = channels * texels.itemsize
    return s.Array.new(type=_GIVEN[texels.dtype], channels=channels, width=width, height=height, planes=1, texel_bytes=pixel,
                       row_bytes=width * pixel, plane=(c.c_void_p * 4)(texels.ctypes.data)), texels


def records_given(array: np.ndarray, like: np.dtype, place: str) -> np.ndarray:
    """Returns a port's list of records as contiguous memory."""
    records = np.asarray(array)
    if records.ndim != 1 or records.dtype != like:
        raise Error(f"{place}: expected a list of {like}, found the shape {records.shape} of {records.dtype}")
    return np.ascontiguousarray(records)


def buffer_of(simulation: object, name: str) -> s.Array:
    """Returns what rr_get_buffer returns for a buffer."""
    raw = s.Array.new()
    call("get_buffer", simulation, encoded(name), c.byref(raw))
    return raw
