"""Markdown and plots from the JSON of a run; the part of docs/notes/performance.md that is made of committed ones."""
import json
import os
import re

import frames
import growth
import plots
import rows
from rows import table

BEGIN, END = "<!-- made by scripts/bench --document: do not edit below -->", "<!-- end of what is made -->"
FORMAT = "rainref.bench"


def read(path):
    """A run's JSON. Raises rows.Malformed naming file, key, expected and found."""
    try:
        with open(path, encoding="utf-8") as file:
            result = json.load(file)
    except (OSError, ValueError) as problem:
        raise rows.Malformed(f"{path}: {problem}") from problem
    if not isinstance(result, dict) or result.get("format") != FORMAT:
        raise rows.Malformed(f"{path}: format: expected {FORMAT}, found {result.get('format') if isinstance(result, dict) else type(result).__name__}")
    for key, kind in (("machine", dict), ("idle", dict), ("rows", list), ("peers", list), ("skipped", list)):
        if not isinstance(result.get(key), kind):
            raise rows.Malformed(f"{path}: {key}: expected {'a list' if kind is list else 'an object'}, found {type(result.get(key)).__name__}")
    for at, row in enumerate(result["rows"] + result["peers"]):
        for key in ("row", "threads", "unit", "rate", "median_ms", "q1_ms", "q3_ms"):
            if key not in row:
                raise rows.Malformed(f"{path}: row {at}: expected the key {key}, found {', '.join(sorted(row))}")
    return result


def rate_text(rate, unit):
    """Millions of items a second: 2.15 Gcell/s, 71.3 Mpix/s."""
    short = "pix" if unit == "pixel" else unit
    return f"{rate / 1e3:.3g} G{short}/s" if unit == "cell" or rate >= 999.5 else f"{rate:.3g} M{short}/s"


def spread_text(row):
    """Half the distance of the quartiles in percent of the median."""
    return f"{50 * (row['q3_ms'] - row['q1_ms']) / row['median_ms']:.0f} %"


def idle_text(result):
    idle, others = result["idle"], result["idle"].get("others_during_percent")
    text = "The machine was idle before" if idle["idle"] else \
        f"**The machine was not idle**: others took {idle['others_percent']} % of it after {idle['waited_s']} s of waiting"
    return text + (f"; others took {others} % of it during the run." if others is not None else ".")


def peers_table(result, goals_only=False):
    """A line for each row and peer, or of those that have a goal, with the ratio by the number of threads; "" without peers."""
    ratios, goals = {}, {}
    for c in rows.comparisons(result):
        if goals_only and c["goal"] is None:
            continue
        stream = f" ({c['stream']:.0f} %)" if c["goal"] is not None and c["ratio"] < c["goal"] and c["stream"] is not None else ""
        key = (c["peer"], c["row"])
        ratios.setdefault(key, {})[c["threads"]] = rows.judged(c["ratio"], c["goal"]) + stream
        goals[key] = "" if c["goal"] is None else f"{c['goal']:g}"
    counts = sorted({n for of in ratios.values() for n in of})
    lines = [[f"`{row}`", peer, *(of.get(n, "") for n in counts), goals[peer, row]] for (peer, row), of in ratios.items()]
    return table(["row", "peer", *map(str, counts), "goal"], lines) if lines else ""


def passes_table(result, misses_only=False):
    """The rate of each corrected pass on all threads, or of those that miss a goal; "" without one."""
    lines = [[f"`{s['row'].replace('/corrected', '')}`", rate_text(s["rate"], s["unit"]), "" if s["ratio"] is None else rows.judged(s["ratio"], s["goal"]),
              "" if s["stream"] is None else f"{s['stream']:.0f}"] for s in rows.on_all_threads(result)
             if "/as-published" not in s["row"] and (not misses_only or s["goal"] is not None and s["ratio"] < s["goal"])]
    return table(["row", "rate", "over one thread", "stream %"], lines) if lines else ""


