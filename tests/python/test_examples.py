"""The examples run and hold what they say; they measure by themselves."""

import os
import subprocess
import sys

from conftest import PACKS, ROOT


def test_waves(tmp_path):
    done = subprocess.run([sys.executable, "-B", ROOT / "examples/python/waves.py", tmp_path], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stderr == "" and "the literal 4 is about 3.9 in the port" in done.stdout
    assert {"puddle.png", "verdict.html"} <= {p.name for p in tmp_path.iterdir()}


def run(name, folder):
    done = subprocess.run([sys.executable, "-B", ROOT / "examples/python" / name, *folder], capture_output=True, text=True, cwd=ROOT)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_water(tmp_path):
    assert "(512, 768, 2) float16, " in run("water.py", [tmp_path])
    assert {"height.npy", "puddle.png"} <= {p.name for p in tmp_path.iterdir()}


def test_a_port_in_process(tmp_path):
    assert "status: PASS causes: []" in run("numpy_port.py", [tmp_path])
    assert (tmp_path / "verdict.html").stat().st_size > 10000


def test_a_port_in_files(tmp_path):
    pack = PACKS / "puddle-corrected"
    run("file_port.py", [pack, tmp_path])
    done = subprocess.run([os.environ["RAINREF_PROGRAM"], "validate", pack, "--port", tmp_path, "--only", "wave_step"], capture_output=True,
                          text=True)
    assert done.returncode == 0 and "PASS  wave_step" in done.stdout, done.stdout + done.stderr


def test_the_readmes_program(monkeypatch, capsys):
    text = (ROOT / "README.md").read_text()
    program = text.split("```python\n")[1].split("```")[0]
    monkeypatch.chdir(ROOT)
    small = '(32, 18), "puddle.grid": (96, 64), "environment.image": "tests/packs/sky.png"'  # the street takes a second
    exec(compile(program.replace("(320, 180)", small), "README.md", "exec"), {})
    assert "FAIL  display" in capsys.readouterr().out
