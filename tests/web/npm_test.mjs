// node npm_test.mjs PACKAGE PACK HASHES RAINREF: the assembled npm package. Its frames have the lines that the native program printed
// (HASHES/hash-<effect>.native), with presets those that it prints now (RAINREF), and its command judges a pack's own outputs, whole and with
// one of them broken.
import assert from "node:assert";
import {spawnSync} from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import {pathToFileURL} from "node:url";

const [folder, pack, hashes, native] = process.argv.slice(2).map(name => path.resolve(name));
const {loadRainref, RainrefError} = await import(pathToFileURL(path.join(folder, "index.mjs")));
const command = (...words) => spawnSync(process.execPath, [path.join(folder, "bin/rainref.mjs"), ...words], {encoding: "utf8"});

const rainref = await loadRainref({judge: false});
assert.strictEqual(rainref.version, JSON.parse(fs.readFileSync(path.join(folder, "package.json"))).version);
for (const effect of rainref.effects) {
  const native = fs.readFileSync(path.join(hashes, `hash-${effect}.native`), "utf8").split("\n").filter(line => /^\d/.test(line));
  const toml = fs.readFileSync(path.join(folder, "scenes", effect, "default.toml"), "utf8"), set = ["run.size=[64, 36]"];
  const rain = rainref.open(toml, {set});
  assert.deepStrictEqual([0, 1, 2].flatMap(() => rain.nextFrameHashes()), native, effect);
  assert.strictEqual(rain.info.frame, 3);
  const {width, height, data} = rain.picture();
  assert.deepStrictEqual([width, height, data.length], [64, 36, 4 * 64 * 36]);
  for (const name of rain.buffers) assert(rain.buffer(name).planes.length > 0, name);
  rain.close();
  const said = command("hash", `${effect}/default.toml`, "--set", set[0], "--frames", "3");
  assert.deepStrictEqual(said.stdout.trimEnd().split("\n"), native, said.stderr);
}
for (const preset of ["storm,night", "drizzle,day"]) {
  const words = ["hash", "puddle/default", "--preset", preset, "--set", "run.size=[64, 36]", "--frames", "2"];
  const said = command(...words), natively = spawnSync(native, words, {cwd: os.tmpdir(), encoding: "utf8"});
  assert.notStrictEqual(natively.stdout, "", natively.stderr);
  assert.strictEqual(said.stdout, natively.stdout.split("\n").filter(line => /^\d/.test(line)).join("\n") + "\n", said.stderr);
}
assert.throws(() => rainref.open("effect = 'pudle'"), error => error instanceof RainrefError && error.code === 2);

const port = fs.mkdtempSync(path.join(os.tmpdir(), "rainref-npm-"));
try {
  fs.cpSync(pack, port, {recursive: true, filter: from => path.basename(from) !== "manifest.json"});
  const page = path.join(port, "page.html"), judge = () => command("validate", pack, "--port", port, "--html", page);
  const good = judge();
  assert.strictEqual(good.status, 0, good.stdout + good.stderr);
  assert(fs.readFileSync(page, "utf8").includes("</html>"));
  fs.rmSync(page);
  const broken = fs.readdirSync(port, {recursive: true}).find(name => /out\.colour\.npy$/.test(name)), bytes = fs.readFileSync(path.join(port, broken));
  bytes[bytes.length - 3] ^= 0x40;
  fs.writeFileSync(path.join(port, broken), bytes);
  const bad = judge();
  assert.strictEqual(bad.status, 1, bad.stdout + bad.stderr);
  assert.match(bad.stdout, /^FAIL/m);
  const missing = command("validate", path.join(port, "nowhere"), "--port", port);
  assert.deepStrictEqual([missing.status, missing.stdout], [4, ""]);
  assert.match(missing.stderr, /^rainref: .*there is no such folder\n$/);
  assert.strictEqual(command("nonsense").status, 2);
  assert.strictEqual(command("validate", "--prot", "x").status, 2);
} finally {
  fs.rmSync(port, {recursive: true});
}
console.log(`npm: the package gives the native lines of ${rainref.effects.length} effects, PASS and FAIL`);
