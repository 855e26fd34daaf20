"""What a user would write instead, measured in the same run. A peer that cannot run is named with its reason and never a failure."""
import hashlib
import json
import os
import shutil
import subprocess

import rows

# Rows of lavapipe: (our row, scene, its size, frames, pass, folder of the ports, overrides). The wave has no drops there: the port asks every
# drop at every texel, ours only those that a row meets, and that would measure the loop.
PORTS = (
    ("composite/corrected/1920x1080", "windshield/default", "1920x1080", 60, "composite", "windshield", ()),
    ("edge_splash.splash/corrected/1920x1080", "edge_splash/default", "1920x1080", 2, "splash", "edge_splash", ()),
    ("rain_on_glass/corrected/pane/1080p", "rainy_glass/default", "1920x1080", 1, "rain_on_glass", "rainy_glass", ("maps.droplets=600",)),
    ("screen_drops.drops/corrected/still/1080p", "screen_drops/default", "1920x1080", 1, "drops", "screen_drops", ("flow.on=false",)),
    ("surface_hit/corrected/1280x720", "puddle/default", "1280x720", 8, "surface_hit", "puddle", ()),
    ("shade/corrected/1280x720", "puddle/default", "1280x720", 8, "shade", "puddle", ()),
    ("wave_step/corrected/rg16f/1024", "puddle/default", "64x64", 8, "wave_step", "puddle",
     ("puddle.grid=[1024, 1024]", "puddle.shape=basin", "puddle.storage=rg16f", "rain.rate=0")),
    ("wave_step/corrected/rg16f/2048", "puddle/default", "64x64", 8, "wave_step", "puddle",
     ("puddle.grid=[2048, 2048]", "puddle.shape=basin", "puddle.storage=rg16f", "rain.rate=0")),
    ("wave_step/corrected/rg32f/1024", "puddle/default", "64x64", 8, "wave_step", "puddle",
     ("puddle.grid=[1024, 1024]", "puddle.shape=basin", "puddle.storage=rg32f", "rain.rate=0")),
)


WAVE, SIDES, TURNS = "wave_step/corrected/rg32f/", (1024, 2048, 4096), 3


def last_line(text):
    lines = [line for line in text.strip().splitlines() if line.strip()]
    return lines[-1] if lines else "no output"


def python_with_numpy():
    """The system's Python before another one, as packages of the system are for it; None where none has NumPy."""
    for python in ("/usr/bin/python3", shutil.which("python3")):
        if python and os.path.exists(python) and subprocess.run([python, "-c", "import numpy"], capture_output=True).returncode == 0:
            return python
    return None


