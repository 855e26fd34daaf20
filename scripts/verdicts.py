#!/usr/bin/python3
"""Verdicts of ports by device: the files of docs/devices/verdicts, and their table.

scripts/verdicts.py collect FILE BY DEVICE REPORT...   writes FILE of reports that `rainref validate --json` wrote; BY says what ran, DEVICE what
                                                       it ran on, where the ports do not know (their port.json does otherwise: "")

scripts/full/verdicts calls this. scripts/devices.py puts the table into docs/notes/devices.md.
"""
import datetime
import json
import pathlib
import sys

SCHEMA = "rainref.verdicts/1"
# Ports that compute nothing: the stems of their files, in the order of the table.
NOTHING = ["null", "zeros", "constant", "noise"]


def judged(passes):
    """Without what no GPU can reproduce, and what was not asked for."""
    return {name: status for name, status in passes.items() if status not in ("DATA", "NOT JUDGED")}


def collect(by, device, reports):
    """The content of a file."""
    first = reports[0]
    ran_on = first["device"]
    out = {"schema": SCHEMA, "date": datetime.datetime.now(datetime.timezone.utc).date().isoformat(), "rainref": first["rainref"], "by": by,
           "device": {"api": ran_on["api"], "name": device or ran_on["name"], "driver": ran_on["driver"]}, "profile": first["profile"], "packs": []}
    for report in reports:
        if report["profile"] != out["profile"]:
            sys.exit(f"{report['port']}: profile: expected {out['profile']}, found {report['profile']}")
        passes = judged({p["pass"]: p["status"] for p in report["passes"]})
        out["packs"].append({"pack": pathlib.PurePath(report["pack"]).name, "effect": report["effect"], "verdicts": passes})
    return out


def read(folder):
    """{stem: content} of a folder's files; devices by name, then the ports that compute nothing."""
    found = {}
    for path in sorted(folder.glob("*.json"), key=lambda p: (NOTHING.index(p.stem) if p.stem in NOTHING else -1, p.stem)):
        content = json.loads(path.read_text())
        if content.get("schema") != SCHEMA:
            sys.exit(f"{path}: schema: expected {SCHEMA}, found {content.get('schema')}")
        found[path.stem] = content
    return found


def of_census(census, passes):
    """[(effect, pass, status)] of a file of the census. It names the passes that did not pass; `passes` of each pack are the others. A pack
    that has changed since then is left out."""
    out = []
    for port in census["ports"]:
        names = passes.get(port["pack"], [])
        if len(names) != sum(port["verdicts"].values()):
            continue
        others = {o["pass"]: o["status"] for o in port["others"]}
        out += [(port["pack"].split("-")[0], name, others.get(name, "PASS")) for name in names]
    return out


def counts(statuses):
    """"3 PASS, 1 WARN"; "" if there are none."""
    return ", ".join(f"{statuses.count(status)} {status}" for status in sorted(set(statuses), key=statuses.index))


def cells(entries, rows):
    """The column of (effect, pass, status): all of them, then each row's."""
    by_row = {}
    for effect, name, status in entries:
        by_row.setdefault((effect, name), []).append(status)
    ordered = [status for row in rows for status in by_row.get(row, [])]
    return [counts(ordered) or "not run"] + [counts(by_row.get(row, [])) or "not run" for row in rows]


def columns(found, censuses):
    """(rows, {head: (column, whether it computes nothing)}). A row is an effect and a pass, in the order of the packs."""
    entries = {stem: [(p["effect"], name, status) for p in content["packs"] for name, status in p["verdicts"].items()]
               for stem, content in found.items()}
    rows = list(dict.fromkeys((effect, name) for column in entries.values() for effect, name, _ in column))
    rows.sort(key=lambda row: row[0])  # stable: the passes of an effect stay in their order
    passes = {}
    for content in found.values():
        for p in content["packs"]:
            if len(p["verdicts"]) > len(passes.get(p["pack"], [])):
                passes[p["pack"]] = list(p["verdicts"])
    made = {stem: cells(column, rows) for stem, column in entries.items() if stem not in NOTHING}
    made |= {f"{stem} (WGSL)": cells(of_census(census, passes), rows) for stem, census in censuses.items()}
    made |= {stem: cells(entries[stem], rows) for stem in NOTHING if stem in entries}
    return rows, made


def tables(found, censuses):
    """[(heads, rows)]: what ran, and its verdicts by pass."""
    rows, made = columns(found, censuses)
    who = [[f"[{stem}](../devices/verdicts/{stem}.json)", c["by"], " ".join(filter(None, [c["device"]["name"], c["device"]["driver"]])) or "none",
            f"`{c['profile']}`", c["date"]] for stem, c in found.items()]
    names = ["**all**"] + [f"{effect} `{name}`" for effect, name in rows]
    return [(["file", "what ran", "device", "profile", "date"], who),
            (["pass"] + list(made), [[name] + [column[i] for column in made.values()] for i, name in enumerate(names)])]


def faults(found):
    """What must not be: a port that computes nothing and does not fail, or one of them that was not run."""
    out = [f"{stem}: no such file" for stem in NOTHING if stem not in found]
    for stem in NOTHING:
        for p in found.get(stem, {"packs": []})["packs"]:
            out += [f"{stem}: {p['pack']} {name}: {status}" for name, status in p["verdicts"].items() if status != "FAIL"]
    return out


def main(arguments):
    if len(arguments) < 5 or arguments[0] != "collect":
        sys.exit(__doc__)
    file, by, device, *reports = arguments[1:]
    content = collect(by, device, [json.loads(pathlib.Path(report).read_text()) for report in reports])
    packs = content.pop("packs")
    lines = [json.dumps(content, indent=1)[:-2] + ',\n "packs": [', ",\n".join(f"  {json.dumps(p)}" for p in packs), " ]\n}\n"]
    pathlib.Path(file).write_text("\n".join(lines))


if __name__ == "__main__":
    main(sys.argv[1:])
