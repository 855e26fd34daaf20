"""The keys of a scene, with units and ranges."""

from __future__ import annotations

import functools
import itertools
import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from . import _library
from ._library import decoded, encoded, text_of
from .errors import unknown


@dataclass(frozen=True)
class Parameter:
    """A key of a scene."""

    name: str
    value: object  #: value in the scene
    type: str
    unit: str  #: "m/s"; "1" for a pure number, "" if a unit has no meaning
    minimum: float | None  #: inclusive, for each component; None: no bound
    maximum: float | None
    default: object
    sentence: str
    choices: tuple[str, ...] = ()


def _names(function: str) -> tuple[str, ...]:
    found = (_library.call(function, i) for i in itertools.count())
    return tuple(decoded(name) for name in itertools.takewhile(lambda name: name is not None, found))


def effects() -> tuple[str, ...]:
    """
    >>> effects()
    ('puddle', 'windshield', 'edge_splash', 'screen_drops', 'rainy_glass')
    """
    return _names("effect_name")


def profiles() -> tuple[str, ...]:
    """Returns the names of the profiles that a port can be judged under.

    >>> "vulkan" in profiles()
    True
    """
    return _names("profile_name")


@functools.cache
def _described(effect: str) -> str:
    return text_of("describe", encoded(effect))


def describe(effect: str) -> dict[str, Any]:
    """Returns the content of `rainref describe EFFECT --json`: parameters, passes, buffers, layouts.

    >>> [p["name"] for p in describe("edge_splash")["passes"]]
    ['splash', 'display']
    """
    return json.loads(_described(effect))


class Parameters(Mapping[str, Parameter]):
    """The keys of a scene. An unknown key is an error, which suggests the nearest key."""

    def __init__(self, effect: str, values: Mapping[str, object]) -> None:
        self._all: dict[str, Parameter] = {}
        for p in describe(effect)["parameters"]:
            if p["name"] in values:
                self._all[p["name"]] = Parameter(p["name"], values[p["name"]], p["type"], p["unit"], p["minimum"], p["maximum"], p["default"],
                                                 p["sentence"], tuple(p.get("choices", ())))

    def __getitem__(self, key: str) -> Parameter:
        if key not in self._all:
            raise unknown("a key of this scene", key, self._all)
        return self._all[key]

    def __contains__(self, key: object) -> bool:
        return key in self._all

    def __iter__(self) -> Iterator[str]:
        return iter(self._all)

    def __len__(self) -> int:
        return len(self._all)

    def __repr__(self) -> str:
        return "\n".join(f"{p.name} = {p.value!r}{' ' + p.unit if p.unit not in ('', '1') else ''}" for p in self.values())


def toml(value: object) -> str:
    """Writes a value as in a scene file.

    >>> [toml(v) for v in (True, 2, 0.5, (640, 480), "street")]
    ['true', '2', '0.5', '[640, 480]', '"street"']
    """
    if hasattr(value, "tolist"):
        value = value.tolist()  # a NumPy array
    if isinstance(value, (tuple, list)):
        return "[" + ", ".join(toml(v) for v in value) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    return repr(value) if isinstance(value, (int, float)) else json.dumps(str(value), ensure_ascii=False)


def changes(values: Mapping[str, object] | None) -> list[str]:
    """Converts {"rain.rate": 20} or {"rain": {"rate": 20}} to arguments of `--set`.

    >>> changes({"rain": {"rate": 20}, "run.size": (4, 3)})
    ['rain.rate=20', 'run.size=[4, 3]']
    """
    out = []
    for key, value in (values or {}).items():
        if isinstance(value, Mapping):
            out += changes({f"{key}.{inner}": v for inner, v in value.items()})
        else:
            out.append(f"{key}={toml(value)}")
    return out
