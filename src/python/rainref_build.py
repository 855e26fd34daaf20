"""What `pip install .` runs: setuptools, and the library that scripts/build made put into the package."""

import re
import shutil
import subprocess
import tempfile
from pathlib import Path

from setuptools import build_meta as _setuptools
from setuptools.build_meta import *  # noqa: F403  the backend's functions
from setuptools.command.build_py import build_py
from wheel.bdist_wheel import bdist_wheel

_ROOT = Path(__file__).resolve().parents[2]
_BUILD = _ROOT / "build/release"
# Left over from another version they would go into the package.
shutil.rmtree(_ROOT / "build/python", ignore_errors=True)
(_ROOT / "build/python").mkdir(parents=True)

_HEADER = (_ROOT / "include/rainref/version.h").read_text()
VERSION = ".".join(re.search(rf"RAINREF_VERSION_{part} (\d+)", _HEADER)[1] for part in ("MAJOR", "MINOR", "PATCH"))

__all__ = [*_setuptools.__all__, "BuildPy", "BdistWheel", "VERSION"]


class BuildPy(build_py):
    """Adds the library and the module that reads pictures, as an installation has them: they find each other where they lie. Without a build
    there is none in the package, which then takes the system's."""

    def run(self) -> None:
        super().run()
        if self.editable_mode:
            return  # the package lies in the clone and finds its build folder
        if not (_BUILD / "lib/librainref.so.0").exists():
            self.warn("build/release/lib has no librainref.so.0, which scripts/build makes: the package will take the system's")
            return
        to = Path(self.build_lib) / "rainref/lib"
        to.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory() as staged:
            subprocess.run(["cmake", "--install", str(_BUILD), "--component", "python", "--strip", "--prefix", staged], check=True,
                           stdout=subprocess.DEVNULL)
            for file in Path(staged).rglob("*.so*"):
                if not file.is_symlink():
                    shutil.copy(file, to / ("librainref.so.0" if file.name.startswith("librainref") else file.name))


class BdistWheel(bdist_wheel):
    """For this machine's kind, and any Python 3: there is no extension module in it."""

    def finalize_options(self) -> None:
        super().finalize_options()
        self.root_is_pure = False

    def get_tag(self) -> tuple[str, str, str]:
        return "py3", "none", super().get_tag()[2]
