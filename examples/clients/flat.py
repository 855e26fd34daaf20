"""Reads a flat pack (`rainref pack --flat`) and writes a port's dump as raw bytes: what every client here does first and last."""
import json
import pathlib

import numpy

TYPES = {"rg16f": (numpy.float16, 2), "rgba16f": (numpy.float16, 4), "rgba8": (numpy.uint8, 4)}


def cases(folder, *passes):
    """The cases of these passes, in the order of execution."""
    flat = json.loads((pathlib.Path(folder) / "flat.json").read_text())
    return [case for case in flat["cases"] if case["pass"] in passes]


def data(folder, entry):
    """The bytes of an input or a uniform block."""
    return (pathlib.Path(folder) / entry["file"]).read_bytes()


def image(folder, entry):
    """An input image as (height, width, channels)."""
    kind, channels = TYPES[entry["format"]]
    return numpy.frombuffer(data(folder, entry), kind).reshape(entry["height"], entry["width"], channels)


def named(case, name):
    """The input of this name, or None where the case lacks it."""
    return next((entry for entry in case["inputs"] if entry["name"] == name), None)


def save(folder, output, texels):
    """Writes what a port stored for `output`: bytes of its format, rows from v = 0 on, without padding."""
    path = pathlib.Path(folder) / output["file"]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(texels)
    path.with_suffix(".json").write_text(json.dumps({key: output[key] for key in ("format", "width", "height")}))


def describe(folder, **about):
    """Writes port.json."""
    (pathlib.Path(folder) / "port.json").write_text(json.dumps(about))
