// What a visitor's folders are: a pack, the dump of a port, or its shaders. All of a folder is read and checked before the page takes it over.
import {isOutput, jsonOf} from "./files.js";

const shown = value => value === undefined ? "nothing" : JSON.stringify(value).slice(0, 60);
/// Throws an Error with file, key, and what was expected and found.
function expect(isSo, place, what, found) {
  if (!isSo) throw new Error(`${place}: expected ${what}, found ${shown(found)}`);
}
const isObject = value => typeof value === "object" && value !== null && !Array.isArray(value);
const isName = value => typeof value === "string" && value !== "";

/// "pack", "shaders" or "port".
export const kindOf = ({files}) => files.has("bindings.json") ? "shaders" : files.has("manifest.json") && !files.has("port.json") ? "pack" : "port";

/// A pack as packs/index.json has them, with its folder, and `own`, by which a link knows it again: the beginning of the manifest's SHA-256.
/// The manifest names the hash of each file. "" where the browser has no hashes, which is without HTTPS.
export async function packOf(folder) {
  const at = `${folder.name}/manifest.json`, manifest = await jsonOf(folder, "manifest.json");
  expect(isObject(manifest), at, "an object", manifest);
  const {format, effect, variant, scene, passes, cases} = manifest;
  expect(format === "rainref.pack", `${at}: format`, '"rainref.pack"', format);
  expect(isName(effect), `${at}: effect`, "a name", effect);
  for (const [key, value] of Object.entries({variant, scene})) expect(typeof value === "string", `${at}: ${key}`, "a text", value);
  for (const [key, value] of Object.entries({passes, cases})) expect(Array.isArray(value) && value.length > 0, `${at}: ${key}`, "a list that is not empty", value);
  passes.forEach((pass, k) => {
    expect(isObject(pass), `${at}: passes[${k}]`, "an object", pass);
    expect(isName(pass.name), `${at}: passes[${k}].name`, "a name", pass.name);
    for (const key of ["sentence", "formula"]) expect(typeof pass[key] === "string", `${at}: passes[${k}].${key}`, "a text", pass[key]);
  });
  cases.forEach((oneCase, k) => {
    expect(isObject(oneCase), `${at}: cases[${k}]`, "an object", oneCase);
    expect(isName(oneCase.id), `${at}: cases[${k}].id`, "a name", oneCase.id);
    expect(passes.some(pass => pass.name === oneCase.pass), `${at}: cases[${k}].pass`, `one of the passes ${passes.map(pass => pass.name).join(", ")}`, oneCase.pass);
  });
  const digest = await crypto.subtle?.digest("SHA-256", await folder.files.get("manifest.json").arrayBuffer());
  const own = digest ? Array.from(new Uint8Array(digest, 0, 8), byte => byte.toString(16).padStart(2, "0")).join("") : "";
  const about = passes.map(({name, sentence, formula}) => ({name, sentence, formula, cases: cases.filter(c => c.pass === name).length}));
  return {id: `own:${folder.name}`, name: folder.name, effect, variant, scene, passes: about, folder, own};
}

const profiles = [["webgpu", /webgpu/i], ["vulkan", /vulkan/i], ["d3d", /direct3d|d3d|directx/i], ["metal", /metal/i], ["cuda", /cuda/i],
  ["webgl", /webgl/i], ["opencl", /opencl/i], ["gles", /opengl ?es|gles/i], ["opengl", /opengl/i]];

/// A port's folder: {name, files, effects, profile}: the names before its passes, and the profile of the API in its port.json; null: it names none.
export async function portOf(folder) {
  const paths = [...folder.files.keys()], port = folder.files.has("port.json") ? await jsonOf(folder, "port.json") : {};
  expect(isObject(port), `${folder.name}/port.json`, "an object", port);
  if (!paths.some(isOutput)) throw new Error(`${folder.name}: expected folders such as puddle.raindrops/0011.0 with the port's outputs (out.*), found none.${likenessOf(paths)}`);
  return {...folder, effects: new Set(paths.map(path => /^([^/]+)\.[^/.]+\//.exec(path)?.[1]).filter(name => name)),
          profile: profiles.find(([, word]) => word.test(port.api ?? ""))?.[0] ?? null};
}
/// What looks like a port's folder, above or below the one that was given.
function likenessOf(paths) {
  const inner = paths.map(path => /^(.+?)\/([^/]+\.[^/]+\/\d.*)$/.exec(path)).find(found => found && isOutput(found[2]))?.[1];
  if (inner) return ` It holds ${inner}/, which looks like it: choose that.`;
  return paths.some(path => isOutput(`effect.pass/${path}`)) ? " It looks like the folder of one pass: choose the folder around it." : "";
}
