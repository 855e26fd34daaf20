"""A port that is a program of its own: it reads a pack's inputs as files and writes what it computes. It needs NumPy, and not rainref.

    rainref pack puddle/default.toml --size 320x180 --passes wave_step -o pack
    rainref validate pack --exec 'python3 file_port.py {pack} {out}'
"""

import json
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
from wave_step import F, wave_step

pack, out = Path(sys.argv[1]), Path(sys.argv[2])
for case in json.loads((pack / "manifest.json").read_text())["cases"]:
    if case["pass"] != "wave_step":
        continue
    inputs = SimpleNamespace(**{i["name"]: np.load(pack / i["file"]) for i in case["inputs"]})
    uniforms = SimpleNamespace(**{u["name"]: F(u["value"]) for u in case["uniforms"]})
    wave = next(i for i in case["inputs"] if i["name"] == "wave")
    file = out / case["outputs"][0]["file"]
    file.parent.mkdir(parents=True, exist_ok=True)
    np.save(file, wave_step(inputs, uniforms, (wave["address_u"], (wave["border"] or [0])[0])))
