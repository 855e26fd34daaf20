"""Opening scenes and running them."""

from __future__ import annotations

import copy
import ctypes as c
import json
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import BinaryIO

import numpy as np

from . import _structs as s
from . import states
from ._library import Handle, call, decoded, encoded, filled, text_of, texts
from .buffers import buffer_of, copy_of, view_of
from .errors import Error, FileError, StaleViewError, nearest
from .parameters import Parameters, changes, effects, toml
from .pictures import png, shown
from .progress import Progress, told
from .views import View


def open(scene: str | os.PathLike[str] | Mapping[str, object], set: Mapping[str, object] | None = None, *, threads: int = 0) -> Simulation:
    """Opens a scene. `scene` is the path of a scene file, the name of a scene in `rainref list` ("puddle/default.toml"), the name of an
    effect (all defaults), a dict of keys and values, or the text of a scene (several lines).

    `set` overrides its keys: {"run.size": (320, 180), "rain.rate": 20}. `threads` does not affect results; 0 is one thread for each
    processor. Raises Error for an invalid scene, FileError for files.

    >>> open("puddel")
    Traceback (most recent call last):
    ...
    rainref.errors.FileError: cannot read 'puddel': No such file or directory; did you mean 'puddle'?
    >>> open({"effect": "puddle", "rain": {"rte": 3}})
    Traceback (most recent call last):
    ...
    rainref.errors.Error: --set rain.rte: unknown key; did you mean 'rain.rate'?
    """
    how = changes(set)
    if isinstance(scene, Mapping):
        return Simulation("", changes(scene) + how, threads)
    if scene in effects():
        return Simulation("", [f"effect={scene}", *how], threads)
    if isinstance(scene, str) and "\n" in scene:
        return Simulation(scene, how, threads)
    try:
        return Simulation(Path(scene), how, threads)
    except FileError as error:
        if "did you mean" in str(error) or Path(scene).exists():
            raise
        raise FileError(str(error) + nearest(os.fspath(scene), effects()), error.code) from None


