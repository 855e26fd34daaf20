"""Ports judged in memory, on simulations and on packs."""

import shutil
import subprocess

import numpy as np
import numpy_ports as ports
import pytest
from conftest import PACKS, PUDDLE, ROOT

import rainref as rr

def test_a_right_port_passes(puddle):
    verdict = rr.judge(puddle, ports.right, frames=(0, 3))
    assert verdict.status == "PASS" and verdict.ok and verdict.profile == "vulkan" and verdict.first_bad_pass == ""
    judged = verdict["wave_step"]
    # Four steps a frame, two levels of each cell.
    assert judged.cases == 8 and judged.elements == 8 * 96 * 64 * 2 and judged.outside == 0 and not judged.worst
    assert puddle.frame == 4
    assert "wave_step" in str(verdict) and "PASS" in str(verdict)


def test_a_wrong_port_is_told_why(puddle, tmp_path):
    verdict = rr.judge(puddle, [ports.levels_exchanged], frames=[4, 6], profile="vulkan")
    judged = verdict["wave_step"]
    assert verdict.status == judged.status == "FAIL" and verdict.first_bad_pass == "wave_step" and not verdict.ok
    assert judged.outside > 0 and "first two channels swapped" in judged.causes[0].name
    assert judged.causes[0].is_likely and judged.causes[0].inside > 0.9 * judged.causes[0].of > 0
    worst = judged.worst[0]
    assert not worst.low <= worst.got <= worst.high and worst.low <= worst.expected <= worst.high
    assert worst.case.startswith("puddle.wave_step/000") and worst.output == "wave" and "accepted" in worst.text
    # The element is where it says.
    assert 0 <= worst.x < 96 and 0 <= worst.y < 64 and worst.channel in (0, 1)
    assert verdict.json()["status"] == "FAIL"
    verdict.html(tmp_path / "r.html")
    assert "<html" in (tmp_path / "r.html").read_text() and repr(verdict) == "<verdict FAIL in wave_step>"
    with pytest.raises(ValueError, match="did you mean 'wave_step'"):
        verdict["wavestep"]


def test_a_port_that_does_nothing_fails(puddle):
    assert rr.judge(puddle, ports.zeros, frames=[3]).status == "FAIL"


def test_a_port_of_a_pack():
    pack = PACKS / "puddle-corrected"
    assert rr.judge(pack, ports.right, strict=True).status == "PASS"
    assert rr.judge(str(pack), ports.levels_exchanged).status == "FAIL"
    with pytest.raises(ValueError, match="ports of puddle, found one of edge_splash.display"):
        rr.judge(pack, rr.Port("edge_splash", "display", lambda i, u: 0))
    with pytest.raises(OSError, match="there is no such folder"):
        rr.judge(ROOT / "tests/no_pack", ports.right)


def test_files_of_a_port(tmp_path):
    pack, port = PACKS / "puddle-corrected", tmp_path / "port"
    shutil.copytree(pack, port)
    assert rr.judge_folder(pack, port).status == "PASS"
    every = rr.judge_folder(pack, port, passes=["shade"], exhaustive=True)["shade"]
    assert every.status == "PASS" and every.sampled == every.elements
    # rainref rounds halves to nearest, and Direct3D asks for truncation.
    assert rr.judge_folder(pack, port, "d3d", passes=["wave_step"]).status == "WARN"
    strict = rr.judge_folder(pack, port, "d3d", passes=["wave_step"], strict=True)
    assert strict.status == "FAIL" and not strict.ok and "a warning, which is to fail" in strict["wave_step"].reason
    # One pass fails, and of another the files are gone.
    for file in port.glob("puddle.display/*/out.*.npy"):
        numpy_file = np.load(file)
        np.save(file, numpy_file[::-1])
    shutil.rmtree(port / "puddle.shade")
    verdict = rr.judge_folder(str(pack), port, "webgpu", partial=True, threads=1)
    assert verdict.status == "FAIL" and verdict.first_bad_pass == "display" and verdict.profile == "webgpu"
    assert verdict["shade"].status == "NOT JUDGED" and verdict["display"].causes[0].name == "upside down"
    verdict.junit(tmp_path / "r.xml")
    assert 'failures="3"' in (tmp_path / "r.xml").read_text()
    verdict.html(tmp_path / "r.html")
    assert "data:image/png" in (tmp_path / "r.html").read_text()
    assert [p.name for p in rr.judge_folder(pack, port, passes=["wave_step"]).passes] == ["wave_step"]
    assert rr.judge_folder(pack, port).json()["files"]
    with pytest.raises(ValueError, match="did you mean 'wave_step'"):
        rr.judge_folder(pack, port, passes=["wavestep"])


