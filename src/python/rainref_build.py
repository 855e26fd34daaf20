"""Build backend of `pip install .`: setuptools, which also puts the library and its scenes into the package. scripts/build makes the
library if it does not exist yet."""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from setuptools import build_meta as _setuptools
from setuptools.build_meta import *  # noqa: F403  the backend's functions
from setuptools.command.build_py import build_py
from wheel.bdist_wheel import bdist_wheel

_ROOT = Path(__file__).resolve().parents[2]
_BUILD = _ROOT / "build/release"
# Files left over from another version would go into the package.
shutil.rmtree(_ROOT / "build/python", ignore_errors=True)
(_ROOT / "build/python").mkdir(parents=True)

_HEADER = (_ROOT / "include/rainref/version.h").read_text()
VERSION = ".".join(re.search(rf"RAINREF_VERSION_{part} (\d+)", _HEADER)[1] for part in ("MAJOR", "MINOR", "PATCH"))

__all__ = [*_setuptools.__all__, "BuildPy", "BdistWheel", "VERSION"]


class BuildPy(build_py):
    """Adds the library, the module that reads pictures, and the scenes, in the layout of an installation, so that they find each other."""

    def run(self) -> None:
        super().run()
        _make_library()
        if self.editable_mode:
            return  # the package lies in the clone and finds its build folder
        to = Path(self.build_lib) / "rainref"
        with tempfile.TemporaryDirectory() as staged:
            subprocess.run(["cmake", "--install", str(_BUILD), "--component", "python", "--strip", "--prefix", staged], check=True,
                           stdout=subprocess.DEVNULL)
            shutil.copytree(Path(staged) / "share", to / "share", dirs_exist_ok=True)
            (to / "lib").mkdir(parents=True, exist_ok=True)
            for file in (Path(staged) / "lib").glob("*.so*"):
                if not file.is_symlink():
                    shutil.copy(file, to / "lib" / ("librainref.so.0" if file.name.startswith("librainref") else file.name))


def _make_library() -> None:
    """Runs scripts/build if the library does not exist. This takes minutes, and installs missing packages if it is allowed to."""
    if (_BUILD / "lib/librainref.so.0").exists():
        return
    script = _ROOT / "scripts/build"
    made = subprocess.run([str(script)], stdout=sys.stderr).returncode if script.exists() else 1
    if made != 0:
        raise SystemExit(f"rainref: build/release/lib has no librainref.so.0, and {script} "
                         + ("did not make it: see what it says above" if script.exists() else "is not there: install from a clone"))


class BdistWheel(bdist_wheel):
    """The tag: this platform and any Python 3, because the wheel has no extension module."""

    def finalize_options(self) -> None:
        super().finalize_options()
        self.root_is_pure = False

    def get_tag(self) -> tuple[str, str, str]:
        return "py3", "none", super().get_tag()[2]
