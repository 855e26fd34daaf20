"""Writing packs."""

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
    """A pack that was written. It may be used as the path of its folder: `rainref.judge(pack, port)`."""

    folder: Path
    effect: str
    variant: str
    seed: int  #: seed of the scene; write_pack with it makes the same pack
    passes: tuple[str, ...]  #: passes that have cases, in the order of execution
    cases: int
    notes: tuple[str, ...]  #: sentences: passes left out, frames added, passes where even a null port is a PASS

    def __fspath__(self) -> str:
        return str(self.folder)

    def __repr__(self) -> str:
        return f"<pack of {self.effect} {self.variant}, seed {self.seed}: {', '.join(self.passes)}>"


def write_pack(scene: Simulation | str | os.PathLike[str] | Mapping[str, object], folder: str | os.PathLike[str],
               set: Mapping[str, object] | None = None, *, frames: Iterable[int] = (), passes: Iterable[str] = (), seed: int | str | None = None,
               threads: int = 0, progress: Progress = None) -> Pack:
    """Writes a pack of inputs, uniforms and expected outputs of passes, like `rainref pack`. `scene` and `set` are those of `open`. If
    `scene` is a simulation, its scene runs from the first frame, and the simulation does not change.

    The default of `frames` is 0, 1 and 12, and a later frame for a pass that does nothing in these. The default of `passes` is all. `seed`
    is a whole number, or "random" for an unpredictable one; the manifest records it. `progress` is called with (frames done, frames in
    all). It starts over if the pack is written again with more frames. A pack appears whole or not at all, and replaces an older one.

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
