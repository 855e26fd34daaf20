"""A port of a pass, judged in process: no files, no compiler.

    python3 numpy_port.py [FOLDER]      # writes verdict.html into the folder

It ends with exit code 0 where the port is good.
"""

import sys
from pathlib import Path

import rainref as rr
from wave_step import wave_step


@rr.port("puddle.wave_step")  # here in NumPy; Numba, wgpu, CUDA and others alike
def my_port(inputs, uniforms, case):
    sampling = case.sampling("wave")
    return wave_step(inputs, uniforms, (sampling.address[0], sampling.border[0]))


KEYS = {"run.size": (320, 180), "environment.width": 64, "rain.rate": 20, "puddle.grid": (384, 256)}  # waves do not see the street
sim = rr.open("puddle/default.toml", KEYS)
verdict = rr.judge(sim, ports=[my_port], frames=(0, 1, 12), profile="vulkan")
print(verdict)
verdict.html(Path(sys.argv[1] if len(sys.argv) > 1 else ".") / "verdict.html")
print("status:", verdict.status, "causes:", [cause.name for cause in verdict["wave_step"].causes])

state = sim.save()  # the same bits from here on, in another process too
again = rr.open("puddle/default.toml", KEYS).load(state)
assert again.frame == sim.frame and (again["wave"] == sim["wave"]).all()
sys.exit(0 if verdict.ok else 1)