def test_progress_of_a_folder(tmp_path):
    pack, port, done = PACKS / "edge_splash-corrected", tmp_path / "port", []
    shutil.copytree(pack, port)
    assert rr.judge_folder(pack, port, progress=lambda *now: done.append(now)).ok
    assert done == [(k + 1, len(done)) for k in range(len(done))] and len(done) > 1

    def stop(done, of):
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        rr.judge_folder(pack, port, progress=stop)


@pytest.mark.skipif(not shutil.which("glslangValidator"), reason="needs glslangValidator")
def test_a_cause_has_its_line(tmp_path):
    """The port's shader exchanges red and blue; so do the files that it wrote."""
    pack, port, shaders = PACKS / "puddle-corrected", tmp_path / "port", tmp_path / "spirv"
    shutil.copytree(pack, port)
    for file in port.glob("puddle.display/*/out.*.npy"):
        np.save(file, np.load(file)[..., [2, 1, 0, 3]])
    shutil.copytree(ROOT / "examples/ports/puddle", shaders)
    shader = shaders / "display_corrected.comp"
    shader.write_text(shader.read_text().replace("vec4(code, 1.0)", "vec4(code.bgr, 1.0)"))
    subprocess.run(["glslangValidator", "-V", "-g", "--quiet", f"-I{ROOT}/examples/ports/common", shader.name, "-o", "display_corrected.spv"],
                   cwd=shaders, check=True)
    verdict = rr.judge_folder(pack, port, passes=["display"], spirv=shaders)
    assert verdict["display"].causes[0].lines[0].startswith("display_corrected.comp:19: imageStore(")
    assert "the device did what this shader says" in str(verdict)
    assert rr.judge_folder(pack, port, passes=["display"])["display"].causes[0].lines == ()
    with pytest.raises(OSError, match="bindings.json"):
        rr.judge_folder(pack, port, spirv=tmp_path)


def test_what_the_reference_gives_passes_for_every_pass(puddle):
    """Images, lists and several outputs, each given back as an array by name."""
    passes = [p["name"] for p in rr.describe("puddle")["passes"] if p["name"] != "ground_noise"]
    puddle.step()
    back = [rr.port(f"puddle.{name}")(lambda i, u, case: case.expected) for name in passes]
    verdict = rr.judge(puddle, back, frames=[1, 2])
    assert {p.name for p in verdict.passes} == set(passes)
    for p in verdict.passes:
        assert p.status in ("PASS", "WARN", "DATA", "UNTESTED") and p.outside == 0, p


def test_lists_are_matched_by_id():
    """Their order is free; a drop that is missing is named."""
    drops = rr.open("windshield", {"run.size": (32, 18), "scene.size": (32, 18), "windshield.height_size": (64, 36), "rain.rate": 200,
                                   "windshield.capacity": 60, "wipers.count": 0})  # each drop costs the diagnosis
    kept = {}

    def given(change):
        @rr.port("windshield.integrate")
        def integrate(i, u, case):
            kept["drops"] = case.expected["drops"]
            return {"drops": change(kept["drops"])}

        return integrate

    for _ in range(4):
        drops.step()
    assert rr.judge(drops, given(lambda d: d[::-1]), frames=[4]).ok
    verdict = rr.judge(drops, given(lambda d: d[1:]), frames=[5])["integrate"]
    assert len(kept["drops"]) > 3 and verdict.status == "FAIL" and verdict.outside > 0
    assert verdict.reason == f"drops, missing: {kept['drops']['id'][0]}" and verdict.causes[0].explained == 1

    def heavier(list_of_drops):
        list_of_drops["mass"][7] *= 2
        return list_of_drops

    worst = rr.judge(drops, given(heavier), frames=[6])["integrate"].worst
    assert [(w.output, w.field, w.x) for w in worst] == [("drops", "mass", kept["drops"]["id"][7])]


