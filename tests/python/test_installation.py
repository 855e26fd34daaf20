"""`pip install .` from a clone, without a network, into an environment that has Debian's NumPy and setuptools."""

import os
import re
import shutil
import subprocess
import sys
import zipfile

import pytest
from conftest import ROOT

import rainref as rr
from rainref import _library

PROGRAM = """
import rainref, sys
sim = rainref.open("edge_splash", {"run.size": (16, 9)})
sim.step().picture
sim.write_exr(sys.argv[1])  # by the module that lies in the package
assert rainref.open("windshield/drive.toml", {"run.size": (16, 9), "windshield.height_size": (32, 18), "scene.size": (32, 18)}).effect == "windshield"
print(rainref.__version__, rainref._library._loaded._name)
"""


def run(*command, **how):
    done = subprocess.run(command, capture_output=True, text=True, **how)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.mark.skipif(not (ROOT / "build/release/lib/librainref.so.0").exists(), reason="scripts/build was not run")
def test_an_installed_package_stands_on_its_own(tmp_path):
    pytest.importorskip("wheel")
    run(sys.executable, "-m", "venv", "--system-site-packages", "--without-pip", tmp_path / "env")
    python = tmp_path / "env/bin/python"
    clean = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "RAINREF_LIBRARY")}
    run(python, "-m", "pip", "install", "-q", "--no-build-isolation", "--no-index", "--no-deps", ROOT, env=clean)
    version, library = run(python, "-c", PROGRAM, tmp_path / "a.exr", cwd=tmp_path, env=clean).split()
    assert version == rr.version() and library.startswith(str(tmp_path))
    assert (tmp_path / "a.exr").read_bytes()[:4] == b"\x76\x2f\x31\x01"
    # Nothing of it looks back into the clone.
    run_path = run("readelf", "-d", library)
    assert "$ORIGIN" in run_path and str(ROOT) not in run_path


def clone_without_a_build(folder, script):
    """What `pip install` reads of a clone, and a script in the place of scripts/build."""
    for name in "pyproject.toml", "README.md", "src/python", "include/rainref/version.h":
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        copy = shutil.copytree if (ROOT / name).is_dir() else shutil.copy
        copy(ROOT / name, folder / name)
    (folder / "scripts").mkdir()
    (folder / "scripts/build").write_text(f"#!/bin/sh\n{script}\n")
    (folder / "scripts/build").chmod(0o755)
    return folder


