"""Cases: runs of passes with their inputs and outputs. A port runs on them."""

from __future__ import annotations

import ctypes as c
import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _structs as s
from ._library import Handle, call, decoded, encoded, filled, texts
from .buffers import copy_of, dtype_of, image_given, records_given
from .errors import Error, unknown

if TYPE_CHECKING:
    from .simulation import Simulation


@dataclass(frozen=True)
class Sampling:
    """How a pass reads an input: filters ("none": by integer texel, "nearest" or "linear"), and address rules in u and v."""

    filter: str
    mip_filter: str
    address: tuple[str, str]
    border: tuple[float, float, float, float]


class Inputs(SimpleNamespace):
    """The inputs of a case by name: `inputs.wave`. If an input has mip levels, this is level 0."""

    def __getattr__(self, name: str) -> object:
        if name.startswith("_"):
            raise AttributeError(name)
        raise unknown("an input of this pass", name, vars(self))


class Uniforms(np.record):
    """The members of a uniform block by name. An unknown name is an error, which suggests the nearest name."""

    def __getattr__(self, name: str) -> object:
        if name.startswith("_"):
            raise AttributeError(name)
        raise unknown("a uniform of this pass", name, self.dtype.names or ())

    def __getitem__(self, name: Any) -> Any:
        if isinstance(name, str) and name not in (self.dtype.names or ()):
            raise unknown("a uniform of this pass", name, self.dtype.names or ())
        return super().__getitem__(name)


class Case:
    """One run of one pass."""

    def __init__(self, handle: Handle, index: int) -> None:
        self._handle, self._index = handle, index
        about = filled("get_case", s.CaseInfo, handle, index)
        self.id: str = decoded(about.id)
        self.effect: str = decoded(about.effect)
        self.variant: str = decoded(about.variant)
        self.name: str = decoded(about.pass_name)
        self.formula: str = decoded(about.formula)
        self.frame, self.step, self.level = int(about.frame), int(about.step), int(about.level)
        self.time, self.dt = float(about.time), float(about.dt)
        self._inputs = {decoded(self._input(i, 0).name): i for i in range(about.inputs)}
        self._outputs = {decoded(self._expected(o).name): o for o in range(about.outputs)}

    def __repr__(self) -> str:
        return f"<case {self.id}>"

    def _input(self, index: int, level: int) -> s.Array:
        return filled("get_input", s.Array, self._handle, self._index, index, level)

    def _expected(self, index: int) -> s.Array:
        return filled("get_expected", s.Array, self._handle, self._index, index)

    def _index_of(self, name: str) -> int:
        if name not in self._inputs:
            raise unknown(f"an input of {self.name}", name, self._inputs)
        return self._inputs[name]

    @property
    def uniforms(self) -> Uniforms:
        """The uniform block: `uniforms.damping`, vectors as arrays."""
        block = copy_of(filled("get_uniforms", s.Array, self._handle, self._index), self._handle)
        return block.view(np.dtype((Uniforms, block.dtype)))[0]

    @property
    def inputs(self) -> Inputs:
        """Copies of all inputs."""
        return Inputs(**{name: copy_of(self._input(i, 0), self._handle) for name, i in self._inputs.items()})

    def levels(self, name: str) -> list[np.ndarray]:
        """All mip levels of an input, largest first."""
        i = self._index_of(name)
        return [copy_of(self._input(i, level), self._handle) for level in range(self._input(i, 0).levels)]

    def sampling(self, name: str) -> Sampling:
        """How the pass reads an input."""
        raw = filled("get_sampling", s.Sampling, self._handle, self._index, self._index_of(name))
        return Sampling(decoded(raw.filter), decoded(raw.mip_filter), (decoded(raw.address_u), decoded(raw.address_v)),
                        (raw.border[0], raw.border[1], raw.border[2], raw.border[3]))

    @property
    def expected(self) -> dict[str, np.ndarray]:
        """The reference's outputs by name."""
        return {name: copy_of(self._expected(o), self._handle) for name, o in self._outputs.items()}

    @property
    def judged(self) -> dict[str, str]:
        """How each output is judged: "envelope", "bits", "keyed" or "input_only" (not judged)."""
        return {name: decoded(call("get_judge", self._handle, self._index, o)) for name, o in self._outputs.items()}

    def give(self, outputs: np.ndarray | dict[str, np.ndarray]) -> None:
        """Takes a port's result: an array if the pass has one output, else a dict by name.

        As in files (docs/dumps.md), surplus channels are ignored, and the report notes this. Floats are converted to the buffer's format:
        rounded to nearest even, in 8 bits as rint(255 x), and sRGB-encoded if the buffer is sRGB. Raises Error for a shape or type that
        cannot be stored."""
        if not isinstance(outputs, dict):
            if len(self._outputs) != 1:
                raise Error(f"{self.id}: expected a dict with {', '.join(self._outputs)}, found {type(outputs).__name__}")
            outputs = {next(iter(self._outputs)): outputs}
        for name, array in outputs.items():
            if name not in self._outputs:
                raise unknown(f"an output of {self.name}", name, self._outputs)
            at, place = self._outputs[name], f"{self.id}/out.{name}"
            raw = self._expected(at)
            if raw.layout:
                records = records_given(array, dtype_of(raw.layout), place)
                call("give", self._handle, self._index, at, records.ctypes.data, records.itemsize, len(records))
            else:
                image, rows = image_given(array, raw, place)
                call("give_image", self._handle, self._index, at, c.byref(image))
                del rows  # must stay alive until here


class Cases(Sequence[Case]):
    """Cases of one scene or pack, in the order of execution."""

    def __init__(self, handle: Handle) -> None:
        self.handle = handle

    @classmethod
    def of_simulation(cls, simulation: Simulation) -> Cases:
        """Makes an empty set of cases."""
        return cls(Handle("free_cases", "cases_of_simulation", simulation._handle))

    @classmethod
    def of_pack(cls, folder: str | os.PathLike[str], passes: Sequence[str] = ()) -> Cases:
        """Reads the cases of a pack with all their values."""
        many, count = texts(passes)
        return cls(Handle("free_cases", "cases_of_pack", encoded(folder), many, count))

    def add_next_frame(self, simulation: Simulation, passes: Sequence[str] = ()) -> None:
        """Runs the simulation's next frame. Each run of the named passes becomes a case. If no pass is named, each run of every pass
        does."""
        many, count = texts(passes)
        simulation.changes += 1
        call("next_frame_cases", simulation._handle, many, count, self.handle)

    def __len__(self) -> int:
        return int(call("case_count", self.handle))

    def __getitem__(self, index: int) -> Case:  # type: ignore[override]  # no slices
        if not -len(self) <= index < len(self):
            raise IndexError(index)
        return Case(self.handle, index % len(self))

    def __iter__(self) -> Iterator[Case]:
        return (Case(self.handle, i) for i in range(len(self)))
