"""scripts/bench without measuring: rows, comparisons, tables, plots and the document, made of committed JSON. No time is asserted."""
import copy
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml
from unittest import mock

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "bench/report"))
import document  # noqa: E402
import frames  # noqa: E402
import growth  # noqa: E402
import peers  # noqa: E402
import plots  # noqa: E402
import rows  # noqa: E402

FOLDER = os.path.join(ROOT, "docs/notes/performance")
RUNS = sorted(name for name in os.listdir(FOLDER) if name.endswith(".json") and not name.startswith("growth"))


def committed():
    return document.read(os.path.join(FOLDER, RUNS[0]))


def bench(*arguments):
    return subprocess.run([sys.executable, "-B", "bench/report/main.py", *arguments], cwd=ROOT, capture_output=True, text=True)


ENTRY = {"name": "wave_step/corrected/rg16f/1024/threads:2/manual_time", "Gcell/s": 4.0, "best_ms": 0.25, "q1_ms": 0.3, "median_ms": 0.5,
         "q3_ms": 0.6, "goes": 40.0, "stream_%": 50.0, "label": "0123456789abcdef"}


class Rows(unittest.TestCase):
    def test_quantiles_of_few_values(self):
        self.assertEqual(rows.quantile([3, 1, 2], 0.5), 2)
        self.assertEqual(rows.quantile([0, 10], 0.25), 2.5)
        self.assertEqual(rows.quantile([7], 0.75), 7)

    def test_the_rate_is_of_the_median(self):
        row = rows.of_benchmark(ENTRY)
        # The fastest go made 4 Gcell/s in half of the median's time.
        self.assertEqual((row["row"], row["threads"], row["unit"], row["rate"]), ("wave_step/corrected/rg16f/1024", 2, "cell", 2000.0))
        self.assertEqual((row["hash"], row["stream_percent"], row["goes"]), ("0123456789abcdef", 50.0, 40))

    def test_what_follows_the_threads_stays_in_the_name(self):
        self.assertEqual(rows.split_name("rays/camera/1920x1080/threads:16/iterations:15/manual_time"), ("rays/camera/1920x1080", 16))
        self.assertEqual(rows.split_name("traced/640x360/threads:1/isa=sse2/manual_time"), ("traced/640x360/isa=sse2", 1))

    def test_malformed_rows_say_what_was_expected(self):
        with self.assertRaisesRegex(rows.Malformed, "expected /threads:N"):
            rows.of_benchmark({**ENTRY, "name": "wave_step/1024"})
        with self.assertRaisesRegex(rows.Malformed, "expected one of Gcell/s"):
            rows.of_benchmark({k: v for k, v in ENTRY.items() if k != "Gcell/s"})
        with self.assertRaisesRegex(rows.Malformed, "other bits"):
            rows.of_benchmark({**ENTRY, "error_occurred": True, "error_message": "other bits"})
        with self.assertRaisesRegex(rows.Malformed, "no rows"):
            rows.of_benchmark_file({"benchmarks": []})

    def test_rays_bring_their_peer(self):
        entry = {"name": "rays/camera/1920x1080/threads:1/iterations:15/manual_time", "Mray/s": 60.0, "median_ms": 10.0, "q1_ms": 9.0,
                 "q3_ms": 11.0, "goes": 15.0, "label": "a", "native_median_ms": 20.0, "native_q1_ms": 19.0, "native_q3_ms": 21.0, "ratio": 2.1,
                 "ratio_with_update": 2.5}
        ours, beside = rows.of_benchmark_file({"benchmarks": [entry]})
        self.assertEqual((ours[0]["rate"], beside[0]["peer"], beside[0]["rate"]), (60.0, "embree", 30.0))
        found = rows.comparisons({"rows": ours, "peers": beside})[0]
        self.assertEqual((found["ratio"], found["goal"]), (2.5, 2.0))

    def test_a_peer_is_beside_the_row_of_its_threads(self):
        ours = [dict(rows.of_benchmark(ENTRY), row="wave_step/corrected/rg32f/1024", threads=n, rate=100.0 * n) for n in (1, 2)]
        numba = [rows.of_times("numba", ours[0]["row"], n, "cell", 1000, [1e-5 / n] * 3, "") for n in (1, 2, 4)]
        numpy = [rows.of_times("numpy", ours[0]["row"], 1, "cell", 1000, [1e-4] * 3, "")]
        found = [(c["peer"], c["threads"], c["ratio"], c["goal"]) for c in rows.comparisons({"rows": ours, "peers": numba + numpy})]
        self.assertEqual(found, [("numba", 1, 1.0, 1.5), ("numba", 2, 1.0, 1.5), ("numpy", 1, 10.0, None)])

    def test_a_loop_of_steps_is_beside_a_step_and_the_steps_of_a_frame(self):
        name = "wave_step/corrected/rg32f/1024"
        ours = [dict(rows.of_benchmark(ENTRY), row=name + steps, threads=1, rate=rate)
                for steps, rate in (("", 100.0), ("/steps:5", 150.0))]
        numba = rows.of_times("numba", name, 1, "cell", 1000, [1e-5, 2e-5, 3e-5], "")  # 50 million a second
        found = [(c["row"], c["ratio"]) for c in rows.comparisons({"rows": ours, "peers": [numba]})]
        self.assertEqual(found, [(name, 2.0), (name + "/steps:5", 3.0)])

    def test_ratios_of_turns_come_before_those_of_medians(self):
        name = "wave_step/corrected/rg32f/1024"
        ours = [dict(rows.of_benchmark(ENTRY), row=name + steps, threads=1, rate=100.0) for steps in ("", "/steps:5")]
        numba = rows.of_times("numba", name, 1, "cell", 1000, [2e-5] * 3, "", ratios={name + "/steps:5": 1.7})
        self.assertEqual([c["ratio"] for c in rows.comparisons({"rows": ours, "peers": [numba]})], [2.0, 1.7])

    def test_goals_are_the_issues(self):
        of = {name: rows.goal({"peer": "lavapipe", "row": name + "/corrected"}) for name in ("composite", "edge_splash.splash", "rain_on_glass")}
        self.assertEqual(of, {"composite": 3.5, "edge_splash.splash": 6.0, "rain_on_glass": 3.0})


