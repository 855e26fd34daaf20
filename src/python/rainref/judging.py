"""Judging ports: functions that compute a pass in another way."""

from __future__ import annotations

import ctypes as c
import inspect
import json
import os
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Union

import numpy as np

from . import _structs as s
from ._library import Handle, decoded, encoded, filled, text_of, texts
from .cases import Case, Cases
from .errors import Error, nearest, unknown
from .parameters import describe
from .progress import Progress, told
from .simulation import Simulation


@dataclass(frozen=True)
class Port:
    """A function that computes a pass; `port` makes one. A call of the Port calls the function."""

    effect: str
    name: str
    function: Callable[..., np.ndarray | dict[str, np.ndarray]]

    def __call__(self, *arguments: object) -> np.ndarray | dict[str, np.ndarray]:
        return self.function(*arguments)

    def run(self, case: Case) -> None:
        """Runs the port on a case and gives the outputs to it."""
        takes_case = len(inspect.signature(self.function).parameters) > 2
        try:
            case.give(self.function(case.inputs, case.uniforms, *((case,) if takes_case else ())))
        except Exception as error:
            note = f"while the port ran on the case {case.id}"
            if sys.version_info >= (3, 11):
                error.add_note(note)
            else:
                print(note, file=sys.stderr)
            raise


def port(what: str) -> Callable[[Callable[..., Any]], Port]:
    """Marks a function as a port of a pass, "effect.pass". The function takes the inputs and the uniform block, whose members have names.
    If it has a third parameter, it also takes the Case. It returns the output, or a dict of outputs by name.

    >>> @port("edge_splash.display")
    ... def black(inputs, uniforms):
    ...     return np.zeros((*inputs.colour.shape[:2], 4), np.uint8)
    >>> black.name
    'display'
    """
    effect, _, name = what.partition(".")
    passes = [p["name"] for p in describe(effect)["passes"]]
    if name not in passes:
        raise unknown(f"a pass of {effect}", name, passes)
    return lambda function: Port(effect, name, function)


@dataclass(frozen=True)
class Cause:
    """A possible cause of the failures of a pass."""

    name: str
    sentence: str
    explained: int  #: failing texels or records whose bits the cause reproduces
    of: int  #: failing texels or records that were examined
    inside: int  #: failing texels or records that the cause comes near
    is_likely: bool  #: it explains nearly all of them
    lines: tuple[str, ...]  #: its lines in the port's shaders, the best line first: "shade.comp:57: vec3 bent = ..."


@dataclass(frozen=True)
class Failure:
    """An element outside its envelope. Values from low to high are accepted. For a record, x is its number or id."""

    case: str
    output: str
    field: str
    x: int
    y: int
    channel: int
    got: float
    low: float
    high: float
    expected: float
    text: str


@dataclass(frozen=True)
class PassVerdict:
    """Verdict on a pass. An element is a channel of a texel or a field of a record."""

    name: str
    formula: str
    status: str
    reason: str
    where: str  #: what the failures have in common: "only channel y of wave"
    cases: int
    elements: int
    outside: int
    differing: int
    vacuous: int  #: sampled elements whose envelope is too wide to be useful
    causes: tuple[Cause, ...]  #: best first
    worst: tuple[Failure, ...]  #: worst first
    sampled: int  #: elements whose envelope was computed: all, or a sample of a large picture


