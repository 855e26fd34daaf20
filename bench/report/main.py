"""scripts/bench without Google Benchmark's arguments: rows, peers, tables and plots of one run; --help says the rest."""
import argparse
import json
import os
import re
import subprocess
import sys
import time

import document
import frames
import growth
import machine
import peers
import rows

WRONG_INPUT, GREW = 3, 4

# The rows of the report; the program has more (other sizes, targets, variants), see bench/README.md.
ROWS = (r"wave_step/as-published/.*", r"wave_step/corrected/rg(16|32)f/[0-9]+(/steps:5)?", r"surface_hit/.*", r"shade/.*", r"display/.*/1280x720", r"integrate/.*/(100000|1000000)", r"merge/.*/100000",
        r"splat/.*/100000", r"normals/.*", r"wipe_texture/.*", r"blur_pyramid/.*", r"composite/.*/1920x1080", r"edge_splash\.splash/.*",
        r"rain_on_glass/.*/pane/1080p", r"screen_drops\.drops/.*/1080p", r"rays/.*")


def arguments():
    parser = argparse.ArgumentParser(
        prog="scripts/bench", description="Measures rainref beside what a user would write instead. With an argument --benchmark_... "
        "it runs Google Benchmark's program instead, and passes all arguments on.",
        epilog="Exit codes: 0 done (also where the machine was not idle, or a peer is missing: the tables say so); 1 a program failed; "
        "2 a wrong option; 3 a file is malformed, or the document is not what --document makes; 4 memory grew beyond what is stated (--growth).")
    parser.add_argument("--out", default="build/bench", metavar="DIR", help="where bench.json, bench.md and plots go (default: build/bench)")
    parser.add_argument("--only", default="", metavar="REGEX", help="rows whose name this matches, and their peers")
    parser.add_argument("--row-seconds", type=float, default=0.25, metavar="S", help="least time of a row (default: 0.25)")
    parser.add_argument("--peer-seconds", type=int, default=1, metavar="S", help="time of a peer's row, at least 1 (default: 1)")
    parser.add_argument("--wait", type=float, default=60, metavar="S", help="longest wait for an idle machine (default: 60)")
    parser.add_argument("--title", default="", metavar="TEXT", help="heading of this run in the document")
    parser.add_argument("--growth", action="store_true", help="time and peak memory over drops, pixels and frames, against what is stated")
    parser.add_argument("--quick", action="store_true", help="with --growth: small sizes only")
    parser.add_argument("--table", metavar="JSON", help="print the tables of an older run, write its plots to --out, and measure nothing")
    parser.add_argument("--document", action="store_true", help="make docs/notes/performance.md and its plots of docs/notes/performance/*.json")
    parser.add_argument("--check", action="store_true", help="with --document: change nothing, and fail where something would change")
    parser.add_argument("--build", default="build/release", metavar="DIR", help="the build (default: build/release)")
    given = parser.parse_args()
    if given.row_seconds <= 0 or given.peer_seconds < 1 or given.wait < 0:
        parser.error("--row-seconds: expected above 0, --peer-seconds: at least 1, --wait: at least 0")
    try:
        re.compile(given.only)
    except re.error as problem:
        parser.error(f"--only: expected a regular expression, found '{given.only}' ({problem})")
    return given


def say(text):
    print(text, file=sys.stderr, flush=True)


def write(path, text):
    """Whole or not at all."""
    with open(path + ".part", "w", encoding="utf-8") as file:
        file.write(text)
    os.replace(path + ".part", path)


def dumps(result):
    """A row a line, so that changes of a committed file can be read."""
    parts = []
    for key, value in result.items():
        if isinstance(value, list):
            inside = ",\n".join("    " + json.dumps(entry) for entry in value)
            parts.append(f"  {json.dumps(key)}: [\n{inside}\n  ]" if value else f"  {json.dumps(key)}: []")
        else:
            parts.append(f"  {json.dumps(key)}: {json.dumps(value)}")
    return "{\n" + ",\n".join(parts) + "\n}\n"


def names_of_rows(given):
    """Of the rows of the report, as Google Benchmark names them."""
    listed = subprocess.run([os.path.join(given.build, "bench/rainref_bench"), "--benchmark_list_tests"], capture_output=True, text=True, check=True).stdout.split()
    wanted = re.compile(f"^({'|'.join(ROWS)})/")
    return [name for name in listed if wanted.search(name) and "isa=" not in name and re.search(given.only, name)]


