"""Finding the library, loading it, and calling it."""

from __future__ import annotations

import ctypes as c
import os
import sys
import weakref
from collections.abc import Iterable
from pathlib import Path
from typing import Any, TypeVar

from . import _structs as s
from .errors import error_of

_NAME = {"win32": "rainref.dll", "darwin": "librainref.0.dylib"}.get(sys.platform, "librainref.so.0")
_HERE = Path(__file__).resolve().parent


def _places() -> list[str]:
    """Where the library may be: the place that RAINREF_LIBRARY names, or else this package, the unpacked archive around it, the build
    folder of this file's clone, and the system's search path. On Windows a library lies beside the programs."""
    told = os.environ.get("RAINREF_LIBRARY")
    if told:
        return [told]
    archive, build = _HERE.parents[1], _HERE.parents[2] / "build/release"
    folders = [_HERE / "lib", archive / "lib", archive / "bin", build / "lib", build / "bin"]
    return [str(folder / _NAME) for folder in folders if (folder / _NAME).exists()] + [_NAME]


def _load() -> c.CDLL:
    why = []
    for place in _places():
        try:
            return c.CDLL(place)
        except OSError as error:
            why.append(str(error))
    raise ImportError(f"rainref needs {_NAME}: scripts/build makes it, cmake --install puts it where the system looks, and RAINREF_LIBRARY "
                      f"may name it; found: {'; '.join(why)}")


_S = TypeVar("_S", bound=s.Struct)
_handle, _result, _index, _text, _out = c.c_void_p, c.c_int, c.c_size_t, c.c_char_p, c.POINTER(c.c_void_p)
#: Callbacks: rr_progress, rr_write and rr_read.
PROGRESS = c.CFUNCTYPE(c.c_int, c.c_void_p, c.c_int32, c.c_int32)
WRITE, READ = (c.CFUNCTYPE(result, c.c_void_p, c.c_void_p, c.c_size_t) for result in (c.c_int, c.c_int64))
_texts, _text_out = c.POINTER(c.c_char_p), c.POINTER(c.c_char_p)
_PROTOTYPES: dict[str, tuple[object, list[object]]] = {
    "error": (_text, []),
    "version": (_text, []),
    "golden_generation": (c.c_uint32, []),
    "effect_name": (_text, [_index]),
    "profile_name": (_text, [_index]),
    "describe": (_result, [_text, _text_out]),
    "keep_images": (_result, [_text]),
    "open": (_result, [_text, c.POINTER(s.OpenOptions), _out]),
    "open_file": (_result, [_text, c.POINTER(s.OpenOptions), _out]),
    "close": (None, [_handle]),
    "get_info": (_result, [_handle, c.POINTER(s.SimulationInfo)]),
    "warning": (_text, [_handle, _index]),
    "simulate": (_result, [_handle]),
    "render": (_result, [_handle]),
    "next_frame": (_result, [_handle]),
    "next_frame_hashes": (_result, [_handle, _text_out]),
    "write_png": (_result, [_handle, _text]),
    "write_exr": (_result, [_handle, _text]),
    "save": (_result, [_handle, WRITE, c.c_void_p]),
    "load": (_result, [_handle, READ, c.c_void_p]),
    "set": (_result, [_handle, _text, _text]),
    "get_layout": (_result, [_handle, c.POINTER(s.LayoutInfo)]),
    "get_member": (_result, [_handle, _index, c.POINTER(s.Member)]),
    "buffer_name": (_text, [_handle, _index]),
    "get_buffer": (_result, [_handle, _text, c.POINTER(s.Array)]),
    "get_picture": (_result, [_handle, c.POINTER(s.Array)]),
    "cases_of_simulation": (_result, [_handle, _out]),
    "next_frame_cases": (_result, [_handle, _texts, _index, _handle]),
    "cases_of_pack": (_result, [_text, _texts, _index, _out]),
    "free_cases": (None, [_handle]),
    "case_count": (_index, [_handle]),
    "get_case": (_result, [_handle, _index, c.POINTER(s.CaseInfo)]),
    "get_uniforms": (_result, [_handle, _index, c.POINTER(s.Array)]),
    "get_input": (_result, [_handle, _index, _index, c.c_int32, c.POINTER(s.Array)]),
    "get_sampling": (_result, [_handle, _index, _index, c.POINTER(s.Sampling)]),
    "get_expected": (_result, [_handle, _index, _index, c.POINTER(s.Array)]),
    "get_judge": (_text, [_handle, _index, _index]),
    "give": (_result, [_handle, _index, _index, c.c_void_p, _index, _index]),
    "give_image": (_result, [_handle, _index, _index, c.POINTER(s.Array)]),
    "write_pack": (_result, [_handle, _text, c.POINTER(s.PackOptions), _text_out]),
    "film": (_result, [_handle, _text, c.c_int32, c.c_int32, c.c_void_p, c.c_void_p]),
    "judge": (_result, [_handle, c.POINTER(s.JudgeOptions), _out]),
    "judge_folder": (_result, [_text, _text, c.POINTER(s.FolderOptions), _out]),
    "free_judgement": (None, [_handle]),
    "get_verdict": (_result, [_handle, c.POINTER(s.VerdictInfo)]),
    "get_pass_verdict": (_result, [_handle, _index, c.POINTER(s.PassVerdictInfo)]),
    "get_cause": (_result, [_handle, _index, _index, c.POINTER(s.CauseInfo)]),
    "get_line": (_result, [_handle, _index, _index, _index, c.POINTER(c.c_char_p)]),
    "get_failure": (_result, [_handle, _index, _index, c.POINTER(s.FailureInfo)]),
    "report_text": (_result, [_handle, _text_out]),
    "report_json": (_result, [_handle, _text_out]),
    "report_html": (_result, [_handle, _text_out]),
    "report_junit": (_result, [_handle, _text_out]),
}

