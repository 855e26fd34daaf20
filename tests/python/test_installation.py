"""`pip install .` from a clone, without a network, into an environment that has Debian's NumPy and setuptools."""

import os
import subprocess
import sys

import pytest
from conftest import ROOT

import rainref as rr

PROGRAM = """
import rainref, sys
sim = rainref.open("edge_splash", {"run.size": (16, 9)})
sim.step().picture
sim.write_png(sys.argv[1])  # by the module that lies in the package
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
    version, library = run(python, "-c", PROGRAM, tmp_path / "a.png", cwd=tmp_path, env=clean).split()
    assert version == rr.version() and library.startswith(str(tmp_path))
    assert (tmp_path / "a.png").read_bytes()[1:4] == b"PNG"
    # Nothing of it looks back into the clone.
    run_path = run("readelf", "-d", library)
    assert "$ORIGIN" in run_path and str(ROOT) not in run_path


def test_a_missing_library_is_one_clear_error(tmp_path):
    done = subprocess.run([sys.executable, "-c", "import rainref"], capture_output=True, text=True,
                          env=os.environ | {"PYTHONPATH": str(ROOT / "src/python"), "RAINREF_LIBRARY": str(tmp_path / "none.so")})
    assert done.returncode == 1 and "ImportError: rainref needs librainref.so.0: scripts/build makes it" in done.stderr
    assert str(tmp_path / "none.so") in done.stderr