class Verdict:
    """Verdict on ports: `status`, `passes`, `verdict["wave_step"].causes`. print() shows the report of `rainref validate`."""

    def __init__(self, handle: Handle) -> None:
        self._handle = handle
        about = filled("get_verdict", s.VerdictInfo, handle)
        self.status: str = decoded(about.status)
        self.reason: str = decoded(about.reason)
        self.first_bad_pass: str = decoded(about.first_bad_pass)
        self.profile: str = decoded(about.profile)
        self.passes: tuple[PassVerdict, ...] = tuple(self._pass(i) for i in range(about.passes))

    def _pass(self, i: int) -> PassVerdict:
        p = filled("get_pass_verdict", s.PassVerdictInfo, self._handle, i)
        causes = [filled("get_cause", s.CauseInfo, self._handle, i, k) for k in range(p.causes)]
        lines = [tuple(text_of("get_line", self._handle, i, k, n) for n in range(cause.lines)) for k, cause in enumerate(causes)]
        worst = [filled("get_failure", s.FailureInfo, self._handle, i, k) for k in range(p.worst)]
        return PassVerdict(
            decoded(p.pass_name), decoded(p.formula), decoded(p.status), decoded(p.reason), decoded(p.where), p.cases, p.elements, p.outside,
            p.differing, p.vacuous,
            tuple(Cause(decoded(k.name), decoded(k.sentence), k.explained, k.of, k.inside, bool(k.is_likely), own)
                  for k, own in zip(causes, lines)),
            tuple(Failure(decoded(f.case_id), decoded(f.output), decoded(f.field), f.x, f.y, f.channel, f.got, f.low, f.high, f.expected,
                          decoded(f.text)) for f in worst), p.sampled)

    @property
    def ok(self) -> bool:
        """True for PASS and WARN."""
        return self.status in ("PASS", "WARN")

    def __getitem__(self, name: str) -> PassVerdict:
        for p in self.passes:
            if p.name == name:
                return p
        raise unknown("a pass that was judged", name, [p.name for p in self.passes])

    def __str__(self) -> str:
        return text_of("report_text", self._handle)

    def __repr__(self) -> str:
        return f"<verdict {self.status}{' in ' + self.first_bad_pass if self.first_bad_pass else ''}>"

    def json(self) -> dict[str, object]:
        """The whole report; docs/reports.md lists the keys."""
        return json.loads(text_of("report_json", self._handle))

    def html(self, path: str | os.PathLike[str]) -> None:
        """Writes the report as one HTML page with pictures of the failures."""
        Path(path).write_text(text_of("report_html", self._handle), "utf-8", "surrogateescape")

    def junit(self, path: str | os.PathLike[str]) -> None:
        """Writes the report as JUnit XML, for continuous integration."""
        Path(path).write_text(text_of("report_junit", self._handle), "utf-8", "surrogateescape")


#: A port of a pass: made by @port, or a function. The key in `Given`, or the function's own name, says which pass it computes.
Function = Union[Port, Callable[..., Any]]
Given = Union[Function, Iterable[Function], Mapping[str, Function]]


def _ports(given: Given, effect: str, passes: Sequence[str]) -> list[Port]:
    """Returns the given functions as ports of these passes, at most one for each pass."""
    if isinstance(given, Mapping):
        named = list(given.items())
    else:
        functions = [given] if callable(given) else list(given)
        named = [(p.name if isinstance(p, Port) else getattr(p, "__name__", ""), p) for p in functions]
    ports = []
    for name, function in named:
        if not callable(function):
            raise Error(f"ports: expected functions, found {function!r}")
        if isinstance(function, Port) and function.effect != effect:
            raise Error(f"ports: expected ports of {effect}, found one of {function.effect}.{function.name}")
        if not isinstance(function, Port) and not isinstance(given, Mapping) and len(named) == len(passes) == 1:
            name = passes[0]
        if name not in passes:
            raise Error(f"ports: expected a function whose name is a pass, one with @rainref.port(...), or {{\"{passes[0]}\": function}}; found "
                        f"'{name}'" + (nearest(name, passes) or f", and the passes are {', '.join(passes)}"))
        ports.append(Port(effect, name, function.function if isinstance(function, Port) else function))
    names = [p.name for p in ports]
    if not ports or len(set(names)) != len(names):
        raise Error(f"ports: expected one for each pass, found {', '.join(names) or 'none'}")
    return ports


def _passes_of(pack: str | os.PathLike[str]) -> tuple[str, list[str]]:
    """Returns the effect of a pack, and the passes that have cases. If the manifest is unusable, the library says what is wrong."""
    try:
        manifest = json.loads((Path(pack) / "manifest.json").read_text("utf-8"))
        return manifest["effect"], list(dict.fromkeys(case["pass"] for case in manifest["cases"]))
    except (OSError, ValueError, KeyError, TypeError):
        cases = Cases.of_pack(pack)
        return cases[0].effect, list(dict.fromkeys(case.name for case in cases))


