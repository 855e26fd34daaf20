// The WebAssembly modules in pages and workers, fetched from the folder of this file. Each name stands in a URL of its own, so that bundlers
// find the files.
const parts = {
  rainref_module: [() => import("./rainref_module.mjs"), new URL("rainref_module.wasm", import.meta.url)],
  rainref_simulator: [() => import("./rainref_simulator.mjs"), new URL("rainref_simulator.wasm", import.meta.url)],
};

/// `name`: rainref_module (all of the library) or rainref_simulator (without the judge).
export async function load(name) {
  const [script, wasm] = parts[name];
  const {default: create} = await script();
  return create({locateFile: () => wasm.href});
}
