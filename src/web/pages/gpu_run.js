// Runs passes of a pack on this browser's GPU by the ports' own runner, and keeps the files of a port's folder.
import {bytesOf, jsonOf} from "./files.js";
import {filesOf, requestDevice, runCase} from "./ports/port.js";

let held = null;
/// {device, name}, requested once, and again after the device was lost.
async function deviceOf(gpu) {
  held ??= requestDevice(gpu).then(made => {
    made.device.lost.then(() => { held = null; });
    return made;
  });
  held.catch(() => { held = null; });
  return held;
}

/// shaders: Map from a pass's name to [{name, text}]. progress(done, of) after each case; signal: an AbortSignal. Returns {name, files,
/// device}. For an invalid shader, throws runCase's error with `pass` added.
export async function runPasses(gpu, pack, shaders, {progress, signal}) {
  const manifest = await jsonOf(pack, "manifest.json"), {device, name} = await deviceOf(gpu), files = new Map();
  const cases = manifest.cases.filter(c => shaders.has(c.pass));
  let lost = null;
  device.lost.then(({message}) => { lost = message || "it gives no reason"; });
  for (const [done, oneCase] of cases.entries()) {
    signal.throwIfAborted();
    const inputs = {};
    for (const file of filesOf(oneCase)) inputs[file] = await bytesOf(pack, file);
    try {
      for (const {file, bytes} of await runCase(device, manifest, oneCase, inputs, shaders.get(oneCase.pass))) files.set(file, new Blob([bytes]));
    } catch (error) {
      throw Object.assign(new Error(lost === null ? error.message : `${oneCase.id}: the GPU was lost: ${lost}`), {pass: oneCase.pass});
    }
    progress(done + 1, cases.length);
  }
  files.set("port.json", new Blob([JSON.stringify({api: "WebGPU", device: name}) + "\n"]));
  return {name: "this page", files, device: name};
}