class WavePeer:
    """peer_wave.py, which waits for requests between those of ours."""

    def __init__(self, python):
        program = os.path.join(os.path.dirname(os.path.abspath(__file__)), "peer_wave.py")
        self.ended = ""  # or its last words
        self.process = subprocess.Popen([python, program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def times(self, peer, side, threads, seconds):
        """What it answers: {"seconds", "hash", "version"}. Raises RuntimeError."""
        if self.ended:
            raise RuntimeError(self.ended)
        try:
            self.process.stdin.write(f"{peer} {side} {threads} {seconds}\n")
            self.process.stdin.flush()
            line = self.process.stdout.readline()
        except OSError:
            line = ""
        if not line:
            self.ended = last_line(self.process.communicate()[1])
            raise RuntimeError(self.ended)
        answer = json.loads(line)
        if "reason" in answer:
            raise RuntimeError(answer["reason"])
        return answer

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if not self.ended:
            self.process.communicate()


def row_of(peer, side, threads, answers, **more):
    """The row of a peer's answers to alike requests."""
    seconds = [s for answer in answers for s in answer["seconds"]]
    return rows.of_times(peer, f"{WAVE}{side}", threads, "cell", side * side, seconds, answers[0]["hash"], version=answers[0]["version"], **more)


def in_turns(peer, side, threads, seconds, ours):
    """Numba's row, with the median of its turns' ratios for each row of ours: a machine that others share is slow for minutes, and then for both."""
    answers, ratios = [], {}
    for _ in range(TURNS):
        rates = ours(f"{WAVE}{side}", threads)
        answers.append(peer.times("numba", side, threads, seconds / TURNS))
        theirs = side * side * 1e-6 / rows.quantile(answers[-1]["seconds"], 0.5)
        for name, rate in rates.items():
            ratios.setdefault(name, []).append(rate / theirs)
    return row_of("numba", side, threads, answers, ratios={name: rows.significant(rows.quantile(r, 0.5)) for name, r in ratios.items()})


def waves(counts, seconds, ours):
    """NumPy and Numba: (rows, skipped). ours(row, threads) measures it and its steps:5 again: {name: millions of cells a second}."""
    python = python_with_numpy()
    if python is None:
        return [], [{"peer": name, "reason": f"not installed (Debian: python3-{name})"} for name in ("numpy", "numba")]
    found, skipped = [], []
    with WavePeer(python) as peer:
        for name, measured in (("numpy", (row_of("numpy", side, 1, [peer.times("numpy", side, 1, seconds)]) for side in SIDES)),
                               ("numba", (in_turns(peer, side, count, seconds, ours) for count in counts for side in SIDES))):
            try:
                for row in measured:
                    found.append(row)
            except RuntimeError as problem:
                skipped.append({"peer": name, "reason": str(problem)})
    return found, skipped


def keep_last_case(manifest, name):
    """Leaves the last case of the pass in a capture, so that the runner has one to time. Raises KeyError where there is none."""
    with open(manifest, encoding="utf-8") as file:
        content = json.load(file)
    cases = [case for case in content["cases"] if case["pass"] == name]
    if not cases:
        raise KeyError(f"the capture has no case of {name}")
    content["cases"] = cases[-1:]
    with open(manifest, "w", encoding="utf-8") as file:
        json.dump(content, file)


def capture(rainref, folder, port):
    """The folder of a capture of the pass, of this program, made where it is not there yet. Raises RuntimeError."""
    row, scene, size, frames, name, _, overrides = port
    command = [rainref, "run", f"scenes/{scene}.toml", "--size", size, "--frames", str(frames), "--image", "none", "--capture", "all",
               "--set", "run.supersample=1"]
    for value in overrides:
        command += ["--set", value]
    out = os.path.join(folder, row.replace("/", "-"))
    stamp = json.dumps([command, os.stat(rainref).st_mtime])
    try:
        with open(os.path.join(out, "made_by"), encoding="utf-8") as file:
            if file.read() == stamp:
                return os.path.join(out, "capture")
    except OSError:
        pass
    shutil.rmtree(out, ignore_errors=True)
    done = subprocess.run(command + ["-o", out], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(last_line(done.stderr))
    keep_last_case(os.path.join(out, "capture", "manifest.json"), name)
    with open(os.path.join(out, "made_by"), "w", encoding="utf-8") as file:
        file.write(stamp)
    return os.path.join(out, "capture")


def digest_of_outputs(folder):
    digest = hashlib.sha256()
    for at, folders, files in os.walk(folder):
        folders.sort()
        for name in sorted(files):
            if name.endswith(".npy"):
                with open(os.path.join(at, name), "rb") as file:
                    digest.update(file.read())
    return digest.hexdigest()[:16]


def prepare_ports(build, folder, wanted):
    """Captures for lavapipe, made before anything is measured: ([(port, capture)], skipped)."""
    rainref, runner = os.path.join(build, "bin/rainref"), os.path.join(build, "examples/ports/port_runner")
    for program in (rainref, runner):
        if not os.path.exists(program):
            return [], [{"peer": "lavapipe", "reason": f"{program} is not built"}]
    listed = subprocess.run([runner, "--list"], capture_output=True, text=True)
    if listed.returncode != 0 or "(software)" not in listed.stdout:
        return [], [{"peer": "lavapipe", "reason": "no software device (Debian: mesa-vulkan-drivers)"}]
    ready, skipped = [], []
    for port in PORTS:
        if not wanted(port[0]):
            continue
        try:
            ready.append((port, capture(rainref, folder, port)))
        except (RuntimeError, KeyError, OSError) as problem:
            skipped.append({"peer": "lavapipe", "row": port[0], "reason": str(problem)})
    return ready, skipped


def ports(build, folder, prepared, threads, seconds):
    """The GLSL ports as compute shaders on Mesa's software device, on all threads: (rows, skipped)."""
    found, skipped = [], []
    for (row, _, _, _, name, shaders, _), pack in prepared:
        out = os.path.join(folder, "port")
        shutil.rmtree(out, ignore_errors=True)
        done = subprocess.run([os.path.join(build, "examples/ports/port_runner"), "--device", "cpu", "--pack", pack, "--spirv",
                               os.path.join(build, "examples/ports", shaders), "--out", out, "--only", name, "--time", str(seconds)],
                              capture_output=True, text=True)
        if done.returncode != 0:
            skipped.append({"peer": "lavapipe", "row": row, "reason": last_line(done.stderr)})
            continue
        with open(os.path.join(out, "times.json"), encoding="utf-8") as file:
            timed = json.load(file)[-1]
        with open(os.path.join(out, "port.json"), encoding="utf-8") as file:
            version = json.load(file)["driver"]
        unit = "cell" if row.startswith("wave_step") else "pixel"
        found.append(rows.of_times("lavapipe", row, threads, unit, timed["width"] * timed["height"], timed["seconds"], digest_of_outputs(out),
                                   version=version))
    return found, skipped
