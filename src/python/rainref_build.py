"""Build backend of `pip install .`: setuptools, which also puts the library, the program and their data into the package. scripts/build
makes the library if it does not exist yet.

    python3 src/python/rainref_build.py --tree FOLDER --platform manylinux_2_28_x86_64 -o OUT

makes a wheel of an installation or an unpacked archive (bin, lib, share/rainref), for the platform that its files are of."""

import argparse
import os
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
#: Of the library, by platform: what _library.py loads.
LIBRARIES = ("librainref.so.0", "rainref.dll", "librainref.0.dylib")
#: The tree and the tag of the wheel, told to setuptools' commands, which know no options of ours.
TREE, PLATFORM = "RAINREF_WHEEL_TREE", "RAINREF_WHEEL_PLATFORM"

__all__ = [*_setuptools.__all__, "BuildPy", "BdistWheel", "VERSION"]


class BuildPy(build_py):
    """Adds the library, the program, the module that reads pictures, and the data, in the layout of an installation, so that they find each
    other."""

    def run(self) -> None:
        super().run()
        to = Path(self.build_lib) / "rainref"
        if TREE in os.environ:
            _take(Path(os.environ[TREE]), to)
            return
        _make_library()
        if self.editable_mode:
            return  # the package lies in the clone and finds its build folder
        with tempfile.TemporaryDirectory() as staged:
            subprocess.run(["cmake", "--install", str(_BUILD), "--component", "python", "--strip", "--prefix", staged], check=True,
                           stdout=subprocess.DEVNULL)
            _take(Path(staged), to)


def _take(tree: Path, to: Path) -> None:
    """Copies what the package needs of an installation. Links, such as librainref.so, become no second copy."""
    library = _library_of(tree)
    (to / "lib").mkdir(parents=True, exist_ok=True)
    shutil.copy(library, to / "lib" / library.name)
    for module in library.parent.glob("**/rainref_openimageio*"):
        (to / "lib/rainref").mkdir(exist_ok=True)
        shutil.copy(module, to / "lib/rainref" / module.name)
    for name in "rainref", "rainref.exe":
        if (tree / "bin" / name).exists():
            (to / "bin").mkdir(exist_ok=True)
            shutil.copy(tree / "bin" / name, to / "bin" / name)
    for data in "scenes", "presets", "pages", "profiles", "packs", "demo":
        if (tree / "share/rainref" / data).exists():
            shutil.copytree(tree / "share/rainref" / data, to / "share/rainref" / data, dirs_exist_ok=True)


def _library_of(tree: Path) -> Path:
    for name in LIBRARIES:
        for folder in tree / "lib", tree / "bin", *(tree / "lib").glob("*-linux-gnu"):
            if (folder / name).exists():
                return folder / name
    raise SystemExit(f"rainref: {tree}: expected one of {', '.join(LIBRARIES)} in its lib or bin, found none")


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
    """The tag: this platform or the one that was told, and any Python 3, because the wheel has no extension module."""

    def finalize_options(self) -> None:
        super().finalize_options()
        self.root_is_pure = False

    def get_tag(self) -> tuple[str, str, str]:
        return "py3", "none", os.environ.get(PLATFORM) or super().get_tag()[2]


def _main() -> None:
    parser = argparse.ArgumentParser(description="Makes a wheel of files that were built before, and prints its path.")
    parser.add_argument("--tree", required=True, type=Path, metavar="FOLDER", help="an installation, or an unpacked archive")
    parser.add_argument("--platform", required=True, metavar="TAG", help="manylinux_2_28_x86_64, manylinux_2_28_aarch64, win_amd64, ...")
    parser.add_argument("-o", "--output", required=True, type=Path, metavar="DIR", help="folder of the wheel")
    options = parser.parse_args()
    if not re.fullmatch(r"\w+", options.platform):
        parser.error(f"--platform: expected a tag such as manylinux_2_28_x86_64, found '{options.platform}'")
    _library_of(options.tree)  # or it would be found after the work
    output = options.output.resolve()
    output.mkdir(parents=True, exist_ok=True)
    os.environ |= {TREE: str(options.tree.resolve()), PLATFORM: options.platform}
    os.chdir(_ROOT)
    said = sys.stdout
    sys.stdout = sys.stderr  # what setuptools prints
    try:
        name = _setuptools.build_wheel(str(output))
    finally:
        sys.stdout = said
    print(output / name)


if __name__ == "__main__":
    _main()
