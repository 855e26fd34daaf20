"""What ctypes is told is what include/rainref.h says: functions, their numbers of arguments, members of structs in their order and size."""

import ctypes
import re

from conftest import ROOT

from rainref import _library, _structs

HEADER = re.sub(r"//[^\n]*", "", (ROOT / "include/rainref.h").read_text())
SIZES = {"size_t": ctypes.sizeof(ctypes.c_size_t), "int32_t": 4, "int64_t": 8, "float": 4, "double": 8,
         "rr_progress": ctypes.sizeof(ctypes.c_void_p)}
ALIASES = {"OpenOptions": "open_options", "SimulationInfo": "simulation_info", "LayoutInfo": "layout_info", "CaseInfo": "case_info",
           "PackOptions": "pack_options", "JudgeOptions": "judge_options", "FolderOptions": "folder_options", "VerdictInfo": "verdict", "PassVerdictInfo": "pass_verdict", "CauseInfo": "cause",
           "FailureInfo": "failure"}


def members(body):
    """Names and sizes of a struct's members: 'double low, high;' are two."""
    for line in filter(None, (part.strip() for part in body.split(";"))):
        kind, names = re.match(r"(?:const )?(?:struct )?(\w+)(.*)", line, re.S).groups()
        for name in names.replace("const", "").split(","):
            count = int((re.search(r"\[(\d+)\]", name) or [0, 1])[1])
            yield re.search(r"\w+", name)[0], count * (ctypes.sizeof(ctypes.c_void_p) if "*" in name else SIZES[kind])


def test_every_function_is_declared():
    found = {name: arguments for name, arguments in re.findall(r"RR_API [^;(]*?rr_(\w+)\(([^)]*)\)", HEADER)}
    assert len(found) > 40 and set(_library._PROTOTYPES) == set(found)
    for name, arguments in found.items():
        count = 0 if arguments == "void" else arguments.count(",") + 1
        assert len(_library._PROTOTYPES[name][1]) == count, name


def test_every_struct_is_declared():
    structs = dict((name, body) for body, name in re.findall(r"typedef struct rr_\w+ \{(.*?)\} rr_(\w+);", HEADER, re.S))
    ours = {name: kind for name, kind in vars(_structs).items()
            if isinstance(kind, type) and issubclass(kind, _structs.Struct) and kind is not _structs.Struct}
    assert {ALIASES.get(name, name.lower()) for name in ours} == set(structs)
    for name, kind in ours.items():
        declared = list(members(structs[ALIASES.get(name, name.lower())]))
        assert [n.removesuffix("_name") if n == "pass_name" else n for n, _ in kind._fields_] == [n for n, _ in declared], name
        assert [ctypes.sizeof(t) for _, t in kind._fields_] == [size for _, size in declared], name
