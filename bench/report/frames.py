"""Whole frames of `rainref run` on more and more threads, and how long a default scene takes to begin."""
import json
import os
import re
import shutil
import statistics
import subprocess
import time

import rows

SCENES = ("windshield/drive", "puddle/stress", "windshield/stress")
EFFECTS = ("puddle", "windshield", "edge_splash", "screen_drops", "rainy_glass")
FRAMES, GOES = 48, 3
GOAL_SCALING, GOAL_START = 12, 0.3  # of 16 threads over one; seconds


def _run(rainref, folder, cache, scene, frames, more):
    """(summary, seconds of the whole command). The cache of the user is left alone."""
    command = [rainref, "run", f"scenes/{scene}.toml", "--frames", str(frames), "-o", folder, *more]
    begin = time.monotonic()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, env={**os.environ, "XDG_CACHE_HOME": cache})
    seconds = time.monotonic() - begin
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        return json.load(file), seconds


def _quartiles(values):
    q = statistics.quantiles(values, n=4, method="inclusive")
    return {"q1_ms": round(q[0], 4), "median_ms": round(q[1], 4), "q3_ms": round(q[2], 4)}


def measure(rainref, out, counts, only, say):
    """({"frames": rows, "starts": rows}, what is skipped). Threads in turns, so that what else the machine does meets them alike."""
    folder, cache = (os.path.abspath(os.path.join(out, name)) for name in ("frames-run", "frames-cache"))  # a relative cache is none: XDG
    found, skipped = {"frames": [], "starts": []}, []
    try:
        for scene in (s for s in SCENES if re.search(only, f"frames/{s}")):
            say(f"frames/{scene}")
            times, hashes = {n: [] for n in counts}, {}
            _run(rainref, folder, cache, scene, 1, ["--image", "none"])  # keeps what others read
            for n in counts * GOES:
                summary, _ = _run(rainref, folder, cache, scene, FRAMES, ["--image", "none", "--threads", str(n)])
                times[n].append(summary["ms_per_frame"])
                hashes[n] = summary["last_frame"][-1]["xxh3"][:16]
            found["frames"] += [{"scene": scene, "threads": n, **_quartiles(times[n]), "hash": hashes[n]} for n in counts]
        for scene in (f"{e}/default" for e in EFFECTS if re.search(only, f"start/{e}/default")):
            say(f"start/{scene}")
            shutil.rmtree(cache, ignore_errors=True)
            goes = [_run(rainref, folder, cache, scene, 1, ["--image", "none"]) for _ in range(1 + GOES)]
            # Until the first frame begins: the command less its frames.
            start = {"scene": scene, "first_s": round(goes[0][1], 3), "frame_s": round(statistics.median(s for _, s in goes[1:]), 3),
                     "kept_s": round(statistics.median(s - summary["seconds"] for summary, s in goes[1:]), 3)}
            try:
                start["png_s"] = round(statistics.median(_run(rainref, folder, cache, scene, 1, ["--image", "png"])[1] for _ in range(GOES)), 3)
            except subprocess.CalledProcessError as refused:  # a machine without OpenImageIO writes no pictures
                skipped.append({"peer": f"PNG of {scene}", "reason": refused.stderr.decode().strip().splitlines()[-1]})
            found["starts"].append(start)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        shutil.rmtree(cache, ignore_errors=True)
    return found, skipped


def markdown(result):
    """The tables of a run; "" where it has none (older files)."""
    parts, lines = [], []
    one = {row["scene"]: row["median_ms"] for row in result.get("frames", []) if row["threads"] == 1}
    for row in result.get("frames", []):
        ratio = one[row["scene"]] / row["median_ms"]
        goal = "" if row["threads"] != 16 else f"{GOAL_SCALING} {'met' if ratio >= GOAL_SCALING else '**not met**'}"
        spread = 50 * (row["q3_ms"] - row["q1_ms"]) / row["median_ms"]
        lines.append([f"`{row['scene']}`", str(row["threads"]), f"{row['median_ms']:.3g}", f"{spread:.0f} %", f"{ratio:.2f}",
                      goal, row["hash"]])
    if lines:
        parts.append(f"Frames of scenes without pictures, a mean of {FRAMES} but for the first and the last:\n\n" +
                     rows.table(["scene", "threads", "ms a frame", "±", "over one thread", "goal", "hash"], lines))
    lines = [[f"`{row['scene']}`", f"{row['kept_s']:.2f}", f"{GOAL_START:g} {'met' if row['kept_s'] <= GOAL_START else '**not met**'}",
              *(f"{row[key]:.2f}" if key in row else "" for key in ("frame_s", "png_s", "first_s"))] for row in result.get("starts", [])]
    if lines:
        parts.append("From the command, all threads, until its first frame begins, is computed, and is written, OpenImageIO loaded; then without what is "
                     "the same in every run and was kept:\n\n" +
                     rows.table(["scene", "begins [s]", "goal", "computed [s]", "a PNG [s]", "nothing kept, computed [s]"], lines))
    return "\n".join(parts)
