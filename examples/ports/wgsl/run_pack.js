// Runs the ports of a pack's passes, wherever the files come from and go to.
import {filesOf, requestDevice, runCase} from "./port.js";

/// The shaders of a program: [{name, text}], by the names in a folder's programs.json; readPort(path) gives bytes of a file of this folder.
export async function shaderOf(names, folder, readPort) {
  const decoder = new TextDecoder();
  return Promise.all(names.map(async name => ({name, text: decoder.decode(await readPort(name.startsWith("../") ? name.slice(3) : `${folder}/${name}`))})));
}

/// gpu: a GPU, such as navigator.gpu. readPack(path), readPort(path): bytes of a file of the pack, and of this folder.
/// write(path, bytes) takes what the port's folder holds, port.json last. passes: names, or null for all. shaders: the folder, as readPort
/// takes it, with programs.json; null for the one with the effect's name. Gives {count, device}: the cases that were run, and the
/// device's name. A pass without a program is left out.
export async function runPack(gpu, {readPack, readPort, write, passes = null, shaders = null}) {
  const json = bytes => JSON.parse(new TextDecoder().decode(bytes));
  const manifest = json(await readPack("manifest.json"));
  const folder = shaders ?? manifest.effect;
  const {programs} = json(await readPort(`${folder}/programs.json`));
  const {device, name} = await requestDevice(gpu);
  let count = 0;
  try {
    for (const oneCase of manifest.cases) {
      const names = programs[manifest.passes.find(pass => pass.name === oneCase.pass).formula];
      if (!names || (passes && !passes.includes(oneCase.pass))) continue;
      const files = {}, shader = await shaderOf(names, folder, readPort);
      for (const file of filesOf(oneCase)) files[file] = await readPack(file);
      for (const {file, bytes} of await runCase(device, manifest, oneCase, files, shader)) await write(file, bytes);
      ++count;
    }
  } finally {
    device.destroy();  // who runs pack after pack would hold one for each
  }
  await write("port.json", new TextEncoder().encode(JSON.stringify({api: "WebGPU", device: name}) + "\n"));
  return {count, device: name};
}
