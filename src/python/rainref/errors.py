"""What goes wrong."""

from __future__ import annotations

import difflib
from collections.abc import Iterable


class Error(ValueError):
    """An argument, a scene, a file or a port's output that cannot be used; the message is for the user.

    `code` is that of the command line: 2 usage, 3 a pack or a port's outputs, 4 files, 5 a defect of rainref.
    """

    def __init__(self, message: str, code: int = 2) -> None:
        super().__init__(message)
        self.code = code


class FileError(Error, OSError):
    """A file that cannot be read or written (code 4)."""

    def __str__(self) -> str:
        return str(self.args[0])


class StaleViewError(Error):
    """A view of a buffer that was used after its simulation went on."""


def error_of(code: int, message: str) -> Error:
    """The exception of a code of the C library."""
    return FileError(message, code) if code == 4 else Error(message, code)


def nearest(wrong: str, names: Iterable[str]) -> str:
    """ "; did you mean 'x'?" for the nearest name, or "" where none is near."""
    near = difflib.get_close_matches(wrong, list(names), 1)
    return f"; did you mean '{near[0]}'?" if near else ""


def unknown(what: str, wrong: str, names: Iterable[str]) -> Error:
    """The error for a name that is none of those known, with the nearest.

    >>> str(unknown("a pass", "displya", ["shade", "display"]))
    "'displya' is not a pass; did you mean 'display'?"
    """
    return Error(f"'{wrong}' is not {what}" + (nearest(wrong, names) or f": expected one of {', '.join(names)}"))
