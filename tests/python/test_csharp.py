"""examples/csharp with Mono: it declares what include/rainref.h declares, and its objects give what the program gives."""

import ctypes
import os
import re
import shutil
import subprocess

import pytest
from conftest import PACKS, ROOT
from test_declarations import ALIASES, HEADER

from rainref import _library, _structs

#: C# of a parameter or result of C. What the library fills or frees is a reference or a handle.
KINDS = {"size_t": {"UIntPtr"}, "int32_t": {"Int32"}, "uint32_t": {"UInt32"}, "int": {"Int32"}, "void": {"Void"}}


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Returns a function that runs a program with examples/csharp: declared (tests/python/declared.cs), the example, or the document's."""
    if not (shutil.which("mcs") and shutil.which("mono")):
        pytest.skip("no Mono here (Debian: mono-mcs)")
    folder = tmp_path_factory.mktemp("csharp")
    sources = sorted((ROOT / "examples/csharp").glob("*.cs"))
    library = [s for s in sources if s.name != "Example.cs"]
    block = re.search(r"```csharp\n(.*?)```", (ROOT / "docs/notes/other_languages.md").read_text(), re.S)[1]
    (folder / "document.cs").write_text(f"using System;\nusing Rainref;\nstatic class Document {{ static void Main() {{\n{block}}} }}\n")
    programs = {"example": sources, "declared": [*library, ROOT / "tests/python/declared.cs"], "document": [*library, folder / "document.cs"]}
    for name, files in programs.items():
        made = subprocess.run(["mcs", "-warnaserror", "-langversion:7", *files, f"-out:{folder / name}.exe"], capture_output=True, text=True)
        assert made.returncode == 0, made.stdout + made.stderr
    (folder / "librainref.so").symlink_to(_library._loaded._name)

    def program(name, *words):
        path = f"{folder}:{os.environ.get('LD_LIBRARY_PATH', '')}"
        done = subprocess.run(["mono", folder / f"{name}.exe", *map(str, words)], capture_output=True, text=True, cwd=folder,
                              env=os.environ | {"LD_LIBRARY_PATH": path, "LC_ALL": "C.UTF-8"})
        assert done.returncode == 0, done.stdout + done.stderr
        return done.stdout.splitlines()

    return program


def test_the_source_declares_every_function():
    text = (ROOT / "examples/csharp/Rainref.cs").read_text()
    assert set(re.findall(r"extern \w+ (rr_\w+)\(", text)) == set(re.findall(r"RR_API [^;(]*?(rr_\w+)\(", HEADER))


def test_functions_are_those_of_the_header(run):
    ours = {words[1]: words[2:] for line in run("declared") if (words := line.split())[0] == "function"}
    found = re.findall(r"RR_API ([^;(]*?)(rr_\w+)\(([^)]*)\)", HEADER)
    assert len(found) > 40 and set(ours) == {name for _, name, _ in found}
    for result, name, arguments in found:
        parameters = [] if arguments.strip() == "void" else arguments.split(",")
        assert len(ours[name]) == 1 + len(parameters), name
        for kind, declared in zip(ours[name], [result, *parameters]):
            word = re.match(r"\s*(?:const )?(\w+)", declared)[1]
            by_value = "*" not in declared and word in KINDS
            assert kind in KINDS[word] if by_value else kind not in {"Int32", "UInt32", "UIntPtr", "Void"}, (name, declared, kind)


def test_structs_have_the_sizes_and_offsets_of_c(run):
    said = [line.split() for line in run("declared")]
    sizes = {words[1]: int(words[2]) for words in said if words[0] == "struct"}
    offsets = {}
    for words in said:
        if words[0] == "member":
            offsets.setdefault(words[1], {})[words[2]] = int(words[3])
    expected = {}
    for name, kind in vars(_structs).items():
        if not (isinstance(kind, type) and issubclass(kind, _structs.Struct)) or kind is _structs.Struct:
            continue
        struct = "rr_" + ALIASES.get(name, name.lower())
        assert sizes[struct] == ctypes.sizeof(kind), struct
        members = expected[struct] = {}
        for field, of in kind._fields_:
            start = getattr(kind, field).offset
            word = "pass" if field == "pass_name" else field
            if issubclass(of, ctypes.Array):  # C# has a member for each element
                members |= {f"{word}{i}": start + i * ctypes.sizeof(of._type_) for i in range(of._length_)}
            else:
                members[word] = start
    assert offsets == expected and set(sizes) == set(expected)


def test_constants_are_those_of_the_header(run):
    ours = {words[1]: int(words[2]) for line in run("declared") if (words := line.split())[0] == "constant"}
    expected = {}
    for body in re.findall(r"enum rr_\w+ \{(.*?)\};", HEADER, re.S):
        value = -1
        for word in filter(None, (w.strip() for w in body.split(","))):
            name, _, told = word.partition("=")
            value = int(told) if told else value + 1
            expected[name.strip()] = value
    assert ours == expected


def test_it_gives_the_hashes_of_the_program(run):
    program = os.environ.get("RAINREF_PROGRAM", ROOT / "build/release/bin/rainref")
    scene = ROOT / "tests/packs/edge_splash-corrected.toml"
    lines = subprocess.run([program, "hash", scene, "--frames", "4"], capture_output=True, text=True, check=True).stdout.splitlines()
    assert len(lines) > 4 and run("declared", "hash", scene, 4) == lines[:-1]  # the last line is of the whole run


def test_a_failure_is_an_exception_with_its_code(run):
    unknown, stream, buffer = run("declared", "errors", ROOT / "tests/packs/puddle-corrected.toml")
    assert unknown.startswith("RR_USAGE: ") and "did you mean 'puddle'?" in unknown
    assert stream == "the disk is full"
    assert buffer.startswith("RR_USAGE: ") and "wäve" in buffer


def test_it_judges_a_folder_and_calls_back(run, tmp_path):
    pack = PACKS / "edge_splash-corrected"
    shutil.copytree(pack, tmp_path / "port", ignore=shutil.ignore_patterns("manifest.json"))  # or it would be judged by itself
    lines = run("declared", "judge", pack, tmp_path / "port")
    assert re.fullmatch(r"PASS \d+ True", lines[0]), lines
    assert lines[-1] == "RR_USAGE" and any(line.startswith("PASS") for line in lines[1:-1])


def test_the_example_prints_its_verdict(run):
    assert run("example") == ["rg16f 768x512 after 3 frames", "FAIL in display: upside down"]


def test_the_document_shows_the_wave(run):
    assert re.fullmatch(r"rg16f 768 \d+", run("document")[0])
