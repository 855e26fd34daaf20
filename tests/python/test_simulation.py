"""Scenes, buffers and views."""

import concurrent.futures
import copy
import io
import pickle
import struct
import sys
import warnings
import zlib

import numpy as np
import pytest
from conftest import PUDDLE, ROOT

import rainref as rr


def test_golden_hashes():
    scene = ROOT / "tests/c_library/scenes/edge_splash_published.toml"
    name = scene.read_text().split("\n")[0].removeprefix("# ")
    recorded = set((ROOT / "tests/golden/hashes.txt").read_text().splitlines())
    sim = rr.open(scene)
    for frame in range(3):
        hashes = sim.step_hashes()
        assert len(hashes) == 5
        for (which, buffer), value in hashes.items():
            assert f"{name} {frame} {which} {buffer} {value}" in recorded


def test_scenes_may_be_given_in_every_form(tmp_path):
    text = "effect = 'edge_splash'\n[run]\nsize = [16, 9]\nframes = 7\n"
    (tmp_path / "a.toml").write_text(text)
    forms = [text, tmp_path / "a.toml", str(tmp_path / "a.toml"), {"effect": "edge_splash", "run": {"size": (16, 9), "frames": 7}}]
    hashes = [rr.open(form).step_hashes() for form in forms]
    hashes.append(rr.open("edge_splash", {"run.size": np.array([16, 9]), "run.frames": 7}, threads=2).step_hashes())
    assert all(h == hashes[0] for h in hashes)
    assert [len(rr.open(form)) for form in forms] == [7, 7, 7, 7]


def test_frames_and_buffers(puddle):
    assert puddle.effect == "puddle" and puddle.variant == "corrected" and puddle.buffers[0] == "wave"
    seen = [frame["wave"] for frame in puddle.frames(3)]
    assert puddle.frame == 3 and seen[0].shape == (64, 96, 2) and seen[0].dtype == np.float16
    assert not np.array_equal(seen[1], seen[2])
    assert puddle.picture.shape == (36, 64, 4) and puddle.picture.dtype == np.uint8
    # What was the newest level is the previous one a step later, but for the drops that fell.
    one = rr.open("puddle", PUDDLE | {"run.fps": 240.0, "rain.rate": 0})
    levels = [one.step()["wave"] for _ in range(2)]
    np.testing.assert_array_equal(levels[0][..., 0], levels[1][..., 1])
    assert len(list(rr.open("edge_splash", {"run.size": (9, 9), "run.frames": 4}))) == 4


def test_records_have_the_names_of_their_members():
    sim = rr.open("windshield", {"run.size": (32, 18), "scene.size": (32, 18), "windshield.height_size": (64, 36), "rain.rate": 100,
                                 "windshield.capacity": 3000})
    for _ in range(3):
        sim.step()
    drops = sim["drops"]
    assert len(drops) > 0 and set(drops.dtype.names) >= {"position", "velocity", "mass", "id"}
    assert drops["position"].shape == (len(drops), 2) and len(np.unique(drops["id"])) == len(drops)
    with pytest.raises(rr.Error, match="records have no view"):
        sim.view("drops")


def test_a_view_is_no_copy_and_ends_with_its_frame(puddle):
    frame = puddle.step()
    view = frame.view("wave", channel=0)
    np.testing.assert_array_equal(view, puddle["wave"][..., 0])
    assert not view.flags.writeable and view.strides[0] > 96 * 2  # rows of the library's own, with margins
    part, kept = view[3:9, ::2], view.copy()
    assert float(view.max()) == float(kept.max()) and (view + 1).dtype == np.float16
    np.testing.assert_array_equal(part[::-1, 1], kept[3:9, ::2][::-1, 1])
    assert part.ctypes.data == view.ctypes.data + 3 * view.strides[0] and frame.view("wave", 1).ctypes.data != view.ctypes.data
    puddle.step()
    for use in (lambda: frame["wave"], lambda: frame.view("wave", 0), lambda: frame.picture, lambda: part + 1, lambda: part[0]):
        with pytest.raises(rr.StaleViewError):
            use()
    assert kept.sum() == kept[:].sum()  # a copy is never stale
    with pytest.raises(rr.Error, match="its 2 channels lie apart"):
        puddle.view("wave")
    with pytest.raises(rr.Error, match="channel from 0 to 1, found 2"):
        puddle.view("wave", 2)


