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


def _best_rate(row):
    """Of its fastest go."""
    return row["rate"] * row["median_ms"] / row["best_ms"]


def comparisons(result):
    """For each row of a peer that has one of ours on as many threads: {"row", "threads", "peer", "ours", "theirs", "ratio", "ratio_best", "goal", "stream"}.

    ratio: of medians, or where the bench measured in turns the median of these, with Embree the water's update on both sides; ratio_best: of the fastest goes; stream:
    percent of the stream of ours, or None.
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
            best = _best_rate(row) / _best_rate(peer) if "best_ms" in peer and "best_ms" in row else None
            found.append({"row": name, "threads": peer["threads"], "peer": peer["peer"], "ours": row["rate"], "theirs": peer["rate"],
                          "unit": peer["unit"], "ratio": significant(peer.get("ratios", {}).get(name, peer.get("ratio_with_update", row["rate"] / peer["rate"]))),
                          "ratio_best": None if best is None else significant(best), "goal": goal(peer),
                          "stream": row.get("stream_percent")})
    return found


def scaling(result):
    """Of the waves of 2048 and 4096 columns, for each row and 16 threads: {"row", "threads", "one", "all", "ratio", "stream"}; medians."""
    ours = {(r["row"], r["threads"]): r for r in result["rows"]}
    found = []
    for (name, threads), row in ours.items():
        one = ours.get((name, 1))
        if threads != 16 or one is None or not name.startswith("wave_step/") or not {"2048", "4096"} & set(name.split("/")):
            continue
        found.append({"row": name, "threads": threads, "unit": row["unit"], "one": one["rate"], "all": row["rate"], "ratio": significant(row["rate"] / one["rate"]),
                      "stream": row.get("stream_percent")})
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


def table(heads, lines):
    """A table in Markdown."""
    return "\n".join(["| " + " | ".join(heads) + " |", "|" + "---|" * len(heads)] + ["| " + " | ".join(line) + " |" for line in lines]) + "\n"
