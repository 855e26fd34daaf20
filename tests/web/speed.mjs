// node speed.mjs RAINREF_MODULE.js SITE RAINREF SOURCES: how fast the site's library is on one core, and how large a page's first view is. Figures, no test:
// run it where nothing else does.
import {spawnSync} from "node:child_process";
import fs from "node:fs";
import {createRequire} from "node:module";
import os from "node:os";
import path from "node:path";
import zlib from "node:zlib";

const [modulePath, site, rainref, sources] = process.argv.slice(2);
const m = await createRequire(import.meta.url)(path.resolve(modulePath))();
const check = result => { if (result !== 0) throw new Error(m.UTF8ToString(m._rr_error())); };
const given = (f, ...args) => {
  const to = m._malloc(4);
  check(f(...args, to));
  return m.getValue(to, "i32");
};
const middle = values => values.sort((a, b) => a - b)[values.length >> 1];
/// Milliseconds of the processor, which do not count what else runs on the machine.
const timed = work => {
  const begin = process.cpuUsage();
  work();
  const {user, system} = process.cpuUsage(begin);
  return (user + system) / 1000;
};

console.log("640x360, milliseconds of one core: opening, frame 0, a frame (middle of 21), the same with its hashes; frames a second with hashes");
for (const effect of ["puddle", "windshield", "edge_splash", "screen_drops", "rainy_glass"]) {
  const text = m.stringToNewUTF8(fs.readFileSync(path.join(sources, `scenes/${effect}/default.toml`), "utf8")), set = m._malloc(8), options = m._malloc(20);
  ["run.size=[640, 360]", "run.supersample=1"].forEach((text, k) => m.setValue(set + 4 * k, m.stringToNewUTF8(text), "i32"));
  [20, 0, set, 2, 1].forEach((value, k) => m.setValue(options + 4 * k, value, "i32"));
  let simulation = 0;
  const opening = timed(() => { simulation = given(m._rr_open, text, options); }), first = timed(() => check(m._rr_next_frame(simulation)));
  const plain = middle(Array.from({length: 21}, () => timed(() => check(m._rr_next_frame(simulation)))));
  const hashed = middle(Array.from({length: 21}, () => timed(() => given(m._rr_next_frame_hashes, simulation))));
  m._rr_close(simulation);
  console.log([effect, ...[opening, first, plain, hashed].map(t => t.toFixed(1)), (1000 / hashed).toFixed(1)].join("  "));
}

// The judge: the expected outputs of a small pack as a port, here and natively on one thread.
const pack = path.join(sources, "build/release/packs/puddle-corrected");
for (const name of fs.readdirSync(pack, {recursive: true})) {
  const from = path.join(pack, name), to = path.join("/pack", name);
  if (fs.statSync(from).isDirectory()) continue;
  m.FS.mkdirTree(path.dirname(to));
  m.FS.writeFile(to, fs.readFileSync(from));
}
function judged() {
  const cases = given(m._rr_cases_of_pack, m.stringToNewUTF8("/pack"), 0, 0), array = m._malloc(64), word = k => m.getValue(array + 4 * k, "i32");
  for (let c = 0; c < m._rr_case_count(cases); ++c) {
    for (let output = 0;; ++output) {
      m.setValue(array, 64, "i32");
      if (m._rr_get_expected(cases, c, output, array) !== 0) break;
      const records = word(15) !== 0;
      check(m._rr_give(cases, c, output, word(11), records ? word(9) : word(10), records ? word(5) : word(6)));
    }
  }
  m._rr_free_judgement(given(m._rr_judge, cases, 0));
  m._rr_free_cases(cases);
}
const port = fs.mkdtempSync(path.join(os.tmpdir(), "speed-"));
fs.cpSync(pack, path.join(port, "port"), {recursive: true});
fs.rmSync(path.join(port, "port/manifest.json"));
const natively = () => {
  const run = spawnSync("bash", ["-c", 'TIMEFORMAT="%U %S"; time "$@" >&2', "bash", path.resolve(rainref), "validate", pack, "--port", path.join(port, "port"), "--threads", "1"],
    {encoding: "utf8"});
  if (run.status !== 0) throw new Error(run.stdout + run.stderr);
  const [user, system] = run.stderr.trimEnd().split("\n").at(-1).split(" ").map(Number);
  return 1000 * (user + system);
};
judged();
const here = middle(Array.from({length: 5}, () => timed(judged))), native = middle(Array.from({length: 5}, natively));
fs.rmSync(port, {recursive: true});
console.log(`judging puddle-corrected: ${here.toFixed(0)} ms, natively on one thread ${native.toFixed(0)} ms (its start included): ${(here / native).toFixed(2)} times`);

// What live.html loads before it shows a picture: the page with all that it imports, the library, the list of scenes and the scene.
const {gzipSync, brotliCompressSync} = zlib, seen = new Set();
function follow(name) {
  if (seen.has(name)) return;
  seen.add(name);
  const text = fs.readFileSync(path.join(site, name), "utf8");
  for (const [, other] of text.matchAll(/(?:from |import\(|href=|src=|importScripts\()"(?!data:)([^"#]+\.(?:js|css))"/g)) follow(path.posix.join(path.posix.dirname(name), other));
}
for (const name of ["live.html", "live_operations.js", "engine_worker.js"]) follow(name);
const size = (names, pack) => names.reduce((sum, name) => sum + pack(fs.readFileSync(path.join(site, name))).length, 0), kB = bytes => `${(bytes / 1000).toFixed(0)} kB`;
const gzip = bytes => gzipSync(bytes, {level: 9}), all = [...seen, "rainref_simulator.js", "scenes/index.json", "scenes/puddle/default.toml"];
console.log(`live.html: page ${kB(size(all, gzip))} by gzip in ${all.length} files`);
for (const name of ["rainref_simulator.wasm", "rainref_module.wasm"])
  console.log(`${name}: ${kB(size([name], gzip))} by gzip, ${kB(size([name], brotliCompressSync))} by brotli`);
