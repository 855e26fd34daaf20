// The site's packs, and the example programs of their passes.
import {shaderOf} from "./ports/run_pack.js";
import {folderOfArchive} from "./files.js";

const beside = path => new URL(path, import.meta.url);
async function fetched(path) {
  const answer = await fetch(beside(path));
  if (!answer.ok) throw new Error(`${path}: ${answer.status} ${answer.statusText}`);
  return answer;
}
/// One promise for each key; a failed one is made again.
function kept(make) {
  const made = new Map();
  return key => {
    if (!made.has(key)) made.set(key, make(key).catch(error => { made.delete(key); throw error; }));
    return made.get(key);
  };
}

/// [{name, file, effect, variant, scene, passes: [{name, sentence, formula, cases}]}].
export const packList = kept(async () => (await (await fetched("packs/index.json")).json()).packs);
/// The folder of one of them.
export const packFolder = kept(async pack => folderOfArchive(new File([await (await fetched(`packs/${pack.file}`)).blob()], pack.file)));

/// None for an effect of the visitor's own.
const programsOf = kept(async effect => {
  if (!(await packList()).some(pack => pack.effect === effect)) return {};
  return (await (await fetched(`ports/${effect}/programs.json`)).json()).programs;
});
const portText = kept(async path => new Uint8Array(await (await fetched(`ports/${path}`)).arrayBuffer()));
/// Whether the examples have a program for a formula; not for passes of the host.
export const hasProgram = async (effect, formula) => Object.hasOwn(await programsOf(effect), formula);  // a pack's formula may be "constructor"
/// The example program for a formula: [{name, text}].
export async function exampleOf(effect, formula) {
  if (!await hasProgram(effect, formula)) throw new Error(`${formula}: the examples have no program of it`);
  return shaderOf((await programsOf(effect))[formula], effect, portText);
}