class WavePeers(unittest.TestCase):
    """A program in the place of Numba answers what each case gives it."""

    def waves(self, program, ours):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "peer_wave.py"), "w", encoding="utf-8") as file:
                file.write(program)
            with mock.patch.object(peers, "__file__", os.path.join(folder, "peers.py")), \
                    mock.patch.object(peers, "python_with_numpy", lambda: sys.executable):
                return peers.waves([1, 2], 0.5, ours)

    # Seconds of a step: 1, 2, 4 of the turns with as many millionths of a second a cell.
    ANSWERS = """
import itertools, json, sys
turns = itertools.cycle((1, 2, 4))
for line in sys.stdin:
    peer, side, threads, seconds = line.split()
    turn = next(turns) if peer == "numba" else 1
    print(json.dumps({"seconds": [turn * 1e-6 * int(side) ** 2] * 3, "hash": "h", "version": "0"}), flush=True)
"""

    def test_the_ratio_is_the_median_of_turns(self):
        asked = []

        def ours(row, threads):
            asked.append((row, threads))
            return {row: (8.0, 7.0, 1.0)[len(asked) % 3 - 1]}  # millions of cells a second, beside 1, 1/2, 1/4: ratios 8, 14, 4

        found, skipped = self.waves(self.ANSWERS, ours)
        self.assertEqual(skipped, [])
        numba = [row for row in found if row["peer"] == "numba"]
        self.assertEqual([(r["row"], r["threads"], r["ratios"], r["goes"]) for r in numba],
                         [(f"{peers.WAVE}{side}", threads, {f"{peers.WAVE}{side}": 8.0}, 9) for threads in (1, 2) for side in peers.SIDES])
        self.assertEqual(len(asked), len(numba) * peers.TURNS)
        self.assertEqual({row["rate"] for row in numba}, {0.5})
        self.assertEqual([row["threads"] for row in found if row["peer"] == "numpy"], [1, 1, 1])

    def test_a_peer_that_fails_is_named_and_the_others_stay(self):
        program = self.ANSWERS.replace("    turn = ", "    if peer == 'numba' and threads == '2':\n        print('{\"reason\": \"no\"}', flush=True)\n        continue\n    turn = ")
        found, skipped = self.waves(program, lambda row, threads: {row: 1.0})
        self.assertEqual(skipped, [{"peer": "numba", "reason": "no"}])
        self.assertEqual([(r["peer"], r["threads"]) for r in found], [("numpy", 1)] * 3 + [("numba", 1)] * 3)

    def test_a_program_that_ends_is_named_by_its_last_line(self):
        found, skipped = self.waves("raise SystemExit('broken')", lambda row, threads: {row: 1.0})
        self.assertEqual((found, skipped), ([], [{"peer": name, "reason": "broken"} for name in ("numpy", "numba")]))


