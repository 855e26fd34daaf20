// node census.mjs [--module rainref_module.js] [--packs FOLDER] > FILE: the census of this machine's GPU by Dawn (npm package webgpu). In the
// folder that scripts/web builds, the module and the packs are where it looks. VK_ICD_FILENAMES chooses a Vulkan driver.
import fs from "node:fs";
import {createRequire} from "node:module";
import path from "node:path";
import {fileURLToPath} from "node:url";
import {create, globals} from "webgpu";
import {checkCensus} from "./census/check.js";
import {judgePack} from "./census/judge.js";
import {filesOfTar, readerOf} from "./census/tar.js";
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

/// Packs as folders, as tests/packs has them, or as the files NAME.tar.gz of the site.
async function packsIn(folder, reader) {
  const packs = [];
  for (const name of fs.readdirSync(folder).sort()) {
    const file = path.join(folder, name), isArchive = name.endsWith(".tar.gz");
    if (isArchive) packs.push({name: name.slice(0, -7), read: readerOf(await filesOfTar(reader(folder)(name)), file)});
    else if (fs.existsSync(path.join(file, "manifest.json"))) packs.push({name, read: reader(file)});
  }
  if (packs.length === 0) throw new Error(`--packs: no pack in ${folder}: expected folders with a manifest.json, or NAME.tar.gz`);
  return packs;
}

async function main() {
  const {modulePath, packFolder} = optionsOf(process.argv.slice(2));
  const module = await require(modulePath)();
  const reader = folder => file => new Uint8Array(fs.readFileSync(path.join(folder, file)));
  const packs = await packsIn(packFolder, reader);
  const dawn = JSON.parse(fs.readFileSync(path.join(path.dirname(require.resolve("webgpu")), "package.json"))).version;
  const census = await takeCensus({
    gpu, packs, readPort: reader(here),
    judge: (manifest, pack, port) => judgePack(module, manifest, pack, port),
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
