"""Callables that are told how far long work is."""

from __future__ import annotations

import contextlib
import ctypes as c
from collections.abc import Callable, Iterator
from typing import Optional

from ._library import PROGRESS
from .errors import Error

#: Called with what is done and the total. An exception that it raises ends the work and reaches the caller; no partial file stays.
Progress = Optional[Callable[[int, int], object]]


@contextlib.contextmanager
def told(progress: Progress) -> Iterator[c.c_void_p]:
    """Yields the callable as rr_progress. It raises inside the block what the callable raised, because no exception passes through C."""
    raised: list[BaseException] = []

    def tell(_: object, done: int, of: int) -> int:
        try:
            progress(done, of)  # type: ignore[misc]  # is not called if there is none
        except BaseException as error:
            raised.append(error)
        return len(raised)

    callback = PROGRESS(tell)
    try:
        yield c.cast(callback, c.c_void_p) if progress else c.c_void_p()
    except Error:
        if raised:
            raise raised[0] from None
        raise
