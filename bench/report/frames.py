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
GOAL_START = 0.3  # seconds


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
    parts, times = [], {}
    for row in result.get("frames", []):
        times.setdefault(row["scene"], {})[row["threads"]] = row
    if times:
        counts = sorted({row["threads"] for row in result["frames"]})
        least = rows.GOAL_SCALING if counts[-1] == 16 else None
        spread = max(50 * (row["q3_ms"] - row["q1_ms"]) / row["median_ms"] for row in result["frames"])
        lines = [[f"`{scene}`", *(f"{of[n]['median_ms']:.3g}" for n in counts),
                  rows.judged(of[1]["median_ms"] / of[counts[-1]]["median_ms"], least)] for scene, of in times.items()]
        parts.append(f"Milliseconds of a frame without its picture, by the number of threads (mean of {FRAMES} frames without the first and the last); quartiles within ± {spread:.0f} %" +
                     (f"; goal over one thread: {least}:\n\n" if least else ":\n\n") + rows.table(["scene", *map(str, counts), "over one thread"], lines))
    lines = [[f"`{row['scene']}`", f"{row['kept_s']:.2f}" if row["kept_s"] <= GOAL_START else f"**{row['kept_s']:.2f}**",
              *(f"{row[key]:.2f}" if key in row else "" for key in ("frame_s", "png_s", "first_s"))] for row in result.get("starts", [])]
    if lines:
        parts.append("Seconds from the command, on all threads, until the first frame begins, is computed, and is written as PNG; then until it is computed "
                     f"without kept images. Goal of the first: {GOAL_START}:\n\n" +
                     rows.table(["scene", "begins", "computed", "PNG", "computed, no kept images"], lines))
    return "\n".join(parts)
