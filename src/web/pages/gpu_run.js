// Runs passes of a pack on this browser's GPU by the ports' own runner, and keeps the files of a port's folder.
import {Cancelled, until} from "./cancelled.js";
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

/// shaders: Map from a pass's name to [{name, text}]. progress(done, of) before and after each case; signal: an AbortSignal. Returns {name,
/// files, device}. For an invalid shader, throws runCase's error with `pass` added; at the signal Cancelled, with `keepsGpu` if a case has run for long, and may go on.
export async function runPasses(gpu, pack, shaders, {progress, signal}) {
  const manifest = await until(signal, jsonOf(pack, "manifest.json")), {device, name} = await until(signal, deviceOf(gpu)), files = new Map();
  const cases = manifest.cases.filter(c => shaders.has(c.pass));
  let lost = null;
  const ended = device.lost.then(({message}) => { lost = message || "it gives no reason"; });
  for (const [done, oneCase] of cases.entries()) {
    progress(done, cases.length);
    const began = performance.now();
    const inputs = Object.create(null);  // the keys are a pack's
    for (const file of filesOf(oneCase)) inputs[file] = await until(signal, bytesOf(pack, file));
    try {
      const outputs = await until(signal, runCase(device, manifest, oneCase, inputs, shaders.get(oneCase.pass)));
      for (const {file, bytes} of outputs) files.set(file, new Blob([bytes]));
    } catch (error) {
      if (error instanceof Cancelled) {
        held = null;  // the next run asks for a device of its own
        device.destroy();
        throw Object.assign(error, {keepsGpu: performance.now() - began > 2000});
      }
      await Promise.race([ended, new Promise(next => setTimeout(next, 100))]);  // a lost device may say so after its call failed
      throw lost === null ? Object.assign(error, {pass: oneCase.pass}) : new Error(`${oneCase.id}: the GPU was lost: ${lost}. The next run asks for it again.`);
    }
    progress(done + 1, cases.length);
  }
  files.set("port.json", new Blob([JSON.stringify({api: "WebGPU", device: name}) + "\n"]));
  return {name: "this page", files, device: name};
}