class Frames(unittest.TestCase):
    RUN = {"frames": [{"scene": "puddle/stress", "threads": n, "q1_ms": q, "median_ms": q, "q3_ms": 1.2 * q, "hash": "0123"}
                      for n, q in ((1, 96.0), (16, 8.0))],
           "starts": [{"scene": "puddle/default", "first_s": 1.5, "frame_s": 0.5, "kept_s": 0.3}]}

    def test_the_ratio_is_to_one_thread_and_a_goal_is_met_from_its_value_on(self):
        text = frames.markdown(self.RUN)
        self.assertIn("quartiles within ± 10 %; goal over one thread: 12:", text)
        self.assertIn("| scene | 1 | 16 | over one thread |", text)
        self.assertIn("| `puddle/stress` | 96 | 8 | 12.00 |", text)
        self.assertIn("| `puddle/default` | 0.30 | 0.50 |  | 1.50 |", text)
        slower = copy.deepcopy(self.RUN)
        slower["frames"][1]["median_ms"], slower["starts"][0]["kept_s"] = 8.01, 0.31
        text = frames.markdown(slower)
        self.assertIn("| `puddle/stress` | 96 | 8.01 | **11.99** |", text)
        self.assertIn("| `puddle/default` | **0.31** |", text)

    def test_a_run_without_them_has_no_tables(self):
        self.assertEqual(frames.markdown({"rows": []}), "")

    def test_a_run_of_frames_alone_is_a_whole_report(self):
        result = {**committed(), "rows": [], "peers": [], **self.RUN}
        self.assertIn("puddle/stress", document.markdown(result, ""))
        self.assertEqual(document.write_plots(result, ""), {})

    def test_every_scene_is_there(self):
        for scene in (*frames.SCENES, *(f"{effect}/default" for effect in frames.EFFECTS)):
            self.assertTrue(os.path.isfile(os.path.join(ROOT, "scenes", scene + ".toml")), scene)


