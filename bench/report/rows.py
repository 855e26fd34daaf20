"""Rows of the bench: what Google Benchmark's JSON and the peers give, in one shape.

A row is {"row", "threads", "unit", "best_ms", "q1_ms", "median_ms", "q3_ms", "goes", "rate", "hash"}; "rate" is of the median, in millions
of items a second. Ours may have "stream_percent", which is of the fastest go; peers have "peer" and "version", Numba's
"ratios", of each row of ours that was measured in turns with it.
"""
import re

UNITS = {"Gcell/s": ("cell", 1e3), "Mpix/s": ("pixel", 1.0), "Mdrop/s": ("drop", 1.0), "Mray/s": ("ray", 1.0)}


class Malformed(Exception):
    """The file is not what the bench writes."""


def quantile(values, p):
    """The value below which a share p lies, between neighbours by proportion."""
    ordered = sorted(values)
    at = p * (len(ordered) - 1)
    low = int(at)
    high = min(low + 1, len(ordered) - 1)
    return ordered[low] + (at - low) * (ordered[high] - ordered[low])


def significant(x):
    """Five digits: more are noise, and would make the files longer."""
    return float(f"{x:.5g}")


def split_name(name):
    """("wave_step/corrected/rg16f/1024", 2) of Google Benchmark's name of a row."""
    match = re.search(r"/threads:(\d+)", name)
    if not match:
        raise Malformed(f"row '{name}': expected /threads:N in its name")
    rest = name[: match.start()] + name[match.end():]
    return re.sub(r"/(iterations:\d+|manual_time|real_time)", "", rest), int(match.group(1))


def of_benchmark(entry):
    """One row of Google Benchmark's JSON. Raises Malformed."""
    name, threads = split_name(entry["name"])
    if entry.get("error_occurred"):
        raise Malformed(f"row '{name}': {entry.get('error_message', 'failed')}")
    units = [u for u in UNITS if u in entry]
    if len(units) != 1 or "median_ms" not in entry:
        raise Malformed(f"row '{name}': expected one of {', '.join(UNITS)} and median_ms, found {', '.join(sorted(entry))}")
    item, factor = UNITS[units[0]]
    # The row's own rate belongs to its fastest go, or, where it has none, to the median.
    items = entry[units[0]] * factor * entry.get("best_ms", entry["median_ms"]) / 1e3
    row = {"row": name, "threads": threads, "unit": item, "rate": significant(items / entry["median_ms"] * 1e3),
           "goes": int(entry["goes"]), "hash": entry.get("label", "")}
    for key in ("best_ms", "q1_ms", "median_ms", "q3_ms"):
        if key in entry:
            row[key] = significant(entry[key])
    if "stream_%" in entry:
        row["stream_percent"] = significant(entry["stream_%"])
    return row


def of_benchmark_file(content):
    """(rows, peers): rays come with Embree's triangles in the same row."""
    rows, peers = [], []
    for entry in content.get("benchmarks", []):
        row = of_benchmark(entry)
        rows.append(row)
        if "native_median_ms" in entry:
            rate = row["rate"] * entry["median_ms"] / entry["native_median_ms"]
            peer = {"peer": "embree", "row": row["row"], "threads": row["threads"], "unit": "ray", "rate": significant(rate), "goes": row["goes"],
                    "hash": "", "ratio": significant(entry["ratio"]), "ratio_with_update": significant(entry["ratio_with_update"])}
            for key in ("q1_ms", "median_ms", "q3_ms"):
                peer[key] = significant(entry["native_" + key])
            peers.append(peer)
    if not rows:
        raise Malformed("no rows: expected a list 'benchmarks' that is not empty")
    return rows, peers


def of_times(peer, row, threads, unit, items, seconds, digest, **more):
    """A row of a peer whose goes took these seconds, for so many items each."""
    median = quantile(seconds, 0.5)
    return {"peer": peer, "row": row, "threads": threads, "unit": unit, "rate": significant(items * 1e-6 / median), "goes": len(seconds),
            "hash": digest, "best_ms": significant(min(seconds) * 1e3), "q1_ms": significant(quantile(seconds, 0.25) * 1e3),
            "median_ms": significant(median * 1e3), "q3_ms": significant(quantile(seconds, 0.75) * 1e3), **more}


def comparisons(result):
    """For each row of a peer that has one of ours on as many threads: {"row", "threads", "peer", "ratio", "goal", "stream"}.

    ratio: of medians, or where the bench measured in turns the median of these, with Embree the water's update on both sides; stream: percent of the stream of ours, or None.
    """
    ours = {(r["row"], r["threads"]): r for r in result["rows"]}
    found = []
    for peer in result["peers"]:
        # A user's loop makes one step after another, ours those of a frame together.
        for name in (peer["row"], peer["row"] + "/steps:5") if peer["peer"] == "numba" else (peer["row"],):
            row = ours.get((name, peer["threads"]))
            if row is None and peer["peer"] == "numpy":  # has one thread, whatever the machine
                row = ours.get((name, 1))
            if row is None:
                continue
            ratio = peer.get("ratios", {}).get(name, peer.get("ratio_with_update", row["rate"] / peer["rate"]))
            found.append({"row": name, "threads": peer["threads"], "peer": peer["peer"], "ratio": significant(ratio), "goal": goal(peer), "stream": row.get("stream_percent")})
    return found


GOAL_SCALING = 12  # of 16 threads, where these are all, over one: of frames, and of waves of 2048 and 4096 columns


def on_all_threads(result):
    """For each row on as many threads as any has: {"row", "unit", "rate", "ratio", "goal", "stream"}; ratio: over one thread, of medians, or None."""
    ours = {(r["row"], r["threads"]): r for r in result["rows"]}
    most = max((threads for _, threads in ours), default=0)
    found = []
    for (name, threads), row in ours.items():
        if threads != most:
            continue
        one = ours.get((name, 1))
        has_goal = threads == 16 and name.startswith("wave_step/") and {"2048", "4096"} & set(name.split("/"))
        found.append({"row": name, "unit": row["unit"], "rate": row["rate"], "ratio": None if one is None else significant(row["rate"] / one["rate"]),
                      "goal": GOAL_SCALING if has_goal else None, "stream": row.get("stream_percent")})
    return found


def goal(peer):
    """How many times as fast as the peer the row is to be, or None."""
    name = peer["row"]
    if peer["peer"] == "numba":
        return 1.5
    if peer["peer"] == "lavapipe":
        return 3.5 if name.startswith("composite") else 6.0 if name.startswith("edge_splash.splash") else 3.0
    if peer["peer"] == "embree":
        return {"camera": 2.0, "reflection": 4.0, "grazing": 1.5}.get(name.split("/")[1])
    return None


def judged(ratio, least):
    """The ratio as text, bold where it is below a goal, and then never rounded up to it."""
    return f"**{min(ratio, least - 0.01):.2f}**" if least is not None and ratio < least else f"{ratio:.2f}"


def table(heads, lines):
    """A table in Markdown."""
    return "\n".join(["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)] + ["| " + " | ".join(line) + " |" for line in lines]) + "\n"
