// node census.mjs [--module rainref_module.js] [--packs build/release/packs] > FILE: the census of this machine's GPU by Dawn (npm package webgpu). Without
// options the module and the folder packs lie beside this folder. VK_ICD_FILENAMES chooses a Vulkan driver. Exit code 3: there is none.
import fs from "node:fs";
import {createRequire} from "node:module";
import path from "node:path";
import {fileURLToPath} from "node:url";
import {create, globals} from "webgpu";
import {checkCensus} from "./census/check.js";
import {judgePack} from "./census/judge.js";
import {censusText, takeCensus, totals} from "./census/take.js";
import {deviceName} from "./census/words.js";

const here = path.dirname(fileURLToPath(import.meta.url)), require = createRequire(import.meta.url);
Object.assign(globalThis, globals);
const gpu = create([]);  // for as long as the program runs: Dawn ends with it

function optionsOf(args) {
  const options = {"--module": path.join(here, "../rainref_module.js"), "--packs": path.join(here, "../packs")};
  for (let i = 0; i < args.length; i += 2) {
    if (!(args[i] in options) || !args[i + 1]) throw new Error("usage: node census.mjs [--module rainref_module.js] [--packs FOLDER] > FILE");
    options[args[i]] = args[i + 1];
  }
  for (const [option, file] of Object.entries(options)) if (!fs.existsSync(file)) throw new Error(`${option}: no such file: ${file}`);
  return {modulePath: path.resolve(options["--module"]), packFolder: options["--packs"]};
}

async function main() {
  const {modulePath, packFolder} = optionsOf(process.argv.slice(2));
  const module = await require(modulePath)();
  const reader = folder => file => new Uint8Array(fs.readFileSync(path.join(folder, file)));
  const names = fs.readdirSync(packFolder).filter(name => fs.existsSync(path.join(packFolder, name, "manifest.json"))).sort();
  if (names.length === 0) throw new Error(`--packs: no folder in ${packFolder} has a manifest.json`);
  const packs = names.map(name => ({name, read: reader(path.join(packFolder, name))}));
  const dawn = JSON.parse(fs.readFileSync(path.join(path.dirname(require.resolve("webgpu")), "package.json"))).version;
  const census = await takeCensus({
    gpu, packs, readPort: reader(here),
    judge: given => judgePack(module, given),
    rainref: {version: module.UTF8ToString(module._rr_version()), golden_generation: module._rr_golden_generation()},
    by: {program: `Dawn for Node ${dawn}`, user_agent: `node ${process.version} ${process.platform} ${process.arch}`},
    step: ({done, of, words}) => console.error(`${done}/${of} ${words}`),
  });
  checkCensus(census);
  fs.writeSync(1, censusText(census));
  console.error(deviceName(census) + (census.device.fallback ? " (software): " : ": ") + Object.entries(totals(census)).map(([status, count]) => `${count} ${status}`).join(", "));
}

// Dawn keeps threads, so the program ends itself.
main().then(() => process.exit(0), error => {
  console.error(error.message);
  process.exit(3);
});
