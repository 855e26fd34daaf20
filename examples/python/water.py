"""A puddle's water frame by frame, a key changed on the way, and what comes of it as files.

    python3 water.py [FOLDER]      # writes height.npy and puddle.png into the folder
"""

import sys
from pathlib import Path

import numpy as np
import rainref as rr

folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
sim = rr.open("puddle/default.toml", {"run.size": (320, 180), "environment.width": 512, "rain.rate": 20})
for frame in sim.frames(4):  # other threads of Python run meanwhile
    height = frame["wave"]  # float16 [m], a copy; frame.view("wave", 0) is none, and ends with the frame
    if frame.index == 1:
        state = sim.save()
sim.load(state).set("rain.rate", 60)  # back to frame 2, under heavier rain
for frame in sim.frames(2):
    heavier = frame["wave"]
np.save(folder / "height.npy", heavier[..., 0])
sim.write_png(folder / "puddle.png")
print(f"{heavier.shape} {heavier.dtype}, {np.count_nonzero(heavier != height)} of {heavier.size} heights are others under 60 mm/h")