_loaded = _load()
_functions = {}
for _name, (_restype, _argtypes) in _PROTOTYPES.items():
    _function = getattr(_loaded, "rr_" + _name)
    _function.restype, _function.argtypes = _restype, _argtypes
    _functions[_name] = _function


def call(name: str, *arguments: object) -> Any:
    """Calls rr_NAME(arguments). Raises Error if the function fails. Other threads can run during the call."""
    result = _functions[name](*arguments)
    if _PROTOTYPES[name][0] is _result and result != 0:
        raise error_of(result, decoded(_functions["error"]()))
    return result


def filled(name: str, struct: type[_S], *arguments: object) -> _S:
    """Returns the struct that rr_NAME fills through its last argument."""
    out = struct.new()
    call(name, *arguments, c.byref(out))
    return out


def text_of(name: str, *arguments: object) -> str:
    """Returns the text that rr_NAME gives through its last argument."""
    out = c.c_char_p()
    call(name, *arguments, c.byref(out))
    return decoded(out.value)


def decoded(text: bytes | None) -> str:
    """Decodes a text, which may hold a file name that is not UTF-8."""
    return (text or b"").decode("utf-8", "surrogateescape")


def encoded(text: str | os.PathLike[str]) -> bytes:
    return os.fspath(text).encode("utf-8", "surrogateescape")


def texts(many: Iterable[str]) -> tuple[c.Array[c.c_char_p], int]:
    """Returns an array of texts, and its length."""
    all_of_them = [encoded(t) for t in many]
    return (c.c_char_p * len(all_of_them))(*all_of_them), len(all_of_them)


class Handle:
    """A handle of the library. It is freed when nothing refers to it. Arrays that view its memory refer to it."""

    def __init__(self, free: str, make: str, *arguments: object) -> None:
        made = c.c_void_p()
        call(make, *arguments, c.byref(made))
        self._as_parameter_ = made
        #: Memory of the library that arrays view, by the id of its Python object.
        self.looked_into: weakref.WeakValueDictionary[int, object] = weakref.WeakValueDictionary()
        self._free = weakref.finalize(self, _functions[free], made)
        self._free.atexit = False  # arrays may still view its memory at the end of the program

    def close(self) -> None:
        """Frees the handle. If arrays view its memory, it is freed with the last of them."""
        if not self.looked_into:
            self._free()


def version() -> str:
    """ "major.minor.patch" of the library."""
    return decoded(_functions["version"]())


def keep_images(folder: str | os.PathLike[str] | None) -> None:
    """Sets the folder that keeps generated images that are the same in every run, such as the street around a puddle. None: they are not
    kept. Without this call the folder is that of `rainref run`: $XDG_CACHE_HOME/rainref, or ~/.cache/rainref. Does not affect results.
    Raises Error once a scene has been opened."""
    call("keep_images", None if folder is None else encoded(folder))


def golden_generation() -> int:
    """Generation of the golden results. It rises when a change alters the bits of any published pass."""
    return int(_functions["golden_generation"]())
