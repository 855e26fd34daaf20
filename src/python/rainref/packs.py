"""Packs written from Python."""

from __future__ import annotations

import ctypes as c
import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

from . import _structs as s
from ._library import call, decoded, encoded, texts
from .errors import Error
from .progress import Progress, told
from .simulation import Simulation, open


@dataclass(frozen=True)
class Pack:
    """A pack that was written. It stands for its folder where a path is taken: `rainref.judge(pack, port)`."""

    folder: Path
    effect: str
    variant: str
    seed: int  #: of the scene's random numbers; write_pack with it makes the same pack
    passes: tuple[str, ...]  #: those that have cases, in the order of execution
    cases: int
    notes: tuple[str, ...]  #: sentences: passes left out, frames added, passes of which the pack says nothing

    def __fspath__(self) -> str:
        return str(self.folder)

    def __repr__(self) -> str:
        return f"<pack of {self.effect} {self.variant}, seed {self.seed}: {', '.join(self.passes)}>"


def write_pack(scene: Simulation | str | os.PathLike[str] | Mapping[str, object], folder: str | os.PathLike[str],
               set: Mapping[str, object] | None = None, *, frames: Iterable[int] = (), passes: Iterable[str] = (), seed: int | str | None = None,
               threads: int = 0, progress: Progress = None) -> Pack:
    """Writes a pack: inputs, uniforms and expected outputs of passes, like `rainref pack`. `scene` and `set` are those of `open`; for a
    simulation, which does not change, its scene runs from the first frame on.

    Without `frames` these are 0, 1 and 12, and a later one for a pass that does nothing in these; without `passes` all are taken. `seed`
    is a whole number, or "random" for one that nobody can predict; the manifest has it. `progress` is called with (frames done, frames in
    all), and begins anew if the pack is written again with more frames. A pack appears whole or not at all, and replaces an older one.

    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_pack("edge_splash", folder + "/pack", {"run.size": (16, 9)}, frames=[1], seed=7)
    <pack of edge_splash corrected, seed 7: splash, display>
    """
    if isinstance(seed, bool) or not isinstance(seed, (int, str, type(None))):
        raise Error(f"seed: expected \"random\" or a whole number, found {seed!r}")
    if not isinstance(scene, Simulation):
        with open(scene, set, threads=threads) as sim:
            return write_pack(sim, folder, frames=frames, passes=passes, seed=seed, progress=progress)
    if set is not None:
        raise Error("set: expected none beside a simulation, which has its own set()")
    numbers = list(frames)
    many, count = texts(passes)
    notes = c.c_char_p()
    with told(progress) as callback:
        options = s.PackOptions.new(frames=(c.c_int32 * len(numbers))(*numbers), frame_count=len(numbers), passes=many, pass_count=count,
                                    seed=None if seed is None else encoded(str(seed)), progress=callback)
        call("write_pack", scene._handle, encoded(folder), c.byref(options), c.byref(notes))
    manifest = json.loads((Path(folder) / "manifest.json").read_text("utf-8"))
    with_cases = [case["pass"] for case in manifest["cases"]]
    return Pack(Path(folder), manifest["effect"], manifest["variant"], manifest["seed"], tuple(dict.fromkeys(with_cases)), len(with_cases),
                tuple(decoded(notes.value).splitlines()))
