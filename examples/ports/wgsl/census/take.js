// A census of one device: its habits, and what the judge says of every port on every small pack.
import {levelsOf, isRecords} from "../pack.js";
import {filesOf, requestDevice} from "../port.js";
import {runPack} from "../run_pack.js";
import {schema} from "./check.js";
import {probes, runProbes} from "./probes.js";
import {toolsOf} from "./tools.js";

/// Features of WebGPU that bear on how a port is written or on what it may give.
const telling = ["float32-filterable", "float32-blendable", "shader-f16", "texture-formats-tier1", "rg11b10ufloat-renderable", "subgroups", "timestamp-query"];

/// All files of a pack that its manifest names.
export function filesOfPack(manifest) {
  const of = buffer => isRecords(buffer) ? [buffer.file] : levelsOf(buffer).map(level => level.file);
  return [...new Set(manifest.cases.flatMap(c => [...filesOf(c), ...c.outputs.flatMap(of)]))];
}

/// Runs all ports of a pack, each on a device of its own: what stops one is its reason, and the others run without it. Gives {port, passes,
/// stopped: [{pass, status, reason}]}: passes are those that ran.
async function runPorts(gpu, manifest, pack, readPort, cancel) {
  const port = {}, passes = [], stopped = [], {programs} = JSON.parse(new TextDecoder().decode(await readPort(`${manifest.effect}/programs.json`)));
  const readPack = path => (cancel(), pack[path]);
  for (const {name: pass} of manifest.passes.filter(({formula}) => programs[formula])) {
    const given = {};
    try {
      await runPack(gpu, {readPack, readPort, write: (path, bytes) => { given[path] = bytes; }, passes: [pass]});
      Object.assign(port, given);
      passes.push(pass);
    } catch (error) {
      cancel();
      stopped.push({pass, status: "NOT RUN", reason: error.message.split("\n")[0].slice(0, 300)});
    }
  }
  return {port, passes, stopped};
}

/// The verdicts of one pack: counts of each, and what is neither PASS nor DATA.
function packEntry(name, passes) {
  const entry = {pack: name, verdicts: {}, others: []};
  for (const {pass, status, reason, elements, outside} of passes) {
    entry.verdicts[status] = (entry.verdicts[status] ?? 0) + 1;
    if (status !== "PASS" && status !== "DATA") entry.others.push({pass, status, reason, ...(elements === undefined ? {} : {elements, outside})});
  }
  return entry;
}

/// Takes a census. gpu: a GPU, such as navigator.gpu. packs: [{name, read(path)}]. readPort(path): bytes of a file of this folder's parent.
/// judge({pack, port, passes}): judgePack's, or a promise of that. rainref: {version, golden_generation}. by: {program, user_agent}.
/// step({done, of, words}) is called as work goes on. signal: an AbortSignal that ends it.
export async function takeCensus({gpu, packs, readPort, judge, rainref, by, step = () => {}, signal = null}) {
  const cancel = () => signal?.throwIfAborted(), adapter = await gpu?.requestAdapter();
  if (!adapter) throw new Error("no WebGPU adapter");
  const {info} = adapter, of = probes.length + packs.length;
  let done = 0;
  const next = words => {
    cancel();
    step({done: done++, of, words});
  };
  const {device} = await requestDevice(gpu);
  let habits;
  try {
    habits = await runProbes(toolsOf(device), next);
  } finally {
    device.destroy();
  }
  const ports = [];
  for (const {name, read} of packs.toSorted((a, b) => a.name < b.name ? -1 : 1)) {
    next(`ports of ${name}`);
    const manifestBytes = await read("manifest.json"), manifest = JSON.parse(new TextDecoder().decode(manifestBytes)), pack = {"manifest.json": manifestBytes};
    for (const file of filesOfPack(manifest)) {
      cancel();
      pack[file] = await read(file);
    }
    const {port, passes, stopped} = await runPorts(gpu, manifest, pack, readPort, cancel);
    cancel();
    ports.push(packEntry(name, [...(passes.length > 0 ? await judge({pack, port, passes}) : []), ...stopped]));
  }
  step({done: of, of, words: "done"});
  return {
    schema, date: new Date().toISOString().slice(0, 10), rainref, by,
    device: {
      vendor: info.vendor ?? "", architecture: info.architecture ?? "", device: info.device ?? "", description: info.description ?? "",
      fallback: Boolean(info.isFallbackAdapter ?? adapter.isFallbackAdapter),
      features: telling.filter(feature => adapter.features.has(feature)),
    },
    habits, profile: "webgpu", ports,
  };
}

/// The sums of all packs: {PASS: 80, WARN: 1}.
export function totals(census) {
  const sums = {};
  for (const {verdicts} of census.ports) for (const [status, count] of Object.entries(verdicts)) sums[status] = (sums[status] ?? 0) + count;
  return sums;
}

/// JSON whose short objects and lists stand on one line, and whose lists of texts fill lines.
export function censusText(value, indent = "") {
  const line = JSON.stringify(value), end = indent === "" ? "\n" : "", inner = indent + " ";
  if (line.length <= 130 || value === null || typeof value !== "object") return line + end;
  const isList = Array.isArray(value), [open, close] = isList ? "[]" : "{}";
  if (isList && value.every(item => typeof item === "string")) return line.replace(/(.{100,}?",)/g, `$1\n${inner}`);
  const parts = isList ? value.map(item => censusText(item, inner)) : Object.entries(value).map(([key, item]) => `${JSON.stringify(key)}: ${censusText(item, inner)}`);
  return `${open}\n${parts.map(part => inner + part).join(",\n")}\n${indent}${close}${end}`;
}
