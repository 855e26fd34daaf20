// The WebAssembly modules in Node, from this folder.
import fs from "node:fs";
import {createRequire} from "node:module";

/// `name`: rainref_module (all of the library) or rainref_simulator (without the judge).
export async function load(name) {
  const create = createRequire(import.meta.url)(`./${name}.cjs`);
  return create({wasmBinary: fs.readFileSync(new URL(`${name}.wasm`, import.meta.url))});
}
