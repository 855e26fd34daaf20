"""Packs and films written from Python: what the command line writes."""

import json
import os
import shutil
import subprocess

import pytest
from conftest import PUDDLE, ROOT

import rainref as rr

KEYS = [f"--set={word}" for word in rr.parameters.changes(PUDDLE)]


def program(*words, **more):
    done = subprocess.run([os.environ.get("RAINREF_PROGRAM", ROOT / "build/release/bin/rainref"), *map(str, words)], capture_output=True, text=True, **more)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def files(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


@pytest.fixture
def scene(tmp_path):
    (tmp_path / "rain.toml").write_text("effect = 'puddle'\nvariant = 'corrected'\nrun.frames = 5\n")
    return tmp_path / "rain.toml"


def test_a_pack_is_that_of_the_program(scene, tmp_path):
    done = []
    pack = rr.write_pack(scene, tmp_path / "a", PUDDLE, frames=[2, 0], passes=["display", "wave_step"], seed=9, progress=lambda *now: done.append(now))
    program("pack", scene, "-o", tmp_path / "b", "--at", "0,2", "--passes", "wave_step,display", "--seed", 9, *KEYS)
    assert files(tmp_path / "a") == files(tmp_path / "b")
    assert (pack.folder, pack.effect, pack.variant, pack.seed, pack.passes) == (tmp_path / "a", "puddle", "corrected", 9, ("wave_step", "display"))
    assert pack.cases == len(rr.Cases.of_pack(pack)) and done == [(1, 3), (2, 3), (3, 3)]
    sim = rr.open(scene, PUDDLE | {"seed": 9})
    sim.step()
    rr.write_pack(sim, tmp_path / "c", frames=[0, 2], passes=["wave_step", "display"])
    assert files(tmp_path / "c") == files(tmp_path / "a") and sim.frame == 1


def test_random_packs_differ_and_their_seeds_make_them_again(tmp_path):
    one, two = (rr.write_pack("puddle", tmp_path / name, PUDDLE, frames=[2], passes=["wave_step"], seed="random") for name in "ab")
    assert one.seed != two.seed and 0 <= min(one.seed, two.seed) and max(one.seed, two.seed) < 2**53
    assert json.loads((tmp_path / "a/manifest.json").read_text())["seed"] == one.seed
    rr.write_pack("puddle", tmp_path / "again", PUDDLE, frames=[2], passes=["wave_step"], seed=one.seed)
    assert files(tmp_path / "again") == files(tmp_path / "a")
    of_b = files(tmp_path / "b")
    assert all(of_b[name] != content for name, content in files(tmp_path / "a").items() if "/out." in name)


def test_packs_say_what_they_do_not_hold(tmp_path):
    pack = rr.write_pack("windshield", tmp_path / "p", {"run.size": (32, 18), "run.frames": 2, "scene.size": (32, 18),
                                                        "windshield.height_size": (64, 36), "wipers.count": 0})
    assert any(note.startswith("left out: wipe_drops: a port that does nothing passes") for note in pack.notes)
    assert "wipe_drops" not in pack.passes and "integrate" in pack.passes


def test_a_pack_that_is_refused_is_not_there(puddle, tmp_path):
    for seed in "luck", -1, 1.5, True, 2**63:
        with pytest.raises(rr.Error, match='seed: expected "random" or a whole number'):
            rr.write_pack(puddle, tmp_path / "p", seed=seed)
    with pytest.raises(rr.Error, match="did you mean 'display'"):
        rr.write_pack(puddle, tmp_path / "p", passes=["displya"])
    with pytest.raises(rr.Error, match="set: expected none beside a simulation"):
        rr.write_pack(puddle, tmp_path / "p", {"rain.rate": 3})

    def stop(done, of):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        rr.write_pack(puddle, tmp_path / "p", frames=[1], progress=stop)
    assert not list(tmp_path.iterdir())


@pytest.fixture
def ffmpeg(tmp_path, monkeypatch):
    """An ffmpeg whose film is what it was asked, and the pictures that it was given."""
    (tmp_path / "bin").mkdir()
    path = tmp_path / "bin/ffmpeg"
    path.write_text("#!/bin/sh\nfor last; do :; done\n{ echo \"$@\" | sed 's#file:.*##'; cat; } >\"${last#file:}\"\n")
    path.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path / 'bin'}:{os.environ['PATH']}")


@pytest.mark.parametrize("every", [1, 2])
def test_a_film_is_that_of_the_program(ffmpeg, scene, tmp_path, every):
    done = []
    sim = rr.open(scene, PUDDLE)
    sim.film(tmp_path / "a.mp4", every=every, progress=lambda *now: done.append(now))
    program("run", scene, *KEYS, "--film", tmp_path / "b.mp4", "--every", every, "--image", "none", "-o", tmp_path / "o")
    film = (tmp_path / "a.mp4").read_bytes()
    assert film == (tmp_path / "b.mp4").read_bytes() and len(film.split(b"\n", 1)[1]) == len(range(0, 5, every)) * 64 * 36 * 3
    assert done == [(k, 5) for k in range(1, 6)] and sim.frame == 5
    # Later frames are those of a simulation without a film, and so is the picture.
    other = rr.open(scene, PUDDLE)
    for _ in other.frames(5):
        pass
    assert (sim.picture == other.picture).all() and sim.step_hashes() == other.step_hashes()
    sim.film(tmp_path / "more.webm", 2)
    assert sim.frame == 8


@pytest.mark.skipif(not shutil.which("ffprobe"), reason="needs ffmpeg")
def test_a_real_film(puddle, tmp_path):
    puddle.film(tmp_path / "rain.mp4", 3)
    said = subprocess.run(["ffprobe", "-v", "error", "-count_frames", "-show_entries", "stream=width,height,nb_read_frames", "-of", "csv=p=0",
                           tmp_path / "rain.mp4"], capture_output=True, text=True, check=True)
    assert said.stdout.strip() == "64,36,3"


def test_a_film_that_is_refused_is_not_there(ffmpeg, puddle, tmp_path):
    with pytest.raises(rr.Error, match="ends in .mp4, .webm or .gif"):
        puddle.film(tmp_path / "a.avi", 3)
    with pytest.raises(rr.Error, match="film: every: expected 1 or more, found 0"):
        puddle.film(tmp_path / "a.mp4", 3, every=0)

    def stop(done, of):
        if done == 2:
            raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        puddle.film(tmp_path / "a.mp4", 3, progress=stop)
    assert [p.name for p in tmp_path.iterdir()] == ["bin"] and puddle.frame == 2
    (tmp_path / "bin/ffmpeg").unlink()
    (tmp_path / "bin/ffmpeg").symlink_to("/bin/false")
    with pytest.raises(rr.FileError, match="ffmpeg ended with exit code 1"):
        puddle.film(tmp_path / "a.mp4", 1)