def wheel_of(clone, to):
    pytest.importorskip("wheel")
    return subprocess.run([sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-index", "--no-deps", "-w", to, clone],
                          capture_output=True, text=True)


@pytest.mark.skipif(not (ROOT / "build/release/lib/librainref.so.0").exists(), reason="scripts/build was not run")
def test_an_installation_from_a_fresh_clone_builds_the_library_first(tmp_path):
    clone = clone_without_a_build(tmp_path / "clone", f'cd "$(dirname "$0")/../build" && ln -s "{ROOT}/build/release" release')
    done = wheel_of(clone, tmp_path / "to")
    assert done.returncode == 0, done.stdout + done.stderr
    names = {name.split("/purelib/")[-1] for name in zipfile.ZipFile(next((tmp_path / "to").glob("*.whl"))).namelist()}
    assert {"rainref/lib/librainref.so.0", "rainref/share/rainref/scenes/puddle/default.toml", "rainref/share/rainref/presets/storm.toml",
            "rainref/py.typed"} <= names


def test_where_the_library_cannot_be_built_one_sentence_says_so(tmp_path):
    done = wheel_of(clone_without_a_build(tmp_path / "clone", "echo no compiler >&2; exit 1"), tmp_path / "to")
    said = done.stdout + done.stderr
    assert done.returncode != 0 and "no compiler" in said
    assert "rainref: build/release/lib has no librainref.so.0" in said and "did not make it: see what it says above" in said


def wheel_of_tree(tree, platform, to):
    pytest.importorskip("wheel")
    return subprocess.run([sys.executable, "-B", ROOT / "src/python/rainref_build.py", "--tree", tree, "--platform", platform, "-o", to],
                          capture_output=True, text=True)


def test_the_package_in_an_archive_finds_the_library_beside_it(tmp_path):
    shutil.copytree(ROOT / "src/python/rainref", tmp_path / "python/rainref", ignore=shutil.ignore_patterns("__pycache__"))
    (tmp_path / "lib").mkdir()
    (tmp_path / "lib/librainref.so.0").symlink_to(_library._loaded._name)
    clean = {k: v for k, v in os.environ.items() if k != "RAINREF_LIBRARY"} | {"PYTHONPATH": str(tmp_path / "python")}
    assert run(sys.executable, "-B", "-c", "import rainref; print(rainref._library._loaded._name)", env=clean, cwd=tmp_path).strip() \
        == str(tmp_path / "lib/librainref.so.0")


@pytest.mark.skipif(not (ROOT / "build/release/bin/rainref").exists(), reason="scripts/build was not run")
def test_a_wheel_of_an_installation_has_all_of_it(tmp_path):
    run("cmake", "--install", ROOT / "build/release", "--component", "python", "--prefix", tmp_path / "tree")
    made = wheel_of_tree(tmp_path / "tree", "linux_" + os.uname().machine, tmp_path / "to")
    assert made.returncode == 0, made.stderr
    wheel = made.stdout.strip()
    assert wheel == str(tmp_path / f"to/rainref-{rr.version()}-py3-none-linux_{os.uname().machine}.whl")
    run(sys.executable, "-m", "pip", "install", "-q", "--no-index", "--no-deps", "--target", tmp_path / "site", wheel)
    shutil.rmtree(tmp_path / "tree")
    (tmp_path / "empty").mkdir()
    clean = {k: v for k, v in os.environ.items() if k != "RAINREF_LIBRARY"} | {"PYTHONPATH": str(tmp_path / "site")}
    here = {"cwd": tmp_path / "empty", "env": clean}
    block = re.search(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.S)[1]
    said = run(sys.executable, "-c", block + "\nprint(rainref._library._loaded._name)", **here)
    assert "likely cause: not written" in said and said.splitlines()[-1].startswith(str(tmp_path / "site/rainref/lib"))
    # Its program finds its own data, and hands on its exit code.
    script = tmp_path / "site/bin/rainref"
    assert "\n  puddle/default.toml " in run(script, "list", **here)
    if (ROOT / "build/release/share/rainref/demo").exists():
        assert "likely cause: refraction ratio inverted" in run(script, "demo", **here)
    assert subprocess.run([script, "nonsense"], capture_output=True, **here).returncode == 2


def test_a_wheel_for_another_platform_has_its_files(tmp_path):
    tree = tmp_path / "tree"
    for file in "bin/rainref.exe", "bin/rainref.dll", "share/rainref/scenes/puddle/default.toml", "share/rainref/profiles/vulkan.toml":
        (tree / file).parent.mkdir(parents=True, exist_ok=True)
        (tree / file).write_text(file)
    made = wheel_of_tree(tree, "win_amd64", tmp_path / "to")
    assert made.returncode == 0 and made.stdout.strip().endswith("-py3-none-win_amd64.whl"), made.stderr
    names = {name.split("/purelib/")[-1] for name in zipfile.ZipFile(made.stdout.strip()).namelist()}
    assert {"rainref/lib/rainref.dll", "rainref/bin/rainref.exe", "rainref/share/rainref/scenes/puddle/default.toml",
            "rainref/share/rainref/profiles/vulkan.toml", "rainref_program.py"} <= names
    assert not any("librainref" in name for name in names)


def test_a_tree_without_a_library_is_one_clear_error(tmp_path):
    made = wheel_of_tree(tmp_path, "linux_x86_64", tmp_path / "to")
    assert made.returncode == 1 and "expected one of librainref.so.0, rainref.dll, librainref.0.dylib in its lib or bin" in made.stderr
    assert not (tmp_path / "to").exists() and "Traceback" not in made.stderr


def test_a_missing_library_is_one_clear_error(tmp_path):
    done = subprocess.run([sys.executable, "-c", "import rainref"], capture_output=True, text=True,
                          env=os.environ | {"PYTHONPATH": str(ROOT / "src/python"), "RAINREF_LIBRARY": str(tmp_path / "none.so")})
    assert done.returncode == 1 and "ImportError: rainref needs librainref.so.0: scripts/build makes it" in done.stderr
    assert str(tmp_path / "none.so") in done.stderr
