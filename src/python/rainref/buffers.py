"""Arrays of the library as NumPy arrays.

An image is (height, width) or (height, width, channels), row 0 the bottom one of pictures, in its storage type: float16, float32, uint32,
or uint8 codes. Records and uniform blocks are structured arrays with the names of `rainref describe`.
"""

from __future__ import annotations

import ctypes as c
from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _structs as s
from ._library import Handle, call, decoded, encoded, filled
from .errors import Error, StaleViewError

if TYPE_CHECKING:
    from .simulation import Simulation

_CHANNEL = {1: np.uint8, 2: np.uint8, 3: np.float16, 4: np.float32, 5: np.uint32, 6: np.int32}
_RECORDS = 7


def dtype_of(layout: int) -> np.dtype:
    """The structured dtype of a layout; each field's title says its unit and what it is."""
    about = filled("get_layout", s.LayoutInfo, layout)
    fields = []
    for i in range(about.members):
        m = filled("get_member", s.Member, layout, i)
        scalar = np.dtype(_CHANNEL[m.type])
        fields.append((decoded(m.name), scalar if m.components == 1 else (scalar, (m.components,)), m.offset))
    names, formats, offsets = zip(*fields)
    return np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": about.bytes})


def _at(address: int, length: int, owner: Handle) -> c.Array[c.c_char]:
    memory = (c.c_char * length).from_address(address)
    memory._owner = owner  # type: ignore[attr-defined]  # alive as long as an array looks into it
    owner.looked_into[id(memory)] = memory
    return memory


def plane_of(raw: s.Array, plane: int, owner: Handle) -> np.ndarray:
    """A plane without a copy: (height, width, channels of it), not writeable."""
    channels = raw.channels // raw.planes
    scalar = np.dtype(_CHANNEL[raw.type])
    length = (raw.height - 1) * raw.row_bytes + raw.width * raw.texel_bytes
    array: np.ndarray = np.ndarray((raw.height, raw.width, channels), scalar, _at(raw.plane[plane], length, owner), 0,  # type: ignore[arg-type]
                       (raw.row_bytes, raw.texel_bytes, scalar.itemsize))
    array.flags.writeable = False
    return array


def copy_of(raw: s.Array, owner: Handle) -> np.ndarray:
    """An array of its own."""
    if raw.type == _RECORDS:
        dtype = dtype_of(raw.layout)
        out = np.zeros(raw.width, dtype)
        if raw.width:
            c.memmove(out.ctypes.data, raw.plane[0], raw.width * dtype.itemsize)
        return out
    planes = [plane_of(raw, p, owner) for p in range(raw.planes)]
    out = np.concatenate(planes, -1) if len(planes) > 1 else planes[0].copy()
    return out[..., 0] if raw.channels == 1 else out


class View(np.ndarray):
    """A look at a buffer without a copy. Once its simulation has gone on, whatever is done with it raises StaleViewError; so does what was
    sliced from it. `numpy.asarray(view)` and C code take the address once and cannot be told: hand them `view.copy()`."""

    _now: object
    _then: int

    def __array_finalize__(self, origin: object) -> None:
        if isinstance(origin, View) and not self.flags.owndata:  # a copy is never stale
            object.__getattribute__(self, "__dict__").update(object.__getattribute__(origin, "__dict__"))

    def _check(self) -> None:
        read = object.__getattribute__
        try:
            now, then = read(self, "_now"), read(self, "_then")
        except AttributeError:
            return  # NumPy is making it
        if now.changes != then:
            raise StaleViewError("a view of a buffer is valid until its simulation goes on: take a copy to keep it")

    def __getattribute__(self, name: str) -> object:
        if not name.startswith("_"):
            View._check(self)
        return object.__getattribute__(self, name)

    def __getitem__(self, key: Any) -> Any:
        self._check()
        return super().__getitem__(key)

    def __iter__(self) -> Any:
        self._check()
        return super().__iter__()

    def __repr__(self) -> str:
        self._check()
        return super().__repr__()

    def __str__(self) -> str:
        self._check()
        return super().__str__()

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: object, **others: object) -> object:
        return getattr(ufunc, method)(*_plain(inputs), **{k: _plain(v) if isinstance(v, tuple) else v for k, v in others.items()})

    def __array_function__(self, function: Callable[..., Any], types: Iterable[type], arguments: Iterable[Any], others: Mapping[str, Any]) -> Any:
        return function(*_plain(tuple(arguments)), **{k: _plain((v,))[0] for k, v in others.items()})


def _plain(values: tuple | list) -> tuple:
    """The same with plain arrays in place of views, which are checked."""

    def one(value: Any) -> Any:
        if isinstance(value, View):
            value._check()
            return value.view(np.ndarray)
        return type(value)(_plain(value)) if type(value) in (tuple, list) else value

    return tuple(one(v) for v in values)


def view_of(raw: s.Array, channel: int | None, handle: Handle, now: Simulation) -> View:
    """A view that `now.changes` ends. Of an image whose channels lie apart one channel must be named."""
    name = decoded(raw.name)
    if raw.type == _RECORDS:
        raise Error(f"{name}: records have no view, which the next frame could move; take a copy")
    if channel is None and raw.planes > 1:
        raise Error(f"{name}: its {raw.channels} channels lie apart; name one, channel=0")
    if channel is not None and not 0 <= channel < raw.channels:
        raise Error(f"{name}: expected a channel from 0 to {raw.channels - 1}, found {channel}")
    own = raw.channels // raw.planes
    plain = plane_of(raw, 0 if channel is None else channel // own, handle)
    if channel is not None or raw.channels == 1:
        plain = plain[..., (channel or 0) % own]
    view = plain.view(View)
    object.__setattr__(view, "_now", now)
    object.__setattr__(view, "_then", now.changes)
    return view


def given(array: np.ndarray, like: np.ndarray, place: str) -> np.ndarray:
    """A port's output as the buffer stores it, rows without padding.

    Floats become the buffer's floats, to nearest even; codes and integers must have its type.
    """
    array = np.asarray(array)
    is_record = like.dtype.names is not None
    if array.shape != like.shape and not (is_record and array.ndim == 1):
        if array.ndim == 3 and array.shape[2:] == (1,) and array.shape[:2] == like.shape:
            array = array[..., 0]
        else:
            raise Error(f"{place}: expected the shape {like.shape}, found {array.shape}")
    is_float = array.dtype.kind == "f" and like.dtype.kind == "f"
    if array.dtype != like.dtype and not is_float:
        raise Error(f"{place}: expected {like.dtype}, found {array.dtype}")
    return np.ascontiguousarray(array, like.dtype)


def buffer_of(simulation: object, name: str) -> s.Array:
    """What rr_get_buffer says of a buffer."""
    raw = s.Array.new()
    call("get_buffer", simulation, encoded(name), c.byref(raw))
    return raw