def test_what_a_port_sees(puddle):
    puddle.step()
    cases = rr.Cases.of_simulation(puddle)
    cases.add_next_frame(puddle, ["wave_step", "shade"])
    assert [c.name for c in cases] == ["wave_step"] * 4 + ["shade"] and cases[-1].id == "puddle.shade/0001.0"
    first, shade = cases[0], cases[-1]
    assert (first.frame, first.step, first.level) == (1, 0, -1) and first.formula == "puddle.wave_step.corrected/2"
    assert first.dt == pytest.approx(1 / 240) and first.judged == {"wave": "envelope"}
    assert 0 < first.uniforms.courant_sq <= 0.5 and first.uniforms["rest"] == 0
    assert set(first.inputs.drops.dtype.names) == {"x", "y", "amplitude", "radius"}
    # A step's input is what the step before gave.
    np.testing.assert_array_equal(cases[1].inputs.wave, first.expected["wave"])
    levels = shade.levels("environment")
    assert len(levels) > 2 and levels[1].shape[0] == max(1, levels[0].shape[0] // 2)
    assert shade.sampling("environment").filter == "linear" and shade.sampling("environment").address == ("repeat", "clamp")
    with pytest.raises(ValueError, match="'waves' is not an input of this pass; did you mean 'wave'"):
        first.inputs.waves
    with pytest.raises(ValueError, match="did you mean 'environment'"):
        shade.levels("enviroment")


def give(puddle, output):
    return rr.judge(puddle, rr.port("puddle.wave_step")(lambda i, u: output), frames=[puddle.frame])


@pytest.mark.parametrize("output, text", [
    (np.zeros((64, 96), np.float16), r"0000.0/out.wave: expected the shape \(64, 96, 2\), found \(64, 96\)"),
    (np.zeros((64, 96, 2), np.uint8), "0000.0/out.wave: expected rg16f as halves, found 8-bit codes"),
    (np.zeros((64, 96, 2), np.int64), "0000.0/out.wave: expected float16, found int64"),
    (np.zeros((64, 96, 5), np.float16), r"expected the shape \(64, 96, 2\), found \(64, 96, 5\)"),
    (np.zeros((96, 64, 2), np.float16), r"expected the shape \(64, 96, 2\), found \(96, 64, 2\)"),
    ({"waves": np.zeros((64, 96, 2))}, "'waves' is not an output of wave_step; did you mean 'wave'"),
    (None, "expected the shape"),
])
def test_outputs_that_cannot_be_stored(puddle, output, text):
    with pytest.raises(ValueError, match=text):
        give(puddle, output)


def test_more_channels_than_the_buffers_are_taken_as_of_files(puddle):
    """A port in WebGPU has rgba16f alone."""
    verdict = rr.judge(puddle, rr.port("puddle.wave_step")(lambda i, u, case: np.concatenate([case.expected["wave"], case.expected["wave"]], -1)),
                       frames=[3])
    assert verdict["wave_step"].outside == 0 and verdict.ok
    assert verdict.json()["notes"][0] == "puddle.wave_step/0003.0/out.wave: 4 channels, the buffer has 2: ba not read"
    assert len(verdict.json()["notes"]) == 4


@pytest.mark.parametrize("kind", [np.float16, np.float32, np.float64])
def test_floats_are_stored_as_the_buffer_stores_them(puddle, kind):
    puddle.step()
    cases = rr.Cases.of_simulation(puddle)
    cases.add_next_frame(puddle, ["display"])
    codes = cases[0].expected["picture"]
    verdict = rr.judge(puddle, rr.port("puddle.display")(lambda i, u, case: case.expected["picture"] / kind(255)), frames=[puddle.frame])
    assert codes.dtype == np.uint8 and verdict["display"].differing == 0 and verdict.ok, verdict


def wave_step(i, u, case):
    return ports.right.function(i, u, case)


def test_plain_functions_are_ports(puddle):
    """Of the pass that is their name, or their key; the only one of a pack of one pass may be called anything."""
    assert rr.judge(puddle, wave_step, frames=[0]).status == "PASS"
    assert rr.judge(puddle, {"wave_step": lambda i, u, case: wave_step(i, u, case)}, frames=[1]).status == "PASS"
    assert rr.judge(puddle, [wave_step, rr.port("puddle.display")(lambda i, u, case: case.expected)], frames=[2]).ok
    pack = PACKS / "puddle-corrected"
    assert rr.judge(pack, wave_step).status == "PASS"
    assert rr.judge(pack, {"wave_step": ports.zeros}).status == "FAIL"


def test_the_only_pass_of_a_pack_is_that_of_any_function(tmp_path):
    done = []
    pack = rr.write_pack("puddle", tmp_path / "pack", PUDDLE, frames=[3], passes=["wave_step"], seed=3)
    assert rr.judge(pack, lambda i, u, case: wave_step(i, u, case), progress=lambda *now: done.append(now)).status == "PASS"
    assert done == [(1, 4), (2, 4), (3, 4), (4, 4)]


def test_a_function_of_no_pass_is_told_the_nearest(puddle):
    def wave_stp(i, u):
        return 0

    with pytest.raises(rr.Error, match="a function whose name is a pass.*found 'wave_stp'; did you mean 'wave_step'"):
        rr.judge(puddle, wave_stp)
    with pytest.raises(rr.Error, match="found '<lambda>', and the passes are raindrops, wave_step"):
        rr.judge(PACKS / "puddle-corrected", lambda i, u: 0)
    with pytest.raises(rr.Error, match="found 'displya'; did you mean 'display'"):
        rr.judge(puddle, {"displya": wave_step})
    with pytest.raises(rr.Error, match="ports: expected functions, found 3"):
        rr.judge(puddle, [3])
    assert puddle.frame == 0


def test_a_wrong_uniform_and_an_exception(puddle):
    for wrong in (lambda i, u: u.courant_sqare, lambda i, u: u["courant_sqare"]):
        with pytest.raises(rr.Error, match="'courant_sqare' is not a uniform of this pass; did you mean 'courant_sq'") as caught:
            rr.judge(puddle, rr.port("puddle.wave_step")(wrong), frames=[puddle.frame])
    assert caught.value.__notes__ == [f"while the port ran on the case puddle.wave_step/{puddle.frame - 1:04}.0"]


def test_what_cannot_be_judged(puddle):
    puddle.step()
    with pytest.raises(ValueError, match="frames: expected frames from 1 on, found 0"):
        rr.judge(puddle, ports.right, frames=[0, 4])
    with pytest.raises(ValueError, match="frames: .*found none"):
        rr.judge(puddle, ports.right, frames=[])
    with pytest.raises(ValueError, match="did you mean 'vulkan'"):
        rr.judge(puddle, ports.right, frames=[1], profile="vulcan")
    with pytest.raises(ValueError, match="one for each pass, found wave_step, wave_step"):
        rr.judge(puddle, [ports.right, ports.zeros])
    with pytest.raises(ValueError, match="ports of puddle, found one of rainy_glass.display"):
        rr.judge(puddle, rr.Port("rainy_glass", "display", lambda i, u: 0), frames=[5])
    with pytest.raises(ValueError, match="'wavestep' is not a pass of puddle; did you mean 'wave_step'"):
        rr.port("puddle.wavestep")
    with pytest.raises(ValueError, match="did you mean 'puddle'"):
        rr.port("pudle.wave_step")
    assert rr.open("puddle", PUDDLE).frame == 0
