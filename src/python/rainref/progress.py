"""Callables that follow the progress of long work."""

from __future__ import annotations

import contextlib
import ctypes as c
from collections.abc import Callable, Iterator
from typing import Optional

from ._library import PROGRESS
from .errors import Error

#: Called with how much is done, and the total. If it raises an exception, the work ends, the caller gets the exception, and no partial file
#: stays.
Progress = Optional[Callable[[int, int], object]]


@contextlib.contextmanager
def told(progress: Progress) -> Iterator[c.c_void_p]:
    """Yields the callable as rr_progress. An exception cannot pass through C, so an exception of the callable is raised again when the
    block ends."""
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
