"""The state of a simulation as bytes (docs/notes/state.md). The callbacks for the C library access only memory, because an exception cannot
pass through C."""

from __future__ import annotations

import ctypes as c
import os
import secrets
from pathlib import Path
from typing import BinaryIO

from ._library import READ, WRITE, Handle, call
from .errors import Error, FileError, error_of


def saved(simulation: Handle) -> bytes:
    """Returns the state of a simulation."""
    pieces: list[bytes] = []

    def write(_: object, data: int, count: int) -> int:
        pieces.append(c.string_at(data, count))
        return 0

    call("save", simulation, WRITE(write), None)
    return b"".join(pieces)


def load(simulation: Handle, state: bytes, file: str = "") -> None:
    """Loads a state into a simulation. Errors name the file of the state."""
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
    """Returns the bytes of a state. From a binary file these are all remaining bytes."""
    if isinstance(source, (str, os.PathLike)):
        try:
            return Path(source).read_bytes()
        except OSError as error:
            raise FileError(f"cannot read '{os.fspath(source)}': {error.strerror}", 4) from None
    found = source.read() if hasattr(source, "read") else source
    return bytes(memoryview(found))


def write_to(place: str | os.PathLike[str] | BinaryIO, state: bytes) -> None:
    """Writes to a binary file or to a path, where no partial file ever appears. An existing file keeps its mode. A link is replaced by the
    file; its target stays. A device or pipe is written directly."""
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
    """Writes a temporary file under an unused name, then renames it."""
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
