"""Views of buffers without a copy. Each is valid until its simulation continues."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin

from .errors import StaleViewError

if TYPE_CHECKING:
    from .buffers import Place
    from .simulation import Simulation

#: Attributes of an array that expose its memory.
_LOOKS = ("base", "data", "flat")


class View(NDArrayOperatorsMixin):
    """A view of a buffer without a copy, which is used like a read-only array. Once its simulation continues, any use of the view or of its
    slices raises StaleViewError.

    It is not a `numpy.ndarray`, because an ndarray gives out its memory and cannot be invalidated. Operators and NumPy's functions compute
    on the buffer itself. Functions that would keep the memory get a copy: `numpy.array`, `numpy.asarray`, `bytes`, `copy.copy`,
    `memoryview` (from Python 3.12 on; a TypeError before), and functions that would return another view, such as `numpy.flip`. C code may
    use the address `view.ctypes.data`, whose validity is not checked.
    """

    def __init__(self, now: Simulation, then: int, place: Place) -> None:
        self._now, self._then, self._place = now, then, place

    def _plain(self) -> np.ndarray:
        """Returns an array that views the buffer. Only one operation may use it."""
        if self._now.changes != self._then:
            raise StaleViewError("a view of a buffer is valid until its simulation goes on: take a copy to keep it")
        return self._place.array()

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> np.ndarray:
        plain = self._plain()
        if copy is False:
            raise ValueError("a view of a buffer cannot become an array without a copy, which its simulation could not end")
        return plain.astype(plain.dtype if dtype is None else dtype)

    def __buffer__(self, flags: int) -> memoryview:
        return memoryview(self._plain().copy())  # type: ignore[arg-type]

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **keywords: Any) -> Any:
        return _computed(getattr(ufunc, method), inputs, keywords)

    def __array_function__(self, function: Callable[..., Any], types: Any, arguments: Any, keywords: Any) -> Any:
        return _computed(function, arguments, keywords)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)  # such as __array_interface__, which holds addresses
        plain = self._plain()
        found = getattr(plain.copy() if name in _LOOKS else plain, name)
        if not callable(found):
            return found.copy() if isinstance(found, np.ndarray) else found
        return lambda *arguments, **keywords: _computed(lambda array, *rest, **more: getattr(array, name)(*rest, **more), (self, *arguments), keywords)

    def __setattr__(self, name: str, value: Any) -> None:
        if not name.startswith("_"):
            raise AttributeError(f"'{name}' of a view of a buffer cannot be set: take a copy")
        super().__setattr__(name, value)

    def __getitem__(self, key: Any) -> Any:
        plain = self._plain()
        found = plain[_computed(lambda own: own, (key,), {})]
        if not isinstance(found, np.ndarray) or not np.may_share_memory(found, plain):
            return found
        offset = self._place.offset + found.ctypes.data - plain.ctypes.data
        return View(self._now, self._then, dataclasses.replace(self._place, shape=found.shape, strides=found.strides, offset=offset))

    def __iter__(self) -> Iterator[Any]:
        return (self[i] for i in range(len(self)))

    def __len__(self) -> int:
        return len(self._plain())

    def __contains__(self, value: Any) -> bool:
        return value in self._plain()

    def __bool__(self) -> bool:
        return bool(self._plain())

    def __float__(self) -> float:
        return float(self._plain())

    def __int__(self) -> int:
        return int(self._plain())

    def __bytes__(self) -> bytes:
        return self._plain().tobytes()

    def __reduce__(self) -> Any:
        return self._plain().copy().__reduce__()

    def __repr__(self) -> str:
        return f"View({self._plain()!r})"

    def __str__(self) -> str:
        return str(self._plain())

    def __format__(self, how: str) -> str:
        return format(self._plain(), how)

    def __dir__(self) -> list[str]:
        return [name for name in dir(np.ndarray) if not name.startswith("_")]


def _computed(function: Callable[..., Any], arguments: Any, keywords: dict[str, Any]) -> Any:
    """Checks the views among the arguments, and calls function(...) with plain arrays in their place. A result that views their memory is
    copied."""
    looked: list[np.ndarray] = []

    def plain(value: Any) -> Any:
        if isinstance(value, View):
            looked.append(value._plain())
            return looked[-1]
        return type(value)(map(plain, value)) if type(value) in (tuple, list) else value

    def own(result: Any) -> Any:
        if isinstance(result, np.ndarray):
            return result.copy() if any(np.may_share_memory(result, array) for array in looked) else result
        return type(result)(map(own, result)) if type(result) in (tuple, list) else result

    return own(function(*plain(tuple(arguments)), **{name: plain(value) for name, value in keywords.items()}))
