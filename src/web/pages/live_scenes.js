// The scenes that the live page offers: scenes/index.json, and their files below scenes.
import {Presets} from "./live_presets.js";
import {element} from "./report_words.js";

async function fetched(path, kind) {
  const answer = await fetch(path.split("/").map(encodeURIComponent).join("/"));
  if (!answer.ok) throw new Error(`${path}: ${answer.status} ${answer.statusText}`);
  return answer[kind]();
}

const bytesOf = async path => ({path, bytes: new Uint8Array(await fetched(path, "arrayBuffer"))});

/// A chosen or dropped scene in the form of LiveRun.open, with the files that it names.
export async function sceneOfFiles(all) {
  const scene = all.find(file => /\.toml$/i.test(file.name));
  if (!scene) throw new Error(`${all.map(f => f.name).join(", ")}: expected a scene (.toml), and files that it names beside it`);
  const files = await Promise.all(all.filter(f => f !== scene).map(async f => ({path: f.name, bytes: new Uint8Array(await f.arrayBuffer())})));
  return {file: scene.name, text: await scene.text(), files};
}

export class SceneList {
  /// [{path, effect, variant, sentence, files, keys, picture?, error?, file?}]. `path`: below scenes; `file`: what commands call it, if not
  /// "scenes/" and the path; `error`: why it cannot run here.
  all = [];
  presets = new Presets();

  async load() { [this.all, this.presets.all] = (({scenes, presets}) => [scenes, presets])(await fetched("scenes/index.json", "json")); }
  entry(path) { return this.all.find(scene => scene.path === path); }

  /// A scene in the form of LiveRun.open, with the files that it names.
  async read(path) {
    const entry = this.entry(path);
    if (!entry) throw new Error(`no scene ${path}; there are ${this.all.map(scene => scene.path).join(", ")}`);
    const files = await Promise.all(entry.files.map(name => bytesOf(`scenes/${name}`)));
    return {path, known: path, file: entry.file ?? `scenes/${path}`, text: await fetched(`scenes/${path}`, "text"), files};
  }

  /// The scene with the files that presets among the keys set name.
  async withPresets(scene, sets) {
    const has = new Set(scene.files.map(({path}) => path)), missing = [...this.presets.filesIn(sets)].filter(path => !has.has(path));
    return {...scene, files: [...scene.files, ...await Promise.all(missing.map(bytesOf))]};
  }

  /// Shows the list by effect; scenes that cannot run here are marked.
  show(select) {
    const groups = new Map();
    for (const {path, effect, error} of this.all) {
      if (!groups.has(effect)) groups.set(effect, element("optgroup", {label: effect.replaceAll("_", " ")}));
      groups.get(effect).append(element("option", {value: path, disabled: Boolean(error)}, error ? `${path} (not here: ${error})` : path));
    }
    select.replaceChildren(element("option", {value: "", hidden: true}, "a scene of yours"), ...groups.values());
  }
}