class Documents(unittest.TestCase):
    def test_a_committed_run_has_all_that_the_bench_promises(self):
        for name in RUNS:
            result = document.read(os.path.join(FOLDER, name))
            self.assertTrue(all(row["hash"] for row in result["rows"] if not row["row"].startswith("wipe_texture")), name)
            self.assertIn("others_during_percent", result["idle"])
            there = {p["peer"] for p in result["peers"]} | {s["peer"] for s in result["skipped"] if not s["peer"].startswith("PNG of ")}
            self.assertEqual(there, {"embree", "numpy", "numba", "lavapipe"}, f"{name}: measured or named as skipped")
            counts = sorted({row["threads"] for row in result["rows"]})
            self.assertEqual(counts[0], 1)
            for port in peers.PORTS:
                self.assertIn((port[0], counts[-1]), {(row["row"], row["threads"]) for row in result["rows"]})
            for row in result["rows"] + result["peers"]:
                self.assertLessEqual(row["q1_ms"], row["median_ms"])
                self.assertLessEqual(row["median_ms"], row["q3_ms"])

    def test_the_document_is_what_the_script_makes(self):
        done = bench("--document", "--check")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_check_finds_an_edit(self):
        with tempfile.TemporaryDirectory() as folder:
            copy_of = os.path.join(folder, "performance.md")
            with open(os.path.join(ROOT, "docs/notes/performance.md"), encoding="utf-8") as file:
                text = file.read()
            with open(copy_of, "w", encoding="utf-8") as file:
                file.write(text.replace("Gcell/s", "Tcell/s"))
            self.assertEqual(document.renew(copy_of, FOLDER)[copy_of], text)
            with open(copy_of, "w", encoding="utf-8") as file:
                file.write(text.replace(document.END, ""))
            with self.assertRaisesRegex(rows.Malformed, "once each"):
                document.renew(copy_of, FOLDER)

    def test_check_of_an_edited_document_fails_and_changes_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            shutil.copytree(os.path.join(ROOT, "docs/notes"), os.path.join(folder, "docs/notes"))
            edited = os.path.join(folder, "docs/notes/performance", RUNS[0].replace(".json", ".size.svg"))
            with open(edited, "a", encoding="utf-8") as file:
                file.write("<!-- by hand -->")
            command = [sys.executable, "-B", os.path.join(ROOT, "bench/report/main.py"), "--document"]
            done = subprocess.run(command + ["--check"], cwd=folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 3)
            self.assertIn(os.path.basename(edited), done.stderr)
            with open(edited, encoding="utf-8") as file:
                self.assertIn("by hand", file.read())
            self.assertEqual(subprocess.run(command, cwd=folder, capture_output=True).returncode, 0)
            with open(edited, encoding="utf-8") as file:
                self.assertNotIn("by hand", file.read())

    def test_a_goal_is_met_from_its_value_on(self):
        result = committed()
        result["rows"] = [dict(rows.of_benchmark(ENTRY), row="composite/corrected/1920x1080", unit="pixel", rate=rate, threads=n)
                          for n, rate in ((1, 35.0), (2, 34.99))]
        result["peers"] = [dict(result["rows"][0], peer="lavapipe", rate=10.0, threads=n) for n in (1, 2)]
        text = document.peers_table(result)
        # A goal that is missed is bold, and not rounded up to what it should be.
        self.assertIn("| `composite/corrected/1920x1080` | lavapipe | 3.50 | **3.49** (50 %) | 3.5 |", text)
        # The percentage of the stream stands only where a goal is missed and there is a stream.
        for row in result["rows"]:
            del row["stream_percent"]
        self.assertIn("| 3.50 | **3.49** | 3.5 |", document.peers_table(result))

    def test_the_wave_on_sixteen_threads_is_beside_one(self):
        def row(name, threads, rate):
            return dict(rows.of_benchmark(ENTRY), row=name, unit="cell", threads=threads, rate=rate, stream_percent=75.2)
        result = {"rows": [row("wave_step/corrected/rg32f/" + side, n, rate)
                           for side, rates in (("1024", (1, 1, 1)), ("2048/steps:5", (10, 20, 120)), ("4096", (10, 20, 119.9))) for n, rate in zip((1, 2, 16), rates)]}
        text = document.passes_table(result)
        self.assertIn("| `wave_step/rg32f/2048/steps:5` | 0.12 Gcell/s | 12.00 | 75 |", text)
        self.assertIn("| `wave_step/rg32f/4096` | 0.12 Gcell/s | **11.99** | 75 |", text)
        self.assertIn("| `wave_step/rg32f/1024` | 0.001 Gcell/s | 1.00 | 75 |", text)  # of this size no goal is missed: there is none
        self.assertNotIn("**", document.passes_table({"rows": [r for r in result["rows"] if r["threads"] < 16]}))

    def test_every_row_stands_in_a_report_and_corrected_ones_in_the_document(self):
        result = committed()
        every, corrected = document.rows_table(result), document.passes_table(result)
        self.assertEqual(every.count("\n"), 2 + len(result["rows"]))
        self.assertEqual(corrected.count("\n"), 2 + len({row["row"] for row in result["rows"] if "/as-published" not in row["row"]}))
        self.assertEqual(document.passes_table({"rows": []}), "")

    def test_a_run_that_lacks_something_is_to_be_made_again(self):
        with tempfile.TemporaryDirectory() as folder:
            for skipped, count in (([{"peer": "numba", "reason": "not installed"}], 1), ([], 0)):
                with open(os.path.join(folder, "a.json"), "w", encoding="utf-8") as file:
                    json.dump({**committed(), "skipped": skipped}, file)
                self.assertEqual(document.made(folder)[None].count("**This run is to be made again"), count)

    def test_starts_keep_nothing_in_the_users_cache(self):
        caches = []

        def run(rainref, folder, cache, scene, frame_count, more):
            caches.append(cache)
            return {"seconds": 0.1}, 0.3
        with mock.patch.object(frames, "_run", run):
            found, _ = frames.measure("rainref", os.path.join("no", "folder"), [1], "^start/windshield", lambda text: None)
        self.assertEqual([row["scene"] for row in found["starts"]], ["windshield/default"])
        self.assertTrue(caches and all(os.path.isabs(cache) for cache in caches), caches)  # XDG: a relative one is to be ignored

    def test_a_busy_machine_and_a_skipped_peer_are_said(self):
        result = committed()
        result["idle"] = {"waited_s": 60, "others_percent": 40.0, "idle": False, "others_during_percent": 33.0}
        result["skipped"] = [{"peer": "numba", "reason": "not installed"}]
        text = document.markdown(result, "")
        self.assertIn("**The machine was not idle**: others took 40.0 % of it after 60 s of waiting; others took 33.0 %", text)
        self.assertIn("- Absent from this run: numba: not installed", text)

    def test_reasons_name_no_folder_of_the_machine(self):
        for said, kept in [("cannot load 'x.so': found in none of /tmp/d/lib, build/lib, /lib/x86_64-linux-gnu, /lib",
                            "cannot load 'x.so': found in none of lib, build/lib, x86_64-linux-gnu, lib"),
                           (f"{os.getcwd()}/build/a is not built", "build/a is not built"), ("'/root/a b': 1/2 of https://x.org/y", "'a b': 1/2 of https://x.org/y")]:
            self.assertEqual(document.without_folders(said), kept)

    def test_files_that_are_not_runs_are_refused(self):
        good = committed()
        for change, message in (({"format": "x"}, "expected rainref.bench, found x"), ({"rows": {}}, "rows: expected a list, found dict"),
                                ({"rows": [{"row": "a"}]}, "row 0: expected the key threads")):
            with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
                json.dump({**copy.deepcopy(good), **change}, file)
                file.flush()
                done = bench("--table", file.name, "--out", os.path.dirname(file.name))
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertIn(message, done.stderr)
                self.assertEqual(done.stdout, "")

    def test_wrong_options_exit_with_the_code_of_usage(self):
        for wrong in (["--sped"], ["--peer-seconds", "0"], ["--only", "("], ["--row-seconds", "x"]):
            self.assertEqual(bench(*wrong).returncode, 2, wrong)

    def test_tables_of_an_older_run_are_written_with_plots(self):
        with tempfile.TemporaryDirectory() as folder:
            done = bench("--table", os.path.join(FOLDER, RUNS[0]), "--out", folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(sorted(os.listdir(folder)), ["bench.md", "roofline.svg", "scaling.svg", "size.svg"])


    def test_rates_are_said_as_people_say_them(self):
        self.assertEqual([document.rate_text(rate, unit) for rate, unit in ((71.34, "pixel"), (3600.0, "drop"), (120.0, "cell"), (999.4, "ray"))],
                         ["71.3 Mpix/s", "3.6 Gdrop/s", "0.12 Gcell/s", "999 Mray/s"])


class Plots(unittest.TestCase):
    def points(self, text):
        return xml.fromstring(text).findall("{http://www.w3.org/2000/svg}circle")

    def test_points_stand_where_their_values_are(self):
        text = plots.svg("t", "x", "y", [("a", [(1, 1), (10, 10), (100, 100)], {})])
        x, y = [[float(c.get(k)) for c in self.points(text)] for k in ("cx", "cy")]
        # On logarithmic axes equal factors are equal distances; the larger value is above (its y is less).
        self.assertAlmostEqual(x[1] - x[0], x[2] - x[1], delta=0.2)
        self.assertAlmostEqual(y[1] - y[0], y[2] - y[1], delta=0.2)
        self.assertLess(y[1], y[0])

    def test_every_row_of_a_run_is_a_point(self):
        result = committed()
        most = max(row["threads"] for row in result["rows"])
        waves = [row for row in result["rows"] if row["row"].startswith("wave_step/") and row["threads"] == most]
        beside = [p for p in result["peers"] if p["row"].startswith("wave_step/") and (p["threads"] == most or p["peer"] == "numpy")]
        self.assertEqual(len(self.points(plots.size(result))), len(waves) + len(beside))
        bounded = [row for row in result["rows"] if "stream_percent" in row and row["threads"] == most and "/corrected" in row["row"]
                   and "steps" not in row["row"]]
        self.assertEqual(len(self.points(plots.roofline(result))), len(bounded))

    def test_nothing_leaves_the_picture_and_names_are_escaped(self):
        result = committed()
        result["rows"][0]["row"] = result["rows"][0]["row"].replace("corrected", "<&>")
        for name, plot in plots.PLOTS.items():
            root = xml.fromstring(plot(result))  # well formed
            for element in root.iter():
                for key, limit in (("cx", plots.WIDTH), ("x", plots.WIDTH), ("cy", plots.HEIGHT), ("y", plots.HEIGHT)):
                    if element.get(key):
                        self.assertTrue(0 <= float(element.get(key)) <= limit, (name, element.attrib))

    def test_a_run_on_one_thread_has_a_scaling_plot(self):
        result = committed()
        for rows_of in (result["rows"], result["peers"]):
            rows_of[:] = [row for row in rows_of if row["threads"] == 1]
        self.assertIn("no rows on several threads", plots.scaling(result))


class Growth(unittest.TestCase):
    def row(self, series, size, stated, taken):
        return {"series": series, "size": size, "items": size, "frames": 1, "stated_mib": stated, "taken_mib": taken, "seconds": 1.0}

    def test_what_is_stated_may_be_taken(self):
        self.assertEqual(growth.faults([self.row("drops: x", 1000, 20, 22), self.row("drops: x", 100000, 200, 215)]), [])

    def test_more_than_is_stated_is_a_fault(self):
        found = growth.faults([self.row("drops: x", 1000, 20, 22), self.row("drops: x", 100000, 200, 232)])
        self.assertTrue(any("232 MiB taken, 200 stated" in fault for fault in found), found)

    def test_growth_with_frames_is_a_fault_unless_it_is_stated(self):
        frames = "frames: x"
        self.assertEqual(growth.faults([self.row(frames, 1, 20, 15), self.row(frames, 10, 20, 20), self.row(frames, 10000, 20, 23)]), [])
        found = growth.faults([self.row(frames, 1, 20, 15), self.row(frames, 10, 20, 20), self.row(frames, 10000, 20, 25)])
        self.assertEqual(found, [f"{frames}: 5.0 MiB more after 10000 frames than after 10"])
        self.assertEqual(growth.faults([self.row(frames, 10, 20, 20), self.row(frames, 10000, 30, 30)]), [])

    def test_a_busy_machine_is_said(self):
        result = {"rows": [self.row("drops: x", 1, 20, 20)], "skipped": [], "faults": [], "others_percent": None}
        self.assertIn("times here are no measure", growth.markdown(result))
        self.assertIn("Others took 3.5 %", growth.markdown({**result, "others_percent": 3.5}))

    def test_a_series_is_a_line_from_its_smallest_to_its_largest_size(self):
        result = {"rows": [self.row("pixels: x", 1 << 10, 20, 21), self.row("pixels: x", 1 << 15, 25, 26), self.row("pixels: x", (1 << 20) + (1 << 10), 30, 32),
                           self.row("frames: x", 1, 20, 21), self.row("frames: x", 100, 20, 22)], "skipped": [], "faults": []}
        text = growth.markdown(result)
        self.assertIn("| pixels: x | 1024 | 21.0 | 1049600 | 32.0 | 30.0 | 1.00 | 10.0 | 11.0 |", text)
        self.assertIn("| frames: x | 1 | 21.0 | 100 | 22.0 | 20.0 | 1.00 |  |  |", text)

    def test_bytes_of_an_item(self):
        self.assertEqual(growth.per_item([self.row("p", 0, 1, 2), self.row("p", 1 << 20, 9, 12)]), [8.0, 10.0])

    def test_a_committed_run_grew_nowhere(self):
        for name in os.listdir(FOLDER):
            if name.startswith("growth"):
                with open(os.path.join(FOLDER, name), encoding="utf-8") as file:
                    result = json.load(file)
                self.assertEqual((growth.faults(result["rows"]), result["faults"]), ([], []))
                # The sizes of each series are whole, or a line says why not.
                there = {(row["series"], row["size"]) for row in result["rows"] + result["skipped"]}
                self.assertEqual(there, {(case[0], case[1]) for case in growth.cases(False)})


class Captures(unittest.TestCase):
    def test_the_last_case_of_the_pass_is_kept(self):
        with tempfile.TemporaryDirectory() as folder:
            manifest = os.path.join(folder, "manifest.json")
            with open(manifest, "w", encoding="utf-8") as file:
                json.dump({"cases": [{"pass": "a", "id": 1}, {"pass": "a", "id": 2}, {"pass": "b", "id": 3}]}, file)
            peers.keep_last_case(manifest, "a")
            with open(manifest, encoding="utf-8") as file:
                self.assertEqual(json.load(file)["cases"], [{"pass": "a", "id": 2}])
            with self.assertRaisesRegex(KeyError, "no case of c"):
                peers.keep_last_case(manifest, "c")

    def test_programs_that_are_not_built_skip_the_peer(self):
        found, skipped = peers.prepare_ports("/nowhere", "/nowhere", lambda row: True)
        self.assertEqual((found, skipped[0]["peer"]), ([], "lavapipe"))
        self.assertTrue(re.search("is not built", skipped[0]["reason"]))


if __name__ == "__main__":
    unittest.main()