def our_rows(given, names, seconds):
    if not names:
        return [], []
    program, out = os.path.join(given.build, "bench/rainref_bench"), os.path.join(given.out, "google_benchmark.json")
    exact = "|".join(name.replace(".", "[.]") for name in names)  # names hold no other character that means something there
    subprocess.run([program, f"--benchmark_filter=^({exact})$", "--benchmark_min_time=0.0000001", f"--benchmark_out={out}"],
                   check=True, stdout=subprocess.DEVNULL, env={**os.environ, "RAINREF_BENCH_SECONDS": str(seconds)})
    with open(out, encoding="utf-8") as file:
        found = rows.of_benchmark_file(json.load(file))
    os.remove(out)
    return found


def rates_again(given, names, row, threads):
    """Of the row and its steps:5, measured anew: {name: rate}."""
    chosen = [name for name in names if rows.split_name(name) in ((row, threads), (row + "/steps:5", threads))]
    return {found["row"]: found["rate"] for found in our_rows(given, chosen, given.row_seconds / peers.TURNS)[0]}


def thread_counts():
    """1, 2, 4 ... and all."""
    every = len(os.sched_getaffinity(0))
    return sorted({*(1 << k for k in range(every.bit_length()) if 1 << k < every), every})


def measure(given):
    begin = time.monotonic()
    os.makedirs(os.path.join(given.out, "captures"), exist_ok=True)
    say("Captures for the software device")
    prepared, skipped = peers.prepare_ports(given.build, os.path.join(given.out, "captures"), lambda row: re.search(given.only, row))
    say(f"Waiting for an idle machine, {given.wait:g} s at most")
    idle = machine.wait_until_idle(given.wait)
    watch = machine.Watch()
    names, counts = names_of_rows(given), thread_counts()
    say(f"{len(names)} rows")
    ours, beside = our_rows(given, names, given.row_seconds)
    if any(row["row"].startswith(peers.WAVE) for row in ours):
        say("NumPy and Numba")
        found, missing = peers.waves(counts, given.peer_seconds / 2, lambda row, threads: rates_again(given, names, row, threads))
        beside, skipped = beside + found, skipped + missing
    say("Mesa's software device")
    found, missing = peers.ports(given.build, given.out, prepared, counts[-1], given.peer_seconds)
    beside, skipped = beside + found, skipped + missing
    whole, missing = frames.measure(os.path.join(given.build, "bin/rainref"), given.out, thread_counts(), given.only, say)
    skipped = skipped + missing
    if not ours and not any(whole.values()):
        raise rows.Malformed(f"--only {given.only}: no row has such a name (--benchmark_list_tests prints those of passes)")
    idle["others_during_percent"] = watch.others_percent()
    for one in skipped:  # a run is committed: the machine's folders are nobody's concern
        one["reason"] = document.without_folders(one["reason"])
    return {"format": document.FORMAT, "version": 1, "title": given.title or f"{machine.describe()['cores']} cores", "machine": machine.describe(),
            "idle": idle, "seconds": round(time.monotonic() - begin), "rows": ours, "peers": beside, "skipped": skipped, **whole}


def report(given, result):
    os.makedirs(given.out, exist_ok=True)
    for path, text in document.write_plots(result, os.path.join(given.out, "")).items():
        write(path, text)
    text = document.markdown(result, "") + ("\n" + document.rows_table(result) if result["rows"] else "")
    write(os.path.join(given.out, "bench.md"), text)
    print(text)


def make_document(check):
    files = document.renew("docs/notes/performance.md", "docs/notes/performance")
    stale = []
    for path, text in files.items():
        try:
            with open(path, encoding="utf-8") as file:
                same = file.read() == text
        except OSError:
            same = False
        if not same:
            stale.append(path)
            if not check:
                write(path, text)
    if check and stale:
        say(f"not what scripts/bench --document makes: {', '.join(stale)}")
        return WRONG_INPUT
    say(f"renewed: {', '.join(stale) or 'nothing'}")
    return 0


def main():
    given = arguments()
    try:
        if given.document:
            return make_document(given.check)
        if given.table:
            report(given, document.read(given.table))
            return 0
        if given.growth:
            os.makedirs(given.out, exist_ok=True)
            result = growth.measure(os.path.join(given.build, "bin/rainref"), given.out, given.quick, say)
            write(os.path.join(given.out, "growth.json"), dumps(result))
            write(os.path.join(given.out, "growth.md"), growth.markdown(result))
            print(growth.markdown(result))
            return GREW if result["faults"] else 0
        result = measure(given)
        write(os.path.join(given.out, "bench.json"), dumps(result))
        report(given, result)
        return 0
    except rows.Malformed as problem:
        say(f"scripts/bench: {problem}")
        return WRONG_INPUT
    except (subprocess.CalledProcessError, OSError) as problem:
        say(f"scripts/bench: {problem}")
        return 1


if __name__ == "__main__":
    sys.exit(main())