def test_a_view_is_used_like_an_array(puddle):
    view, kept = puddle.step().view("wave", 0), puddle["wave"][..., 0]
    assert view.shape == kept.shape and len(view) == len(kept) and view.dtype == kept.dtype and view.T.shape == kept.T.shape
    for ours, array in ((view == kept, kept == kept), (kept == view, kept == kept), (view != kept, kept != kept), (1 - view, 1 - kept),
                        (np.flip(view, 0), kept[::-1]), (np.stack([view, view]), np.stack([kept, kept])), (view @ kept.T, kept @ kept.T),
                        (np.array(view), kept), (np.asarray(view, np.float32), kept.astype(np.float32)), (copy.copy(view), kept),
                        (copy.deepcopy(view), kept), (pickle.loads(pickle.dumps(view)), kept), (list(view)[1], kept[1]),
                        (np.frombuffer(bytes(view), np.float16), kept.ravel()), (view[view > 0], kept[kept > 0]), (view.reshape(-1), kept.ravel()),
                        (np.add.reduce(view), np.add.reduce(kept)), (view[2, 3], kept[2, 3]), (view.clip(0, view.max()), kept.clip(0, kept.max()))):
        np.testing.assert_array_equal(ours, array)
    assert float(view[..., 2, 3]) == float(kept[2, 3]) and kept[2, 3] in view and "float16" in repr(view) and str(view) == str(kept)
    with pytest.raises(ValueError, match="ambiguous"):
        bool(view)
    sums = np.zeros_like(kept)
    part = sums[2:4]
    part += view[2:4]
    np.testing.assert_array_equal(sums[2:4], kept[2:4])
    assert part.base is sums


def test_whatever_is_done_with_a_stale_view_raises(puddle):
    view, other = puddle.step().view("wave", 0), puddle["wave"][..., 0]
    flat, maximum, rows = view[0], view.max, iter(view)
    puddle.step()
    uses = [lambda: view == other, lambda: other == view, lambda: view != other, lambda: other != view, lambda: view < other, lambda: other < view,
            lambda: view == view, lambda: view == 1, lambda: 1 == view, lambda: other[0, 0] in view, lambda: view in [other],
            lambda: np.array(view), lambda: np.asarray(view), lambda: np.ascontiguousarray(view), lambda: np.array([view]), lambda: np.float32(view),
            lambda: bytes(view), lambda: copy.copy(view), lambda: copy.deepcopy(view), lambda: pickle.dumps(view), lambda: view.copy(),
            lambda: len(view), lambda: other.__setitem__(slice(None), view), lambda: np.copyto(other, view), lambda: other.__iadd__(view),
            lambda: view[0, 0], lambda: view + 1, lambda: 1 - view, lambda: other + view, lambda: -view, lambda: view @ other.T, lambda: view.max(),
            lambda: maximum(), lambda: np.sum(view), lambda: np.stack([view, view]), lambda: np.array_equal(view, other), lambda: np.flip(view),
            lambda: list(view), lambda: next(rows), lambda: view.shape, lambda: view.T, lambda: view.flags, lambda: view.tobytes(),
            lambda: view.tolist(), lambda: view.ctypes, lambda: repr(view), lambda: str(view), lambda: f"{view}", lambda: bool(view),
            lambda: float(flat[:1]), lambda: flat.sum(), lambda: np.save(io.BytesIO(), view), lambda: rr.shown(view), lambda: rr.shown(flat)]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # NumPy 1.24 says so of a comparison that raises
        for number, use in enumerate(uses):
            with pytest.raises(rr.StaleViewError):
                use()
                pytest.fail(f"use {number}")
        # Before Python 3.12 a class has no say in it: there is no memory to be had at all.
        with pytest.raises(rr.StaleViewError if sys.version_info >= (3, 12) else TypeError):
            memoryview(view)


