// node scene_values_test.mjs RAINREF_MODULE.js SCENES: what the live page saves of each effect's scenes of both variants opens again, with
// the same value of every key; and what people type becomes TOML.
import assert from "node:assert/strict";
import fs from "node:fs";
import {createRequire} from "node:module";
import path from "node:path";
import {shellWord, shownValue, tomlOf, tomlValue, valuesOf} from "../../src/web/pages/scene_values.js";

const [modulePath, folder] = process.argv.slice(2);
const m = await createRequire(import.meta.url)(path.resolve(modulePath))();
const all = fs.readdirSync(folder, {recursive: true}).filter(name => fs.statSync(path.join(folder, name)).isFile());
for (const name of all) {
  m.FS.mkdirTree(path.dirname(`/scenes/${name}`));
  m.FS.writeFile(`/scenes/${name}`, fs.readFileSync(path.join(folder, name)));
}
const given = (f, ...args) => {
  const to = m._malloc(4), result = f(...args, to);
  assert.equal(result, 0, m.UTF8ToString(m._rr_error()));
  return m.getValue(to, "i32");
};
/// Every key with its value, of a text as the file `name`.
function values(text, name) {
  const options = m._malloc(20), info = m._malloc(32);
  [20, m.stringToNewUTF8(`/scenes/${name}`), 0, 0, 1].forEach((value, k) => m.setValue(options + 4 * k, value, "i32"));
  const simulation = given(m._rr_open, m.stringToNewUTF8(text), options);
  m.setValue(info, 32, "i32");
  assert.equal(m._rr_get_info(simulation, info), 0, m.UTF8ToString(m._rr_error()));
  const json = m.UTF8ToString(m.getValue(info + 28, "i32"));
  m._rr_close(simulation);
  assert.deepEqual([...valuesOf(json).keys()], Object.keys(JSON.parse(json)));
  return valuesOf(json);
}

let scenes = 0;
const describe = new Map();
for (const name of all.filter(n => /\/(default|as_published|drive)\.toml$/.test(n))) {
  // Smaller, so that it opens at once; whether it can be said does not hang on that.
  const text = fs.readFileSync(path.join(folder, name), "utf8").replace(/^size = \[1280, 720\]/m, "size = [64, 36]"), before = values(text, name);
  const effect = JSON.parse(before.get("effect"));
  if (!describe.has(effect)) describe.set(effect, JSON.parse(m.UTF8ToString(given(m._rr_describe, m.stringToNewUTF8(effect)))));
  const after = values(tomlOf(before, describe.get(effect)), name);
  // A file is named as it was, and found from the same folder.
  assert.deepEqual(after, before, name);
  ++scenes;
}
assert(scenes > 10);

assert.deepEqual(valuesOf('{"a.b": "x, \\"y\\": }", "c": [1.0,2e-06], "d": 9223372036854775807, "e": true}'),
                 new Map([["a.b", '"x, \\"y\\": }"'], ["c", "[1.0,2e-06]"], ["d", "9223372036854775807"], ["e", "true"]]));
assert.deepEqual([tomlValue("real3", "1, 2,3"), tomlValue("text", 'a"b'), tomlValue("integer", " 7 ")], ["[1, 2,3]", '"a\\"b"', "7"]);
assert.deepEqual([shownValue("real3", "[1.0,2.5,-3.0]"), shownValue("choice", '"rne"'), shownValue("real", "1e-06")], ["1, 2.5, -3", "rne", "1e-06"]);
assert.deepEqual([shellWord("rain.rate=30"), shellWord("a=[1, 2]"), shellWord("it's")], ["rain.rate=30", "'a=[1, 2]'", "'it'\\''s'"]);
console.log(`scene values: ${scenes} scenes saved and opened again`);
