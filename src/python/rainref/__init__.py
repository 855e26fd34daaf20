"""rainref for Python: runs scenes, returns their buffers as arrays, and judges ports.

>>> import rainref
>>> sim = rainref.open("edge_splash", {"run.size": (32, 18)})
>>> for frame in sim.frames(2):
...     picture = frame.picture  # a copy
>>> picture.shape, picture.dtype
((18, 32, 4), dtype('uint8'))

It calls librainref.so and needs NumPy, but no compiler. A failure raises `Error`, a ValueError. It names the place, the key, what was
expected, what was found and the nearest valid name.
"""

from ._library import golden_generation, keep_images, version
from .cases import Case, Cases, Inputs
from .codes import from_srgb8, from_unorm8, srgb8, unorm8
from .errors import Error, FileError, StaleViewError
from .judging import Cause, Failure, PassVerdict, Port, Verdict, judge, judge_folder, port
from .packs import Pack, write_pack
from .parameters import Parameter, describe, effects, profiles
from .pictures import show, shown
from .simulation import Frame, Simulation, open
from .views import View

__version__ = version()
__all__ = [
    "Case", "Cases", "Cause", "Error", "Failure", "FileError", "Frame", "Inputs", "Pack", "Parameter", "PassVerdict", "Port",
    "Simulation", "StaleViewError", "Verdict", "View", "describe", "effects", "from_srgb8", "from_unorm8", "golden_generation", "judge", "judge_folder",
    "keep_images", "open", "port", "profiles", "show", "shown", "srgb8", "unorm8", "version", "write_pack",
]