def test_nothing_writes_through_a_view(puddle):
    view = puddle.step().view("wave", 0)
    state, part = puddle.save(), view[2:4]
    for write in (lambda: setattr(view.flags, "writeable", True), lambda: view.setflags(write=True), lambda: setattr(part.flags, "writeable", True),
                  lambda: view.fill(1), lambda: np.copyto(view, 1), lambda: np.add(view, 1, out=view), lambda: view.sort(),
                  lambda: view.__iadd__(1), lambda: np.put(view, 0, 1)):
        with pytest.raises(ValueError):
            write()
    with pytest.raises(TypeError):
        view[0, 0] = 1
    with pytest.raises(AttributeError, match="cannot be set"):
        view.shape = (1,)
    for array in np.asarray(view), view.T, view.view(np.uint16), view.reshape(-1), np.flip(view), np.squeeze(view), np.split(view, 2)[0], view.real:
        array = np.array(array, copy=False) if isinstance(array, np.ndarray) else array
        if array.flags.writeable:
            array[...] = 1  # a copy
    view.flat[0] = 1
    assert puddle.save() == state


def test_a_wave_of_8_bits(tmp_path):
    sim = rr.open("puddle", PUDDLE | {"puddle.storage": "rgba8", "rain.rate": 200})
    frame = [frame for frame in sim.frames(3)][-1]
    wave = frame["wave"]
    assert wave.shape == (64, 96, 4) and wave.dtype == np.uint8 and wave[..., :2].min() < wave[..., :2].max() and not wave[..., 2:].any()
    for channel in 0, 1:
        np.testing.assert_array_equal(frame.view("wave", channel), wave[..., channel])
    with pytest.raises(rr.Error, match="wave: channel 2 is 0 everywhere and is not kept; expected one from 0 to 1"):
        frame.view("wave", 2)
    # It is what the next frame's pass takes.
    cases = rr.Cases.of_simulation(sim)
    cases.add_next_frame(sim, ["wave_step"])
    np.testing.assert_array_equal(cases[0].inputs.wave, wave)
    np.testing.assert_array_equal(cases[-1].expected["wave"], sim["wave"])


def test_parameters_by_key(puddle):
    rate = puddle.parameters["rain.rate"]
    assert (rate.value, rate.unit, rate.minimum, rate.maximum) == (60, "mm/h", 0, 200)
    assert puddle.parameters["puddle.grid"].value == [96, 64] and "puddle.shape" in puddle.parameters
    assert "rain.rate = 60.0 mm/h" in repr(puddle.parameters)
    with pytest.raises(ValueError, match="'rain.rte' is not a key of this scene; did you mean 'rain.rate'"):
        puddle.parameters["rain.rte"]


@pytest.mark.parametrize("scene, set, text", [
    ("puddle", {"rain.rate": 900}, "rain.rate"),
    ("puddle", {"rain.rte": 9}, "did you mean 'rain.rate'"),
    ("puddle", {"run.size": (0, 4)}, "run.size"),
    ({"effect": "pudle"}, None, "did you mean 'puddle'"),
    ("effect = 'puddle'\n[wave]\nspeeed = 1\n", None, "scene:3:1: wave.speeed"),
])
def test_bad_scenes_are_value_errors(scene, set, text):
    with pytest.raises(ValueError, match=text):
        rr.open(scene, set)


def test_files_that_are_not_there(puddle, tmp_path):
    with pytest.raises(OSError, match="none.toml") as caught:
        rr.open(tmp_path / "none.toml")
    assert isinstance(caught.value, rr.Error) and caught.value.code == 4
    for wrong, meant in (("puddel", "puddle"), ("puddle/defualt.toml", "puddle/default.toml"), ("scenes/puddle/analytik.toml", "puddle/analytic.toml")):
        with pytest.raises(rr.FileError, match=f"cannot read '{wrong}': No such file or directory; did you mean '[a-z/]*{meant}'"):
            rr.open(wrong)
    puddle.step()
    with pytest.raises(rr.FileError, match="nowhere"):
        puddle.write_png(tmp_path / "nowhere/a.png")
    puddle.write_png(tmp_path / "a.png")
    assert (tmp_path / "a.png").read_bytes()[1:4] == b"PNG"


def test_simulations_run_in_threads_at_once():
    def run(_):
        sim = rr.open("puddle", PUDDLE, threads=1)
        return [sim.step_hashes() for _ in range(3)]

    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        all_of_them = list(pool.map(run, range(4)))
    assert all(one == all_of_them[0] for one in all_of_them)


def test_shown_pictures_have_their_top_row_first(puddle):
    puddle.step()
    np.testing.assert_array_equal(rr.shown(puddle.picture), puddle.picture[::-1, :, :3])
    heights = rr.shown(puddle["wave"])
    assert heights.dtype == np.uint8 and heights.min() == 0 and heights.max() == 255


