// node run.mjs PACK OUT [PASS,...]: runs the ports of the pack's passes by Dawn (npm package webgpu) and writes their outputs to OUT.
// VK_ICD_FILENAMES chooses a Vulkan driver. Exit code 3: something could not be run.
import fs from "node:fs";
import path from "node:path";
import {create, globals} from "webgpu";
import {filesOf, requestDevice, runCase} from "./port.js";

Object.assign(globalThis, globals);
const gpu = create([]);  // for as long as the program runs: Dawn ends with it
const here = import.meta.dirname ?? path.dirname(new URL(import.meta.url).pathname);

/// Of each formula, the names of its WGSL files and their texts, by the effect's programs.json.
function shadersOf(effect) {
  const folder = path.join(here, effect), {programs} = JSON.parse(fs.readFileSync(path.join(folder, "programs.json"), "utf8"));
  const read = name => ({name, text: fs.readFileSync(path.join(folder, name), "utf8")});
  return Object.fromEntries(Object.entries(programs).map(([formula, names]) => [formula, names.map(read)]));
}

async function main() {
  const [pack, out, passes] = process.argv.slice(2);
  if (!out) throw new Error("usage: node run.mjs PACK OUT [PASS,...]");
  const manifest = JSON.parse(fs.readFileSync(path.join(pack, "manifest.json"), "utf8"));
  const shaders = shadersOf(manifest.effect), {device, name} = await requestDevice(gpu);
  let count = 0;
  for (const oneCase of manifest.cases) {
    const shader = shaders[manifest.passes.find(pass => pass.name === oneCase.pass).formula];
    if (!shader || (passes && !passes.split(",").includes(oneCase.pass))) continue;
    const files = Object.fromEntries(filesOf(oneCase).map(file => [file, new Uint8Array(fs.readFileSync(path.join(pack, file)))]));
    for (const {file, bytes} of await runCase(device, manifest, oneCase, files, shader)) {
      fs.mkdirSync(path.dirname(path.join(out, file)), {recursive: true});
      fs.writeFileSync(path.join(out, file), bytes);
    }
    ++count;
  }
  fs.mkdirSync(out, {recursive: true});
  fs.writeFileSync(path.join(out, "port.json"), JSON.stringify({api: "WebGPU", device: name}) + "\n");
  console.log(`${count} cases on ${name}`);
}

// Dawn keeps threads, so the program ends itself.
main().then(() => process.exit(0), error => {
  console.error(error.message);
  process.exit(3);
});
