"""What a simulation holds between frames, as bytes: docs/notes/state.md. The callbacks of the C library work on memory only: an exception
would not pass through them."""

from __future__ import annotations

import ctypes as c
import os
import secrets
from pathlib import Path
from typing import BinaryIO

from ._library import READ, WRITE, Handle, call
from .errors import Error, FileError, error_of


def saved(simulation: Handle) -> bytes:
    """The state of a simulation."""
    pieces: list[bytes] = []

    def write(_: object, data: int, count: int) -> int:
        pieces.append(c.string_at(data, count))
        return 0

    call("save", simulation, WRITE(write), None)
    return b"".join(pieces)


def load(simulation: Handle, state: bytes, file: str = "") -> None:
    """Gives a simulation a state; errors name the file that it comes from."""
    at = 0

    def read(_: object, to: int, count: int) -> int:
        nonlocal at
        piece = state[at:at + count]
        c.memmove(to, piece, len(piece))
        at += len(piece)
        return len(piece)

    try:
        call("load", simulation, READ(read), None)
    except Error as error:
        message = str(error)
        if not file or not message.startswith("state: "):
            raise
        raise error_of(error.code, message.replace("state", file, 1)) from None


def read_from(source: bytes | bytearray | memoryview | str | os.PathLike[str] | BinaryIO) -> bytes:
    """The bytes of a state; of a file all that it still has."""
    if isinstance(source, (str, os.PathLike)):
        try:
            return Path(source).read_bytes()
        except OSError as error:
            raise FileError(f"cannot read '{os.fspath(source)}': {error.strerror}", 4) from None
    found = source.read() if hasattr(source, "read") else source
    return bytes(memoryview(found))


def write_to(place: str | os.PathLike[str] | BinaryIO, state: bytes) -> None:
    """To a file that is open for bytes, or to a path, where nothing half-written ever lies. A file that was there keeps its mode; a link gives
    way to the file, and what it leads to stays; a device or a pipe is written straight away."""
    if not isinstance(place, (str, os.PathLike)):
        place.write(state)
        return
    path = Path(place)
    try:
        if path.exists() and not path.is_file():
            path.write_bytes(state)
        else:
            _replace(path, state)
    except OSError as error:
        raise FileError(f"cannot write '{os.fspath(place)}': {error.strerror}", 4) from None


def _replace(path: Path, state: bytes) -> None:
    """By a file of this call alone, under a name that was free."""
    descriptor, hidden = -1, path
    while descriptor < 0:
        hidden = path.parent / f".rainref-{secrets.token_hex(8)}.part"
        try:
            descriptor = os.open(hidden, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC, 0o666)
        except FileExistsError:
            pass
    try:
        with open(descriptor, "wb") as file:
            if path.is_file() and not path.is_symlink():
                os.fchmod(descriptor, path.stat().st_mode & 0o777)
            file.write(state)
            file.flush()
            os.fsync(descriptor)
        os.replace(hidden, path)
    except BaseException:
        hidden.unlink(missing_ok=True)
        raise