class Simulation:
    """A running scene; `open` makes one. The bits of every buffer do not depend on the number of threads or the machine.

    Only one thread at a time may use it. Different threads may use different simulations at the same time. Python's lock is free while a
    frame is computed.
    """

    def __init__(self, scene: str | Path, set: list[str], threads: int = 0) -> None:
        many, count = texts(set)
        options = s.OpenOptions.new(set=many, set_count=count, threads=threads)
        if isinstance(scene, Path):
            self._open: Handle | None = Handle("close", "open_file", encoded(scene), c.byref(options))
        else:
            self._open = Handle("close", "open", encoded(scene), c.byref(options))
        # Arguments to open it again, for copies in this and other processes.
        self._scene, self._set, self._threads = scene.absolute() if isinstance(scene, Path) and scene.exists() else scene, set, threads
        self.changes = 0  #: counts the changes that invalidate views
        self._look_up()

    @property
    def _handle(self) -> Handle:
        if self._open is None:
            raise Error(f"this simulation of {self.effect} is closed")
        return self._open

    def close(self) -> None:
        """Frees the simulation's memory. Copied arrays and cases stay valid; views do not. `with` calls this at the end of its block.

        >>> with open("edge_splash", {"run.size": (16, 9)}) as sim:
        ...     edge = sim.step()["edge"]
        >>> edge.shape, sim
        ((9, 16), <rainref edge_splash corrected, closed>)
        """
        if self._open is not None:
            self.changes += 1
            self._open.close()
            self._open = None

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _look_up(self) -> None:
        about = self._about()
        self.effect: str = decoded(about.effect)
        self.variant: str = decoded(about.variant)
        #: Names of the buffers kept between frames, in the order of the passes.
        self.buffers: tuple[str, ...] = tuple(decoded(call("buffer_name", self._handle, i)) for i in range(about.buffers))
        #: Every key of the scene with value, unit and range.
        self.parameters = Parameters(self.effect, json.loads(decoded(about.scene_json)))
        #: Sentences about doubtful properties of the scene's files.
        self.warnings: tuple[str, ...] = tuple(decoded(call("warning", self._handle, i)) for i in range(about.warnings))

    def _about(self) -> s.SimulationInfo:
        return filled("get_info", s.SimulationInfo, self._handle)

    def __repr__(self) -> str:
        return f"<rainref {self.effect} {self.variant}, {'closed' if self._open is None else f'frame {self.frame}'}>"

    def _repr_png_(self) -> bytes | None:
        """Returns the picture for a notebook. Before the first frame the notebook shows repr() instead."""
        return png(shown(self.picture)) if self._open is not None and self.frame > 0 else None

    @property
    def frame(self) -> int:
        """Frames simulated so far."""
        return int(self._about().frame)

    def __len__(self) -> int:
        """Number of frames that the scene asks for; more may be simulated."""
        return int(self._about().frames)

    def simulate(self) -> None:
        """Simulates the next frame without rendering it."""
        self.changes += 1
        call("simulate", self._handle)

    def render(self) -> None:
        """Renders the last simulated frame."""
        self.changes += 1
        call("render", self._handle)

    def step(self) -> Frame:
        """Simulates, renders and returns the next frame."""
        self.changes += 1
        call("next_frame", self._handle)
        return Frame(self)

    def step_hashes(self) -> dict[tuple[str, str], str]:
        """Runs the next frame and returns the hashes that `rainref hash` prints, by (pass, buffer).

        >>> sim = open("edge_splash", {"run.size": (16, 9)})
        >>> len(sim.step_hashes()["display", "picture"])
        32
        """
        self.changes += 1
        lines = text_of("next_frame_hashes", self._handle).splitlines()
        return {(name, buffer): value for _, name, buffer, value in (line.split() for line in lines)}

    def frames(self, count: int | None = None) -> Iterator[Frame]:
        """Yields the next `count` frames, each computed on demand. None: the remaining frames of the scene."""
        for _ in range(max(0, len(self) - self.frame) if count is None else count):
            yield self.step()

    def __iter__(self) -> Iterator[Frame]:
        return self.frames()

    def save(self, to: str | os.PathLike[str] | BinaryIO | None = None) -> bytes:
        """Returns the state kept between frames as bytes, and writes it to `to` if that is a path or a binary file. The simulation does not
        change.

        >>> sim = open("edge_splash", {"run.size": (16, 9)})
        >>> for frame in sim.frames(2):
        ...     pass
        >>> other = open("edge_splash", {"run.size": (16, 9)}).load(sim.save())
        >>> other.frame, other.step_hashes() == sim.step_hashes()
        (2, True)
        """
        state = states.saved(self._handle)
        if to is not None:
            states.write_to(to, state)
        return state

    def load(self, state: bytes | bytearray | memoryview | str | os.PathLike[str] | BinaryIO) -> Simulation:
        """Loads a state from the bytes of `save`, a path or a binary file, and returns the simulation. It then continues with the same
        bits. The next frame makes the picture. Raises Error if the bytes are not a state, are damaged, or belong to another scene
        (run.frames may differ). The simulation is then unchanged.

        >>> open("edge_splash", {"run.size": (16, 9)}).load(b"no state")
        Traceback (most recent call last):
        ...
        rainref.errors.Error: state: expected a state that rainref saved, found other bytes
        """
        states.load(self._handle, states.read_from(state), str(os.fspath(state)) if isinstance(state, (str, os.PathLike)) else "")
        self.changes += 1
        return self

    def set(self, key: str, value: object) -> Simulation:
        """Changes the value of a key from the next frame on, and returns the simulation. Raises Error with the key if the scene does not
        allow the value or the state does not fit it (effect, variant, sizes, storage). The simulation is then unchanged.

        >>> sim = open("edge_splash", {"run.size": (16, 9)})
        >>> sim.set("display.exposure", -1).parameters["display.exposure"].value
        -1.0
        >>> sim.set("display.exposur", -1)
        Traceback (most recent call last):
        ...
        rainref.errors.Error: --set display.exposur: unknown key; did you mean 'display.exposure'?
        """
        text = toml(value)
        # The library rebuilds the simulation and frees the old one. If an array still views the old one, keep the old one and continue with
        # a copy.
        handle = copy.copy(self)._handle if self._handle.looked_into else self._handle
        call("set", handle, encoded(key), encoded(text))
        self._open = handle
        self._set = [kept for kept in self._set if not kept.startswith(f"{key}=")] + [f"{key}={text}"]
        self.changes += 1
        self._look_up()
        return self

    def __reduce__(self) -> tuple[object, ...]:
        """Makes copy and pickle open the scene and its files again, and load the state."""
        return _opened_again, (self._scene, self._set, self._threads, self.save())

    def __getitem__(self, name: str) -> np.ndarray:
        """Returns a copy of a buffer. A list of records is a structured array. Raises Error with the nearest name.

        >>> sim = open("edge_splash", {"run.size": (16, 9)})
        >>> sim["edgs"]
        Traceback (most recent call last):
        ...
        rainref.errors.Error: edge_splash has no buffer 'edgs'; did you mean 'edge'?
        """
        return copy_of(buffer_of(self._handle, name), self._handle)

    def view(self, name: str, channel: int | None = None) -> View:
        """Returns a view of an image, or of one channel, without a copy. It is valid until the simulation continues; any later use raises
        StaleViewError."""
        return view_of(buffer_of(self._handle, name), channel, self._handle, self)

    @property
    def picture(self) -> np.ndarray:
        """The last rendered picture: uint8 display code (height, width, 4), row 0 at the bottom."""
        return copy_of(filled("get_picture", s.Array, self._handle), self._handle)

    def write_png(self, path: str | os.PathLike[str]) -> None:
        """Writes the picture as 8-bit RGB."""
        call("write_png", self._handle, encoded(path))

    def write_exr(self, path: str | os.PathLike[str]) -> None:
        """Writes radiance and its auxiliary images as named channels."""
        call("write_exr", self._handle, encoded(path))


    def film(self, path: str | os.PathLike[str], frames: int = 0, *, every: int = 1, progress: Progress = None) -> None:
        """Simulates the next `frames` frames (0: the scene's remaining frames), and writes a film of the frames whose number is a multiple
        of `every`, like `rainref run --film`. ffmpeg makes the film: .mp4, .webm or .gif, with run.fps / every pictures a second. The last
        frame is rendered in any case. `progress` is called with (frames done, frames in all). The film appears whole or not at all. Raises
        Error for the name or the rate, FileError if ffmpeg is missing or fails."""
        self.changes += 1
        with told(progress) as callback:
            call("film", self._handle, encoded(path), frames, every, callback, None)


def _opened_again(scene: str | Path, set: list[str], threads: int, state: bytes) -> Simulation:
    return Simulation(scene, set, threads).load(state)


class Frame:
    """A frame of a simulation. It is valid until the simulation continues; any later use raises StaleViewError."""

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._then = simulation.changes
        self.index: int = simulation.frame - 1

    def _now(self) -> Simulation:
        if self._simulation.changes != self._then:
            raise StaleViewError(f"frame {self.index} is over: the simulation went on")
        return self._simulation

    def __repr__(self) -> str:
        return f"<frame {self.index}>"

    def __getitem__(self, name: str) -> np.ndarray:
        """Returns a copy of a buffer."""
        return self._now()[name]

    def view(self, name: str, channel: int | None = None) -> View:
        """Returns a view of a buffer without a copy, like Simulation.view."""
        return self._now().view(name, channel)

    @property
    def picture(self) -> np.ndarray:
        """Simulation.picture."""
        return self._now().picture

    def _repr_png_(self) -> bytes | None:
        return self._now()._repr_png_()
