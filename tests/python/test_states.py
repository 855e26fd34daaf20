"""States saved, loaded and copied; keys that change while a simulation runs."""

import copy
import io
import os
import pickle
from pathlib import Path

import numpy as np
import pytest
from conftest import PUDDLE, ROOT

import rainref as rr

SCENES = {
    "puddle": PUDDLE,
    "windshield": {"run.size": (32, 18), "scene.size": (32, 18), "windshield.height_size": (64, 36), "rain.rate": 100},
    "edge_splash": {"run.size": (32, 18)},
    "screen_drops": {"run.size": (32, 18), "flow.on": True, "flow.height_size": (37, 29), "flow.warm_up": 0.5},
    "rainy_glass": {"run.size": (32, 18), "maps.size": 16},
}


def advance(sim, count):
    for _ in sim.frames(count):
        pass
    return sim


@pytest.mark.parametrize("effect", rr.effects())
def test_another_simulation_goes_on_with_the_same_bits(effect):
    scene = SCENES[effect]
    one = advance(rr.open(effect, scene), 4)
    state = one.save()
    expected = [one.step_hashes() for _ in range(3)]
    for other in rr.open(effect, scene).load(state), one.load(state), pickle.loads(pickle.dumps(one.load(state))), copy.copy(one.load(state)):
        assert other.frame == 4 and other.save() == state
        assert [other.step_hashes() for _ in range(3)] == expected
    same = one.load(state).set("run.size", scene["run.size"])
    assert same is one and one.save() == state
    assert [one.step_hashes() for _ in range(3)] == expected


def test_states_in_files(puddle, tmp_path):
    state = advance(puddle, 2).save(tmp_path / "a.state")
    assert (tmp_path / "a.state").read_bytes() == state and [p.name for p in tmp_path.iterdir()] == ["a.state"]
    file = io.BytesIO()
    puddle.save(file)
    assert file.getvalue() == state
    for source in tmp_path / "a.state", str(tmp_path / "a.state"), io.BytesIO(state), bytearray(state), memoryview(state), np.frombuffer(state, np.uint8):
        puddle.step()
        assert puddle.load(source).frame == 2
    for call in lambda: puddle.save(tmp_path / "none/a.state"), lambda: puddle.load(tmp_path / "none.state"):
        with pytest.raises(rr.FileError, match="none.*No such file or directory"):
            call()
    with pytest.raises(TypeError):
        puddle.load(io.StringIO("text"))

    class Full(io.BytesIO):
        def write(self, _):
            raise OSError(28, "No space left on device")

    with pytest.raises(OSError, match="No space left"):
        puddle.save(Full())
    assert puddle.save() == state


def test_a_file_is_replaced_whole_and_nothing_else_is_touched(puddle, tmp_path):
    place, victim = tmp_path / "a.state", tmp_path / "victim"
    for name in "a.state.part", "victim":
        (tmp_path / name).write_text("mine")
    (tmp_path / "b.state.part").symlink_to(victim)
    state = advance(puddle, 1).save(place)
    puddle.save(tmp_path / "b.state")
    assert (tmp_path / "a.state.part").read_text() == "mine" and (tmp_path / "b.state.part").is_symlink() and victim.read_text() == "mine"
    umask = os.umask(0o027)
    try:
        puddle.save(tmp_path / "new.state")
        assert (tmp_path / "new.state").stat().st_mode & 0o777 == 0o640
        place.chmod(0o604)
        puddle.save(str(place))
        assert place.stat().st_mode & 0o777 == 0o604 and place.read_bytes() == state
    finally:
        os.umask(umask)
    # A link gives way, and what it leads to stays.
    (tmp_path / "link").symlink_to(victim)
    puddle.save(tmp_path / "link")
    assert victim.read_text() == "mine" and not (tmp_path / "link").is_symlink() and (tmp_path / "link").read_bytes() == state
    puddle.save("/dev/null")
    assert not Path("/dev/null").is_file()
    (tmp_path / "folder").mkdir()
    with pytest.raises(rr.FileError, match="folder': Is a directory"):
        puddle.save(tmp_path / "folder")
    assert not [p.name for p in tmp_path.iterdir() if p.name.startswith(".")]


