// node scene_index.mjs RAINREF_MODULE.js LIST.json ROOT: what a page must know of the scenes and presets that come with rainref, as
// scenes/index.json. LIST.json: what the native program prints as `rainref list --json`; ROOT: the folder of the sources, as it knows them.
// A scene that names files is opened with the library as the page does: where it is refused, it is listed with the reason.
import fs from "node:fs";
import {createRequire} from "node:module";
import path from "node:path";

const [modulePath, list, root] = process.argv.slice(2), folder = "scenes", pictures = "docs/gallery";
const known = JSON.parse(fs.readFileSync(list)), sentences = new Map(known.scenes.map((name, k) => [name, known.scene_sentences[k]]));
const m = await createRequire(import.meta.url)(path.resolve(modulePath))();
const all = fs.readdirSync(folder, {recursive: true}).filter(name => fs.statSync(path.join(folder, name)).isFile()).sort();
for (const name of all) {
  const to = path.join("/scenes", name);
  m.FS.mkdirTree(path.dirname(to));
  m.FS.writeFile(to, fs.readFileSync(path.join(folder, name)));
}

/// Why the library refuses the scene; null where it does not.
function refusal(name, text) {
  const set = m._malloc(4), options = m._malloc(20), out = m._malloc(4);
  m.setValue(set, m.stringToNewUTF8("run.size=[64, 36]"), "i32");
  [20, m.stringToNewUTF8(`/scenes/${name}`), set, 1, 1].forEach((value, k) => m.setValue(options + 4 * k, value, "i32"));
  const result = m._rr_open(m.stringToNewUTF8(text), options, out);
  if (result !== 0) return m.UTF8ToString(m._rr_error()).replaceAll("/scenes/", "");
  m._rr_close(m.getValue(out, "i32"));
  return null;
}

const scenes = all.filter(name => name.endsWith(".toml")).map(name => {
  const text = fs.readFileSync(path.join(folder, name), "utf8"), value = key => new RegExp(`^${key} *= *"([^"]*)"`, "m").exec(text)?.[1];
  const files = all.filter(other => !other.endsWith(".toml") && text.includes(path.relative(path.dirname(name), other)));
  // Of the keys that it sets, those that make it what it is.
  let section = "";
  const keys = [];
  for (const line of text.split("\n")) {
    section = /^\[(\w+)\]/.exec(line)?.[1] ?? section;
    const set = /^(\w+) *= *([^#\n]*)/.exec(line);
    if (set && !["", "run", "camera", "composite", "scene"].includes(section)) keys.push(`${section}.${set[1]} = ${set[2].trim()}`);
  }
  const picture = `${name.replace(/\.toml$/, "").replaceAll("/", "_")}.jpg`, namesFile = /^[^#\n]*= *"[^"\n]*\.\w+"/m.test(text);
  const error = namesFile ? refusal(name, text) : null;
  return {
    path: name, effect: value("effect"), variant: value("variant"), sentence: `${sentences.get(name)}.`, files, keys: keys.slice(0, 4),
    ...(fs.existsSync(path.join(pictures, picture)) ? {picture: `gallery/${picture}`} : {}), ...(error === null ? {} : {error}),
  };
});

// The files that presets name lie in the site as they do in the sources; a command that the page shows names them as from there.
const presets = known.presets.map(preset => {
  const files = new Set();
  const relative = toml => toml.replaceAll(`"${root}/`, () => '"').replace(/"(presets\/[^"]*)"/g, (text, file) => (files.add(file), text));
  const keys = Object.fromEntries(Object.entries(preset.keys).map(([effect, all]) => [effect, all.map(([key, toml]) => [key, relative(toml)])]));
  return {...preset, keys, files: [...files]};
});
process.stdout.write(JSON.stringify({scenes, presets}, null, 1) + "\n");
