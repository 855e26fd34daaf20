// node scene_index.mjs RAINREF_MODULE.js SCENES PRESETS [PICTURES]: what a page must know of the scenes and presets that come with rainref, as
// scenes/index.json. A scene that names files is opened with the library as the page does: where it is refused, it is listed with the reason.
import fs from "node:fs";
import {createRequire} from "node:module";
import path from "node:path";

const [modulePath, folder, presetFolder, pictures = ""] = process.argv.slice(2);
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
  // The comment at the beginning, up to where it gives commands.
  const comment = /^(?:#.*\n)*/.exec(text)[0].split("\n").map(line => line.replace(/^# ?/, ""));
  const commands = comment.findIndex(line => line.startsWith("  ")), words = comment.slice(0, commands < 0 ? undefined : commands).join(" ");
  const sentence = words.match(/.*?[.:](?= |$)/)?.[0].replace(/:$/, ".") ?? words.trim();
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
    path: name, effect: value("effect"), variant: value("variant"), sentence, files, keys: keys.slice(0, 4),
    ...(fs.existsSync(path.join(pictures, picture)) ? {picture: `gallery/${picture}`} : {}), ...(error === null ? {} : {error}),
  };
});

// A preset that names a picture is left out for that effect: the library in a page does not read those.
const presets = fs.readdirSync(presetFolder).filter(name => name.endsWith(".toml")).map(file => {
  const preset = {name: file.replace(/\.toml$/, ""), keys: {}};
  let effect = null;
  for (const line of fs.readFileSync(path.join(presetFolder, file), "utf8").split("\n")) {
    const [, table] = /^\[(\w+)\]$/.exec(line) ?? [], [, key, value] = /^([\w.]+) = (.+)$/.exec(line) ?? [];
    if (table) preset.keys[effect = table] = [];
    else if (key && effect) preset.keys[effect].push([key, value]);
    else if (key) preset[key] = JSON.parse(value);
  }
  const needsFile = keys => keys.some(([, value]) => /^"[^"]*\.\w+"$/.test(value));
  for (const [effect, keys] of Object.entries(preset.keys)) if (needsFile(keys)) delete preset.keys[effect];
  return preset;
});
const place = ({kind, order, name}) => `${kind === "light"} ${String(order).padStart(9, "0")} ${name}`;
presets.sort((a, b) => place(a) < place(b) ? -1 : 1);
process.stdout.write(JSON.stringify({scenes, presets: presets.map(({order, ...shown}) => shown)}, null, 1) + "\n");
