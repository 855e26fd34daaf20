// The WebAssembly modules in Node, from this folder.
import fs from "node:fs";
import {createRequire} from "node:module";

/// `name`: rainref_module (all of the library) or rainref_simulator (without the judge).
export async function load(name) {
  const create = createRequire(import.meta.url)(`./${name}.cjs`), presets = new URL("presets/", import.meta.url);
  const module = await create({wasmBinary: fs.readFileSync(new URL(`${name}.wasm`, import.meta.url))});
  // Where the library looks for them.
  module.FS.mkdirTree("/share/rainref/presets");
  for (const file of fs.readdirSync(presets)) module.FS.writeFile(`/share/rainref/presets/${file}`, fs.readFileSync(new URL(file, presets)));
  return module;
}
