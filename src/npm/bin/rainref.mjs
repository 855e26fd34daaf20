#!/usr/bin/env node
// The command of the npm package: verdicts, hashes and descriptions without a compiler. The native program does more.
import fs from "node:fs";
import path from "node:path";
import {fileURLToPath} from "node:url";
import {parseArgs} from "node:util";
import {loadRainref, RainrefError} from "../index.mjs";

const usage = `rainref validate PACK --port DIR [--profile P] [--only PASS,...] [--partial] [--strict] [--spirv DIR] [--html F] [--json F] [--junit F]
rainref hash SCENE [--preset NAME,...] [--set KEY=VALUE]... [--frames N]
rainref describe EFFECT
rainref --version`;
const scenes = fileURLToPath(new URL("../scenes/", import.meta.url));

/// A wrong command line: exit code 2.
class UsageError extends Error {}

function folderOf(at) {
  if (!fs.statSync(at, {throwIfNoEntry: false})?.isDirectory()) throw new RainrefError(`${at}: there is no such folder`, 4);
  const files = new Map();
  for (const name of fs.readdirSync(at, {recursive: true})) {
    const file = path.join(at, name);
    if (fs.statSync(file).isFile()) files.set(name.split(path.sep).join("/"), fs.readFileSync(file));
  }
  return files;
}

/// A scene's own file, or a bundled one such as "puddle/default.toml".
function sceneOf(name) {
  const bundled = path.join(scenes, name.replace(/^scenes\//, "").replace(/(\.toml)?$/, ".toml"));
  const file = [name, bundled].find(place => fs.existsSync(place));
  if (!file) throw new RainrefError(`${name}: no such scene`, 4);
  return {toml: fs.readFileSync(file, "utf8"), folder: path.dirname(file)};
}

async function validate([pack, ...more], values) {
  if (!pack || more.length || !values.port) throw new UsageError("validate: expected PACK and --port DIR");
  const rainref = await loadRainref();
  const shown = process.stderr.isTTY;
  const judged = rainref.judge(folderOf(pack), folderOf(values.port), {
    profile: values.profile, partial: values.partial, strict: values.strict, passes: values.only?.split(",") ?? [],
    spirv: values.spirv ? folderOf(values.spirv) : null, names: {pack: path.basename(path.resolve(pack)), port: path.basename(path.resolve(values.port))},
    onProgress: (done, of) => { if (shown) process.stderr.write(`\rjudging ${done} of ${of}${done === of ? "\n" : ""}`); },
  });
  process.stdout.write(judged.text);
  for (const kind of ["html", "json", "junit"]) if (values[kind]) fs.writeFileSync(values[kind], judged[kind]);
  return JSON.parse(judged.json).exit_code;
}

async function hash([scene, ...more], values) {
  if (!scene || more.length) throw new UsageError("hash: expected one SCENE");
  const {toml, folder} = sceneOf(scene), rainref = await loadRainref();
  // The files beside a scene that it names.
  const files = new Map([...toml.matchAll(/"([^"\n]+\.\w+)"/g)].map(([, name]) => name).filter(name => fs.existsSync(path.join(folder, name)))
    .map(name => [name, fs.readFileSync(path.join(folder, name))]));
  const set = [...(values.preset ? [`preset=${values.preset}`] : []), ...(values.set ?? []), ...(values.frames ? [`run.frames=${values.frames}`] : [])];
  const simulation = rainref.open(toml, {set, files, name: path.basename(scene)});
  for (let frame = simulation.info.frames; frame > 0; --frame) process.stdout.write(simulation.nextFrameHashes().join("\n") + "\n");
  simulation.close();
  return 0;
}

async function describe([effect, ...more]) {
  if (!effect || more.length) throw new UsageError("describe: expected one EFFECT");
  process.stdout.write(JSON.stringify((await loadRainref({judge: false})).describe(effect), null, 2) + "\n");
  return 0;
}

const texts = Object.fromEntries(["port", "profile", "only", "spirv", "html", "json", "junit", "frames", "preset"].map(name => [name, {type: "string"}]));
const flags = Object.fromEntries(["partial", "strict", "version", "help"].map(name => [name, {type: "boolean"}]));
try {
  let parsed;
  try {
    parsed = parseArgs({allowPositionals: true, options: {...texts, ...flags, set: {type: "string", multiple: true}}});
  } catch (error) {
    throw new UsageError(error.message);
  }
  const {values, positionals: [verb, ...rest]} = parsed, verbs = {validate, hash, describe};
  if (values.version) console.log(`rainref ${(await loadRainref({judge: false})).version} (WebAssembly)`);
  else if (values.help) console.log(usage);
  else if (!Object.hasOwn(verbs, verb ?? "")) throw new UsageError(`expected one of ${Object.keys(verbs).join(", ")}, found '${verb ?? ""}'\n${usage}`);
  else process.exitCode = await verbs[verb](rest, values);
} catch (error) {
  if (!(error instanceof RainrefError || error instanceof UsageError)) throw error;
  process.stderr.write(`rainref: ${error.message}\n`);
  process.exitCode = error.code ?? 2;
}
