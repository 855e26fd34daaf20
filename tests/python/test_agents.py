"""docs/agents.md: short enough for a model's context, and every command and program on it does what the page says."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import ROOT

PAGE = (ROOT / "docs/agents.md").read_text()
PROGRAM = Path(os.environ.get("RAINREF_PROGRAM", ROOT / "build/release/bin/rainref"))


def blocks(language):
    return re.findall(rf"```{language}\n(.*?)```", PAGE, re.S)


def test_it_fits_into_a_context():
    assert len(PAGE.split()) <= 1500


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder in which all commands of the page ran, one after the other."""
    at = tmp_path_factory.mktemp("agent")
    (at / "bin").mkdir()
    (at / "bin/python3").write_text(f'#!/bin/sh\nexec "{sys.executable}" -B "$@"\n')
    (at / "bin/python3").chmod(0o755)
    (program,) = blocks("python")
    (at / "port.py").write_text(program)
    for block in blocks("sh"):
        done = shell(block, at)
        assert done.returncode == 0, block + done.stdout + done.stderr
    return at


def shell(command, at):
    return subprocess.run(["bash", "-ec", command], cwd=at, capture_output=True, text=True,
                          env=os.environ | {"PATH": f"{at / 'bin'}:{PROGRAM.parent}:{os.environ['PATH']}"})


def verdict(at):
    return json.loads((at / "verdict.json").read_text())


def test_its_commands_lead_to_a_verdict_on_a_fresh_pack(folder):
    commands = "".join(blocks("sh"))
    assert len(re.findall("^rainref ", commands, re.M)) == len(commands.splitlines()) >= 7
    judged = verdict(folder)
    assert judged["status"] == "PASS" and judged["exit_code"] == 0 and judged["pack"].endswith("fresh")
    assert [p["pass"] for p in judged["passes"] if p["status"] == "PASS"] == ["display"]
    seeds = [json.loads((folder / name / "manifest.json").read_text())["seed"] for name in ("practice", "fresh")]
    assert seeds[0] == 1 != seeds[1]
    described = json.loads((folder / "puddle.json").read_text())
    assert {"name", "reads", "writes", "formulas"} <= set(described["passes"][0]) and {"format", "unit", "range"} <= set(described["buffers"][0])


def test_the_keys_it_names_are_there(folder):
    """Those of a case of a pack; and of a verdict on the same port with a mistake, whose cause is found."""
    case = json.loads((folder / "practice/manifest.json").read_text())["cases"][0]
    table = re.search(r"\| key of a case \|.*?\n\n", PAGE, re.S)[0]
    for row in table.strip().splitlines()[2:]:
        names, meaning = re.findall(r"`([^`]+)`", row.split("|")[1]), row.split("|")[2]
        for name in names:
            at = case
            for part in name.split("."):
                assert part in at or part == "level", name
                at = at.get(part)
            for inner in re.findall(r"`([a-z_]+)`", re.split(r"\(|; a list", meaning)[0]) if isinstance(at, list) else []:
                assert inner in at[0], (name, inner)
    (folder / "wrong.py").write_text((folder / "port.py").read_text().replace('"picture": picture}', '"picture": picture[::-1]}'))
    done = shell("rainref validate practice --exec 'python3 wrong.py {pack} {out}' --only display --json verdict.json", folder)
    assert done.returncode == 1
    failed = verdict(folder)
    assert failed["first_bad_pass"] == "display" and failed["status"] == "FAIL"
    (one,) = [p for p in failed["passes"] if p["pass"] == "display"]
    section = PAGE[PAGE.index("Keys of `verdict.json`"):PAGE.index("## 7.")]
    for name in re.findall(r"`(passes\[\][^`]*)`", section):
        assert re.fullmatch(r"passes\[\](\.causes\[\]|\.cases\[\]\.outputs\[\]\.worst\[\]|\.coverage\.never)?", name), name
    cause, worst = one["causes"][0], one["cases"][0]["outputs"][0]["worst"][0]
    assert {"name", "sentence", "is_likely", "explained", "of"} <= set(cause) and cause["name"] == "upside down", cause
    assert {"x", "y", "channel", "got", "low", "high"} <= set(worst) and "value" in worst["got"]
    assert one["where"] is not None and one["figures"]["failing"] > 0 and one["figures"]["invocations"] > 0 and "never" in one["coverage"]
    # A missing file is named.
    (folder / "nothing.py").write_text("")
    done = shell("rainref validate practice --exec 'python3 nothing.py {pack} {out}' --only display --json verdict.json", folder)
    assert done.returncode in (1, 3)
