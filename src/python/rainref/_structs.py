"""The structs of rainref.h, member for member. The library refuses a struct of another size."""

from __future__ import annotations

import ctypes as c
from typing import TypeVar

_S = TypeVar("_S", bound="Struct")


class Struct(c.Structure):
    """A struct that begins with its size."""

    @classmethod
    def new(cls: type[_S], **members: object) -> _S:
        return cls(struct_bytes=c.sizeof(cls), **members)


def _members(text: str) -> list[tuple[str, object]]:
    """Parses names with their types: 'struct_bytes:size name:text'."""
    types = {"size": c.c_size_t, "text": c.c_char_p, "i32": c.c_int32, "i64": c.c_int64, "real": c.c_double, "float": c.c_float,
             "pointer": c.c_void_p, "ints": c.POINTER(c.c_int32), "texts": c.POINTER(c.c_char_p), "pointers": c.c_void_p * 4, "floats": c.c_float * 4}
    return [("struct_bytes", c.c_size_t)] + [(n, types[t]) for n, t in (word.split(":") for word in text.split())]


class OpenOptions(Struct):
    _fields_ = _members("file:text set:texts set_count:size threads:i32")


class SimulationInfo(Struct):
    _fields_ = _members("effect:text variant:text frame:i32 frames:i32 buffers:size warnings:size scene_json:text")


class Array(Struct):
    _fields_ = _members("name:text format:text type:i32 channels:i32 width:i32 height:i32 levels:i32 planes:i32 texel_bytes:size row_bytes:size "
                        "plane:pointers layout:pointer")


class LayoutInfo(Struct):
    _fields_ = _members("name:text bytes:size members:size")


class Member(Struct):
    _fields_ = _members("name:text unit:text sentence:text type:i32 components:i32 offset:size low:real high:real")


class CaseInfo(Struct):
    _fields_ = _members("id:text effect:text variant:text pass_name:text formula:text frame:i32 step:i32 level:i32 time:float dt:float "
                        "inputs:size outputs:size")


class Sampling(Struct):
    _fields_ = _members("filter:text mip_filter:text address_u:text address_v:text border:floats")


class PackOptions(Struct):
    _fields_ = _members("frames:ints frame_count:size passes:texts pass_count:size seed:text progress:pointer user:pointer")


class JudgeOptions(Struct):
    _fields_ = _members("profile:text port:text half:text threads:i32 strict:i32 exhaustive:i32 spirv:text")


class FolderOptions(Struct):
    _fields_ = _members("profile:text passes:texts pass_count:size partial:i32 threads:i32 progress:pointer user:pointer strict:i32 "
                        "exhaustive:i32 spirv:text")


class VerdictInfo(Struct):
    _fields_ = _members("status:text reason:text first_bad_pass:text profile:text passes:size")


class PassVerdictInfo(Struct):
    _fields_ = _members("pass_name:text formula:text status:text reason:text where:text cases:i64 elements:i64 outside:i64 differing:i64 "
                        "vacuous:i64 causes:size worst:size sampled:i64")


class CauseInfo(Struct):
    _fields_ = _members("name:text sentence:text explained:i64 of:i64 inside:i64 is_likely:i32 lines:size")


class FailureInfo(Struct):
    _fields_ = _members("case_id:text output:text field:text x:i32 y:i32 channel:i32 is_a_number:i32 got:real low:real high:real expected:real "
                        "text:text")