def decoded(png):
    """Pixels of a PNG of 8 bits whose rows have no filter, and the kinds of its chunks."""
    at, chunks = 8, {}
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at:at + 8])
        content = png[at + 8:at + 8 + length]
        assert struct.unpack(">I", png[at + 8 + length:at + 12 + length])[0] == zlib.crc32(kind + content)
        chunks[kind] = content
        at += 12 + length
    assert png.startswith(b"\x89PNG\r\n\x1a\n") and list(chunks) == [b"IHDR", b"IDAT", b"IEND"]
    width, height, bits, colour = struct.unpack(">IIBB", chunks[b"IHDR"][:10])
    rows = np.frombuffer(zlib.decompress(chunks[b"IDAT"]), np.uint8).reshape(height, -1)
    assert bits == 8 and not rows[:, 0].any()
    return rows[:, 1:].reshape((height, width, 3) if colour == 2 else (height, width))


def test_a_notebook_shows_the_picture(puddle, tmp_path):
    assert puddle._repr_png_() is None  # and so shows the text
    frame = puddle.step()
    png = puddle._repr_png_()
    np.testing.assert_array_equal(decoded(png), rr.shown(puddle.picture))
    assert frame._repr_png_() == png
    np.testing.assert_array_equal(decoded(rr.pictures.png(rr.shown(puddle["wave"]))), rr.shown(puddle["wave"]))
    (tmp_path / "own.png").write_bytes(png)  # other readers read it, too
    rr.open("edge_splash", {"run.size": (64, 36), "scene.image": str(tmp_path / "own.png")}).step()
    puddle.step()
    with pytest.raises(rr.StaleViewError):
        frame._repr_png_()


def test_with_closes_a_simulation():
    with rr.open("puddle", PUDDLE) as sim:
        frame = sim.step()
        view, wave, cases = frame.view("wave", 0), frame["wave"], rr.Cases.of_simulation(sim)
        cases.add_next_frame(sim, ["display"])
        view = sim.view("wave", 0)
    assert wave.shape == (64, 96, 2) and cases[0].expected["picture"].any()
    for use in (lambda: view.max(), lambda: sim.view("wave", 0), lambda: sim["wave"], lambda: sim.step(), lambda: sim.frame, lambda: len(sim), lambda: sim.save(),
                lambda: sim.set("rain.rate", 3), lambda: rr.judge(sim, {"display": lambda i, u: 0})):
        with pytest.raises(rr.Error):
            use()
    with pytest.raises(rr.Error, match="this simulation of puddle is closed"):
        sim.step()
    assert repr(sim) == "<rainref puddle corrected, closed>" and sim._repr_png_() is None
    sim.close()
    with pytest.raises(KeyError):
        with rr.open("puddle", PUDDLE) as sim:
            raise KeyError
    assert "closed" in repr(sim)


def test_memory_that_an_operation_looks_into_outlives_a_close():
    sim = rr.open("puddle", PUDDLE)
    sim.step()
    view = sim.view("wave", 0)
    before, seen = view.copy(), []

    def look(row):
        sim.close()
        seen.append(row.copy())
        return 0

    np.apply_along_axis(look, 1, view)
    np.testing.assert_array_equal(seen, before)


def test_a_film_behind_a_windshield_and_a_wiper_on_its_side_window(tmp_path):
    for k in range(3):
        np.save(tmp_path / f"{k}.npy", np.full((9, 16, 3), 40 * k, np.uint8))
    scene = {"run.size": (16, 9), "run.frames": 3, "windshield.height_size": (24, 14), "scene.size": (16, 9), "scene.image": str(tmp_path / "%d.npy"),
             "windshield.panes": "1.0 0.75 0.95, 1.9 0.8 1.0, 1.1 0.7 1.4", "pane_1_wipers.count": 1}
    film = rr.open("windshield", scene)
    hashes = [film.step_hashes() for _ in range(3)]
    for k in range(3):
        still = rr.open("windshield", scene | {"scene.image": str(tmp_path / f"{k}.npy")})
        assert [still.step_hashes() for _ in range(k + 1)][k] == hashes[k]
    with pytest.raises(rr.Error, match="frame 3 needs .*3.npy'"):
        film.step()