def rows_table(result):
    """Every row on every number of threads; ± is half the distance of the quartiles, in percent of the median."""
    lines = [[f"`{r['row']}`", str(r["threads"]), rate_text(r["rate"], r["unit"]), f"{r['median_ms']:.3g}", spread_text(r),
              f"{r['stream_percent']:.0f}" if "stream_percent" in r else "", r["hash"].replace(" ", "<br>")] for r in result["rows"]]
    return table(["row", "threads", "rate", "ms", "±", "stream %", "hash"], lines)


def without_folders(reason):
    """The text with the last name alone of each path that begins at the root."""
    return re.sub(r"(?<![\w./])/(?:[^/\s,;:']+/)*([^/\s,;:']+)", r"\1", reason.replace(os.getcwd() + os.sep, ""))


def markdown(result, pictures, goals_only=False):
    """The tables of a run. pictures: folder and stem of its plots, as a link goes there; goals_only: without starts and passes
    that miss no goal, and without peers that have none."""
    m = result["machine"]
    out = [f"{m['processor']}, {m['cores']} cores, {', '.join(filter(None, (m['simd'], m['caches'])))}, {m['memory_gib']} GiB. {idle_text(result)} "
           f"{len(result['rows'])} rows in {result.get('seconds', 0)} s. Bold: a goal is missed.", ""]
    reasons = {}
    for s in result["skipped"]:
        reasons.setdefault(s["reason"], []).append(s["peer"] + (", " + s["row"] if "row" in s else ""))
    out += [f"- Absent from this run: {'; '.join(names)}: {reason}" for reason, names in reasons.items()]
    if result["skipped"]:
        out.append("")
    if goals_only:
        result = {**result, "starts": [start for start in result.get("starts", []) if start["kept_s"] > frames.GOAL_START]}
    if whole := frames.markdown(result):
        out += [whole]
    if not result["rows"]:
        return "\n".join(out)
    if text := peers_table(result, goals_only):
        out += ["Speed relative to a peer, by the number of threads. Beside a missed goal stands the percentage of its stream that the row reaches:", "", text]
    if text := passes_table(result, goals_only):
        out += [f"Corrected passes {'that miss a goal ' if goals_only else ''}on all threads, medians" + (f"; goal over one thread for waves of 2048 and 4096 columns: {rows.GOAL_SCALING}:" if max(row["threads"] for row in result["rows"]) == 16 else ":"), "", text]
    for name in plots.PLOTS:
        out += [f"![{name}]({pictures}{name}.svg)", ""]
    return "\n".join(out)


def write_plots(result, stem):
    """STEMsize.svg and the others: the text of each by its path. Where no pass was measured there are none."""
    if not result["rows"]:
        return {}
    return {f"{stem}{name}.svg": plot(result) for name, plot in plots.PLOTS.items()}


def made(folder):
    """What scripts/bench --document makes of docs/notes/performance/*.json: {path: text}, the made part of the document under None."""
    files, parts = {}, []
    for name in sorted(os.listdir(folder)):
        if not name.endswith(".json") or name.startswith("growth"):
            continue
        result, stem = read(os.path.join(folder, name)), name[: -len(".json")]
        files.update({os.path.join(folder, path): text for path, text in write_plots(result, stem + ".").items()})
        again = "**This run is to be made again, because something is absent.** " if result["skipped"] else ""
        parts.append(f"## {result.get('title', stem)}\n\n{again}{markdown(result, 'performance/' + stem + '.', goals_only=True)}")
    for name in sorted(os.listdir(folder)):
        if name.startswith("growth") and name.endswith(".json"):
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                result = json.load(file)
            parts.append(f"## Growth, {result['machine']['cores']} cores\n\n{growth.verdict(result)}")
    files[None] = "\n".join(parts)
    return files


def renew(document, folder):
    """{path: text} of the document and its plots, renewed."""
    with open(document, encoding="utf-8") as file:
        text = file.read()
    if text.count(BEGIN) != 1 or text.count(END) != 1 or text.index(BEGIN) > text.index(END):
        raise rows.Malformed(f"{document}: expected the lines '{BEGIN}' and '{END}' once each, in this order")
    files = made(folder)
    part = files.pop(None)
    files[document] = text[: text.index(BEGIN)] + BEGIN + "\n\n" + part + "\n" + text[text.index(END):]
    return files