def test_what_is_no_state_of_it_is_refused_and_nothing_changed(puddle):
    state = advance(puddle, 2).save()
    other = advance(rr.open("puddle", PUDDLE | {"rain.rate": 61}), 3)
    before, view = other.save(), other.view("wave", 0)
    damaged = bytearray(state)
    damaged[len(state) // 2] ^= 1
    for wrong, text in [(b"", "found other bytes"), (state[:-1], "cut short or lengthened"), (state + b"\0", "cut short or lengthened"),
                        (damaged, "damaged"), (state, "of another scene: expected 'rain.rate = 61")]:
        with pytest.raises(rr.Error, match=text):
            other.load(wrong)
    for key, value, text in [("rain.rte", 3, "did you mean 'rain.rate'"), ("rain.rate", "a lot", "rain.rate"), ("rain.rate", 900, "rain.rate"),
                             ("puddle.grid", (97, 64), "puddle.grid: cannot change while the simulation runs")]:
        with pytest.raises(rr.Error, match=text):
            other.set(key, value)
    assert other.save() == before and view.shape == (64, 96)  # nor was the view ended


def test_a_key_changes_what_comes(puddle):
    advance(puddle, 3)
    plain, later = copy.copy(puddle), copy.copy(puddle.set("rain.rate", 120))
    assert puddle.parameters["rain.rate"].value == 120 and puddle.frame == 3
    assert plain.parameters["rain.rate"].value == 60
    hashes = puddle.step_hashes()
    assert hashes != plain.step_hashes()
    assert later.parameters["rain.rate"].value == 120 and later.step_hashes() == hashes  # copies know what was set
    assert puddle.set("rain.rate", 60).set("rain.smallest_drop", 0.6).parameters["rain.smallest_drop"].value == 0.6


def test_a_view_ends_when_a_state_is_loaded_or_a_key_set(puddle):
    state = advance(puddle, 2).save()
    for change in lambda: puddle.load(state), lambda: puddle.set("rain.rate", 61), lambda: puddle.set("rain.rate", 60):
        frame = puddle.step()
        view = frame.view("wave", 0)
        puddle.save()
        assert view.shape == (64, 96)
        change()
        for use in lambda: view.max(), lambda: frame["wave"]:
            with pytest.raises(rr.StaleViewError):
                use()
    del view


def test_memory_that_an_operation_looks_into_outlives_a_set(puddle):
    puddle.step()
    first, view = puddle._handle, puddle.view("wave", 0)
    before = view.copy()
    seen = []

    def look(row):
        """In the midst of an operation on the view."""
        if not seen:
            puddle.set("rain.rate", 90)
            puddle.step()
        seen.append(row.copy())
        return 0

    np.apply_along_axis(look, 1, view)
    assert puddle._handle is not first and puddle.frame == 2
    np.testing.assert_array_equal(seen, before)
    second, kept = puddle._handle, puddle.view("wave", 0)
    puddle.set("rain.rate", 80)
    assert puddle._handle is second  # where nothing looks, nothing is opened twice, whatever views there are
    with pytest.raises(rr.StaleViewError):
        kept.max()


@pytest.mark.parametrize("effect", rr.effects())
def test_memory_that_an_array_looks_into_outlives_a_load(effect):
    sim = rr.open(effect, SCENES[effect])
    first = sim.save()
    later = advance(sim, 2).save()

    def addresses():
        images = [name for name in sim.buffers if sim[name].dtype.names is None]
        return {sim.view(name, channel=0).ctypes.data for name in images}

    before = addresses()
    assert len(before) >= 3
    for state in first, later, first:
        assert addresses() == before and sim.load(state).save() == state
    assert addresses() == before


def test_relative_files_of_a_scene_are_found_after_a_change_of_folder(tmp_path, monkeypatch):
    (tmp_path / "a.toml").write_text("effect = 'edge_splash'\n[run]\nsize = [16, 9]\n")
    monkeypatch.chdir(tmp_path)
    sim = advance(rr.open("a.toml"), 1)
    monkeypatch.chdir(ROOT)
    assert copy.copy(sim).step_hashes() == sim.step_hashes()


def test_an_error_names_the_file_that_the_state_comes_from(puddle, tmp_path):
    path = tmp_path / "saved: twice.state"
    path.write_bytes(puddle.save()[:-20])
    with pytest.raises(rr.Error) as error:
        puddle.load(path)
    assert str(error.value).startswith(f"{path}: ") and "state: " not in str(error.value)[len(str(path)):]
    with pytest.raises(rr.Error, match="^state: "):
        puddle.load(path.read_bytes())
