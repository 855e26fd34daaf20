"""The examples run and hold what they say; they measure by themselves."""

import subprocess
import sys

from conftest import ROOT


def test_waves(tmp_path):
    done = subprocess.run([sys.executable, "-B", ROOT / "examples/python/waves.py", tmp_path], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stderr == "" and "the literal 4 is about 3.9 in the port" in done.stdout
    assert {"puddle.png", "verdict.html"} <= {p.name for p in tmp_path.iterdir()}


def test_the_readmes_program(monkeypatch, capsys):
    text = (ROOT / "README.md").read_text()
    program = text.split("```python\n")[1].split("```")[0]
    monkeypatch.chdir(ROOT)
    small = '(32, 18), "puddle.grid": (96, 64), "environment.image": "tests/packs/sky.png"'  # the street takes a second
    exec(compile(program.replace("(320, 180)", small), "README.md", "exec"), {})
    assert "FAIL  display" in capsys.readouterr().out
