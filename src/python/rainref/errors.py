"""The exceptions of rainref."""

from __future__ import annotations

import difflib
from collections.abc import Iterable


class Error(ValueError):
    """An argument, scene, file or output of a port cannot be used. The message is for the user.

    `code` is the exit code of the command line: 2 usage, 3 a pack or a port's outputs, 4 files, 5 a defect of rainref.
    """

    def __init__(self, message: str, code: int = 2) -> None:
        super().__init__(message)
        self.code = code


class FileError(Error, OSError):
    """A file cannot be read or written (code 4)."""

    def __str__(self) -> str:
        return str(self.args[0])


class StaleViewError(Error):
    """A view of a buffer was used after its simulation had continued."""


def error_of(code: int, message: str) -> Error:
    """Returns the exception for an error code of the C library."""
    return FileError(message, code) if code == 4 else Error(message, code)


def nearest(wrong: str, names: Iterable[str]) -> str:
    """ "; did you mean 'x'?" for the nearest name, or "" if none is near."""
    near = difflib.get_close_matches(wrong, list(names), 1)
    return f"; did you mean '{near[0]}'?" if near else ""


def unknown(what: str, wrong: str, names: Iterable[str]) -> Error:
    """Returns the error for an unknown name, with the nearest known one.

    >>> str(unknown("a pass", "displya", ["shade", "display"]))
    "'displya' is not a pass; did you mean 'display'?"
    """
    return Error(f"'{wrong}' is not {what}" + (nearest(wrong, names) or f": expected one of {', '.join(names)}"))