def _run(ports: Iterable[Port], cases: Cases, progress: Progress) -> None:
    by_name = {p.name: p for p in ports}
    for done, case in enumerate(cases, 1):
        by_name[case.name].run(case)
        if progress:
            progress(done, len(cases))


def judge(what: Simulation | str | os.PathLike[str], ports: Given, frames: Iterable[int] = (0, 1), profile: str = "vulkan", *,
          half: str | None = None, threads: int = 0, strict: bool = False, exhaustive: bool = False,
          spirv: str | os.PathLike[str] | None = None, progress: Progress = None) -> Verdict:
    """Runs ports on the cases of a simulation or of a pack's folder, and judges their outputs.

    A port is made by @port, or is a plain function of the same arguments. A plain function computes the pass that is its key in a dict
    ({"wave_step": function}), or else its name. If a pack has one pass, a single function may have any name. `progress` is called with
    (cases run, cases in all).

    A simulation runs until the last of `frames`, none of which may have been simulated before. `half` says how the ports round stores to
    binary16 ("rne", "rtz"); None: it is inferred from the outputs if the profile leaves it open. With `strict` each WARN is a FAIL. With
    `exhaustive` every envelope is computed; otherwise the statistics of envelope widths may use a sample. `spirv` is a folder with
    bindings.json and the ports' SPIR-V. With it causes have lines, and the report says who is wrong. Raises Error for outputs that cannot
    be judged.
    """
    if isinstance(what, Simulation):
        effect, passes = what.effect, [p["name"] for p in describe(what.effect)["passes"]]
    else:
        effect, passes = _passes_of(what)
    judged = _ports(ports, effect, passes)
    names = [p.name for p in judged]
    if isinstance(what, Simulation):
        wanted = sorted(set(frames))
        if not wanted or wanted[0] < what.frame:
            raise Error(f"frames: expected frames from {what.frame} on, found {', '.join(map(str, wanted)) or 'none'}")
        cases = Cases.of_simulation(what)
        while what.frame <= wanted[-1]:
            if what.frame in wanted:
                cases.add_next_frame(what, names)
            else:
                what.step()
    else:
        cases = Cases.of_pack(what, names)
    _run(judged, cases, progress)
    options = s.JudgeOptions.new(profile=encoded(profile), half=encoded(half) if half is not None else None, threads=threads, strict=strict,
                                 exhaustive=exhaustive, spirv=None if spirv is None else encoded(spirv),
                                 port=", ".join(getattr(p.function, "__name__", p.name) for p in judged).encode())
    return Verdict(Handle("free_judgement", "judge", cases.handle, c.byref(options)))


def judge_folder(pack: str | os.PathLike[str], port: str | os.PathLike[str], profile: str = "vulkan", *, passes: Iterable[str] = (),
                 partial: bool = False, threads: int = 0, strict: bool = False, exhaustive: bool = False,
                 spirv: str | os.PathLike[str] | None = None, progress: Progress = None) -> Verdict:
    """Judges the files that a port wrote for the cases of a pack, like `rainref validate PACK --port PORT`.

    Only `passes` are judged; if none is named, all are. With `partial` a pass without any file is NOT JUDGED. `strict`, `exhaustive` and
    `spirv` are as in judge(). `progress` is called with (runs of passes judged, runs in all). The verdict's `json()["files"]` lists missing
    and unusable files. Its `html` reads both folders again. Raises Error if nothing can be judged.
    """
    many, count = texts(passes)
    with told(progress) as callback:
        options = s.FolderOptions.new(profile=encoded(profile), passes=many, pass_count=count, partial=partial, threads=threads, progress=callback,
                                      strict=strict, exhaustive=exhaustive, spirv=None if spirv is None else encoded(spirv))
        return Verdict(Handle("free_judgement", "judge_folder", encoded(pack), encoded(port), c.byref(options)))
