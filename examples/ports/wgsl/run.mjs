// node run.mjs PACK OUT [PASS,...] [--shaders FOLDER]: runs the ports of the pack's passes by Dawn (npm package webgpu) and writes their
// outputs to OUT. FOLDER holds programs.json and its shaders; without it the folder here with the effect's name is taken.
// VK_ICD_FILENAMES chooses a Vulkan driver. Exit code 3: something could not be run.
import fs from "node:fs";
import path from "node:path";
import {parseArgs} from "node:util";
import {create, globals} from "webgpu";
import {runPack} from "./run_pack.js";

Object.assign(globalThis, globals);
const gpu = create([]);  // for as long as the program runs: Dawn ends with it

async function main() {
  const {positionals: [pack, out, passes], values: {shaders}} = parseArgs({allowPositionals: true, options: {shaders: {type: "string"}}});
  if (!out) throw new Error("usage: node run.mjs PACK OUT [PASS,...] [--shaders FOLDER]");
  const read = folder => name => new Uint8Array(fs.readFileSync(path.resolve(folder, name)));
  const write = (name, bytes) => {
    fs.mkdirSync(path.dirname(path.join(out, name)), {recursive: true});
    fs.writeFileSync(path.join(out, name), bytes);
  };
  const here = path.dirname(new URL(import.meta.url).pathname);
  const {count, device} = await runPack(gpu, {readPack: read(pack), readPort: read(here), write, passes: passes?.split(","),
                                              shaders: shaders && path.resolve(shaders)});
  console.log(`${count} cases on ${device}`);
}

// Dawn keeps threads, so the program ends itself.
main().then(() => process.exit(0), error => {
  console.error(error.message);
  process.exit(3);
});
