// What the live page asks of the library, in the worker (engine.js): one simulation at a time, and the cases of a pass for the GPU.
import {caseOf} from "./live_cases.js";

let simulation = 0;

/// What `rainref describe EFFECT --json` prints, of every effect: {effect: object}.
export function describe(library) {
  const effects = {};
  for (let i = 0, pointer; (pointer = library.value("rr_effect_name", i)) !== 0; ++i) {
    const effect = library.text(pointer);
    effects[effect] = JSON.parse(library.text(library.out("rr_describe", effect)));
  }
  return effects;
}

/// Opens the text of a scene in place of the one that was open; that one stays where the new one is refused. `file`: what errors call it,
/// in whose folder the files of `files` ({path: bytes}) lie that it names. `set`: ["key=value"], which win over the text.
export function open(library, {toml, file = "scene.toml", files = {}, set = []}) {
  const fs = library.module.FS, folder = "/scene/" + file.split("/").slice(0, -1).join("/");
  for (const [path, bytes] of Object.entries(files)) {
    const to = "/scene/" + path;
    fs.mkdirTree(to.split("/").slice(0, -1).join("/"));
    fs.writeFile(to, bytes);
  }
  fs.mkdirTree(folder);
  fs.chdir(folder);  // errors then name the file alone
  const opened = library.withTexts(set, (texts, count) =>
      library.withStruct("rr_open_options", {file: file.split("/").pop(), set: texts, set_count: count, threads: 1},
                         options => library.out("rr_open", toml, options)));
  library.value("rr_close", simulation);
  simulation = opened;
  return information(library);
}

function information(library) {
  const {effect, variant, frame, frames, warnings, scene_json} = library.filled("rr_simulation_info", "rr_get_info", simulation), told = [];
  for (let i = 0; i < warnings; ++i) told.push(library.text(library.value("rr_warning", simulation, i)));
  return {effect, variant, frame, frames, warnings: told, scene: JSON.parse(scene_json)};
}

/// Gives a key another value, as TOML writes it, from the next frame on.
export function set(library, {key, value}) {
  library.call("rr_set", simulation, key, value);
  return information(library);
}

/// The next frame: its number, picture and hash lines, and how long it took.
export function frame(library) {
  const begin = performance.now(), lines = library.text(library.out("rr_next_frame_hashes", simulation)), milliseconds = performance.now() - begin;
  return shown(library, {milliseconds, lines: lines.trimEnd().split("\n")});
}

/// The next frame, and the first case of a pass in it as a port takes it, null where the pass does not run.
export function frameWithCase(library, {pass}) {
  const begin = performance.now(), cases = library.out("rr_cases_of_simulation", simulation);
  try {
    library.withTexts([pass], (texts, count) => library.call("rr_next_frame_cases", simulation, texts, count, cases));
    const milliseconds = performance.now() - begin;
    const given = library.value("rr_case_count", cases) > 0 ? caseOf(library, cases, 0) : null;
    const done = shown(library, {milliseconds, lines: []});
    return {result: {...done.result, given}, transfer: done.transfer};
  } finally {
    library.value("rr_free_cases", cases);
  }
}

function shown(library, more) {
  const info = library.filled("rr_simulation_info", "rr_get_info", simulation);
  const {width, height, row_bytes, plane} = library.filled("rr_array", "rr_get_picture", simulation);
  // Row 0 is the bottom one.
  const rgba = new Uint8ClampedArray(4 * width * height), from = library.module.HEAPU8;
  for (let y = 0; y < height; ++y) rgba.set(from.subarray(plane[0] + y * row_bytes, plane[0] + y * row_bytes + 4 * width), 4 * width * (height - 1 - y));
  for (let i = 3; i < rgba.length; i += 4) rgba[i] = 255;  // alpha is not coverage
  return {result: {frame: info.frame - 1, width, height, rgba: rgba.buffer, ...more}, transfer: [rgba.buffer]};
}
