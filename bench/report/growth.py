"""How time and peak memory of `rainref run` grow with drops, pixels and frames, against what the program states.

What is stated is in summary.json (memory.stated), from the one place of each effect that refuses scenes which do not fit
(src/*/memory.cpp); memory.taken is the peak that the kernel counted.
"""
import json
import os
import shutil
import subprocess
import time

import machine
import rows
from rows import table

ALLOWED = 1.1        # taken over stated, as tests/cli/memory_test.cpp holds it
PROGRAM_SLACK = 8.0  # MiB whatever the scene: pages of the program and its libraries that are touched as it goes on, threads' stacks
FRAMES_SLACK = 4.0   # MiB that a longer run may take beyond a shorter one: what allocators and the log of times keep
MIB = 1 << 20

SMALL = ["run.size=[64, 64]", "scene.size=[64, 64]"]


def cases(quick):
    """(series, size, items, scene, frames, overrides)."""
    found = []
    for count in (1000, 10000, 100000) if quick else (1000, 10000, 100000, 1000000, 10000000):
        # At most a million arrive a second; run.fps is 1 at the least, so that ten millions take eleven frames.
        frames = 2 if count <= 1000000 else count // 1000000 + 1
        overrides = SMALL + [f"windshield.capacity={count}", f"windshield.spawn_rate={min(count, 1000000)}", "run.fps=1", "windshield.drag=1"]
        found.append(("drops: windshield as published", count, count, "windshield/as_published", frames, overrides))
    for scene in ("edge_splash/default", "puddle/default", "rainy_glass/default", "screen_drops/default"):
        more = ["puddle.grid=[64, 64]"] if scene.startswith("puddle") else ["flow.on=false"] if scene.startswith("screen") else []
        for side in (256, 512) if quick else (256, 1024, 4096, 8192):
            found.append((f"pixels: {scene}", side, side * side, scene, 2, more + [f"run.size=[{side}, {side}]"]))
    for scene in ("puddle/default", "windshield/as_published", "edge_splash/default", "screen_drops/default"):
        more = ["puddle.grid=[64, 64]"] if scene.startswith("puddle") else ["scene.size=[64, 64]", "windshield.capacity=1000"] \
            if scene.startswith("windshield") else []
        for frames in (1, 10, 100) if quick else (1, 10, 100, 1000, 10000):
            found.append((f"frames: {scene}", frames, frames, scene, frames, more + ["run.size=[64, 64]"]))
    return found


def run(rainref, out, scene, frames, overrides):
    """{"stated", "taken"} in MiB and seconds. Raises rows.Malformed with what the program says where it refuses."""
    folder = os.path.join(out, "growth-run")
    shutil.rmtree(folder, ignore_errors=True)
    command = [rainref, "run", f"scenes/{scene}.toml", "--no-cache", "--image", "none", "--frames", str(frames), "-o", folder,
               "--set", "run.supersample=1"]
    for value in overrides:
        command += ["--set", value]
    begin = time.monotonic()
    done = subprocess.run(command, capture_output=True, text=True)
    seconds = time.monotonic() - begin
    if done.returncode != 0:
        raise rows.Malformed(done.stderr.strip().splitlines()[-1] if done.stderr.strip() else f"exit code {done.returncode}")
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        memory = json.load(file)["memory"]
    shutil.rmtree(folder, ignore_errors=True)
    return {"stated_mib": round(memory["stated"] / MIB, 2), "taken_mib": round(memory["taken"] / MIB, 2), "seconds": round(seconds, 2)}


def faults(measured):
    """What is beyond what is stated: one line each. measured: the rows of a run, in the order of each series' sizes."""
    found, series = [], {}
    for row in measured:
        series.setdefault(row["series"], []).append(row)
        if row["taken_mib"] > row["stated_mib"] * ALLOWED + PROGRAM_SLACK:
            found.append(f"{row['series']}, {row['size']}: {row['taken_mib']} MiB taken, {row['stated_mib']} stated")
    for name, of in series.items():
        first, last = of[0], of[-1]
        taken, stated = last["taken_mib"] - first["taken_mib"], last["stated_mib"] - first["stated_mib"]
        if name.startswith("frames"):
            # Ten frames are warm; drops of a longer run are stated.
            warm = next((row for row in of if row["size"] >= 10), of[0])
            grown = last["taken_mib"] - warm["taken_mib"]
            if grown > max(0.0, last["stated_mib"] - warm["stated_mib"]) * ALLOWED + FRAMES_SLACK:
                found.append(f"{name}: {grown:.1f} MiB more after {last['size']} frames than after {warm['size']}")
        elif taken > stated * ALLOWED + PROGRAM_SLACK:
            found.append(f"{name}: {taken:.1f} MiB more from {first['size']} to {last['size']}, {stated:.1f} stated")
    return found


def measure(rainref, out, quick, say):
    measured, skipped, watch = [], [], machine.Watch()
    for series, size, items, scene, frames, overrides in cases(quick):
        say(f"{series}, {size}")
        try:
            measured.append({"series": series, "size": size, "items": items, "frames": frames, **run(rainref, out, scene, frames, overrides)})
        except rows.Malformed as refused:
            skipped.append({"series": series, "size": size, "reason": str(refused)})
    # A refusal for want of memory is the machine's; another one would be ours.
    ours = [f"{s['series']}, {s['size']}: {s['reason']}" for s in skipped if " of memory" not in s["reason"]]
    return {"format": "rainref.growth", "version": 1, "machine": machine.describe(), "others_percent": watch.others_percent(), "rows": measured, "skipped": skipped,
            "faults": faults(measured) + ours}


def per_item(of):
    """(stated, taken) bytes an item, from the smallest to the largest size."""
    items = of[-1]["items"] - of[0]["items"]
    return [(of[-1][key] - of[0][key]) * MIB / items for key in ("stated_mib", "taken_mib")]


def markdown(result):
    series, lines = {}, []
    for row in result["rows"]:
        series.setdefault(row["series"], []).append(row)
    for name, of in series.items():
        first, last = of[0], of[-1]
        items = ["", ""] if first is last or name.startswith("frames") else [f"{bytes_of:.1f}" for bytes_of in per_item(of)]
        lines.append([name, str(first["size"]), f"{first['taken_mib']:.1f}", str(last["size"]), f"{last['taken_mib']:.1f}", f"{last['stated_mib']:.1f}", f"{last['seconds']:.2f}", *items])
    others = result.get("others_percent")
    said = "Others used the machine meanwhile: times here are no measure, memory is." if others is None else \
        f"Others took {others} % of the machine meanwhile; memory does not depend on it."
    text = said + "\n\n" + table(["series", "from", "taken MiB", "to", "taken MiB", "stated MiB", "s", "stated bytes an item", "taken"], lines)
    for s in result["skipped"]:
        text += f"\n- Skipped: {s['series']}, {s['size']}: {s['reason']}"
    return text + ("\n" if result["skipped"] else "") + "\n" + verdict(result)


def verdict(result):
    """What took more than is stated, or that nothing did."""
    return "".join(f"- **Grew**: {fault}\n" for fault in result["faults"]) or \
        f"Nothing took more than a tenth and {PROGRAM_SLACK:g} MiB (the program's own pages) beyond what is stated, and nothing grew with frames.\n"
