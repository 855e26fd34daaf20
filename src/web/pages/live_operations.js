// Operations of the live page on the library: a running scene, its picture, its lines of hashes, and cases of a pass for a port. engine.js
// says how they are called. Names and bytes only: the page draws, and runs ports.
import {structs} from "./c_library.js";
import {KeptImages} from "./kept_images.js";
import {addCases, judgeCases} from "./live_cases.js";

Object.assign(structs, {
  rr_case_info: [["id", "text"], ["effect", "text"], ["variant", "text"], ["pass", "text"], ["formula", "text"], ["frame", "i32"], ["step", "i32"],
                 ["level", "i32"], ["time", "f32"], ["dt", "f32"], ["inputs", "size"], ["outputs", "size"]],
  rr_sampling: [["filter", "text"], ["mip_filter", "text"], ["address_u", "text"], ["address_v", "text"], ["border", "f32*4"]],
  rr_layout_info: [["name", "text"], ["bytes", "size"], ["members", "size"]],
  rr_member: [["name", "text"], ["unit", "text"], ["sentence", "text"], ["type", "i32"], ["components", "i32"], ["offset", "size"], ["low", "f64"],
              ["high", "f64"]],
  rr_judge_options: [["profile", "text"], ["port", "text"], ["half", "text"], ["threads", "i32"], ["strict", "i32"],
                     ["exhaustive", "i32"], ["spirv", "text"]],
  rr_pass_verdict: [["pass", "text"], ["formula", "text"], ["status", "text"], ["reason", "text"], ["where", "text"], ["cases", "i64"],
                    ["elements", "i64"], ["outside", "i64"], ["differing", "i64"], ["vacuous", "i64"], ["causes", "size"], ["worst", "size"],
                    ["sampled", "i64"]],
});

let simulation = 0, kept = null, keptFor = null;
const opened = library => {
  if (simulation === 0) throw new Error("no scene is open");
  return simulation;
};

/// {effects: [the result of rr_describe for each], version, generation, offers}; offers: what the page may show beside a scene (live_run.js).
export function describe(library) {
  const effects = [];
  for (let k = 0, name; (name = library.text(library.value("rr_effect_name", k))) !== null; ++k)
    effects.push(JSON.parse(library.text(library.out("rr_describe", name))));
  return {effects, version: library.text(library.value("rr_version")), generation: library.value("rr_golden_generation"), offers: ["ports", "site"]};
}

/// Opens the scene `text` in place of the running one, which stays if the new one is refused. `sets`: ["key=value", ...]. `file`: its name
/// in errors. `files`: [{path, bytes}] that it may name, relative to the folder of `file`.
export async function open(library, {text, file, sets = [], files = []}) {
  kept ??= new KeptImages(library);
  keptFor = [file, ...sets.filter(set => /^(run\.size|run\.supersample|scene\.size)=/.test(set))].join(" ");
  await kept.bring(keptFor);
  const {FS} = library.module, folder = "/scenes";
  for (const {path, bytes} of files) {
    const to = `${folder}/${path}`;
    FS.mkdirTree(to.slice(0, to.lastIndexOf("/")));
    FS.writeFile(to, bytes);
  }
  const path = `${folder}/${file}`;
  FS.mkdirTree(path.slice(0, path.lastIndexOf("/")));
  FS.chdir(folder);
  const made = library.withTexts(sets, (set, set_count) =>
    library.withStruct("rr_open_options", {file, set, set_count, threads: 1}, options => library.out("rr_open", text, options)));
  close(library);
  simulation = made;
  return info(library);
}

export function close(library) {
  library.value("rr_close", simulation);
  simulation = 0;
}

/// {effect, variant, frame, frames, sceneJson, warnings: [sentence, ...]}; frame: frames simulated so far; sceneJson: every key with its value.
export function info(library) {
  const {effect, variant, frame, frames, scene_json, warnings: count} = library.filled("rr_simulation_info", "rr_get_info", opened(library));
  const warnings = Array.from({length: count}, (_, k) => library.text(library.value("rr_warning", simulation, k)));
  return {effect, variant, frame, frames, sceneJson: scene_json, warnings};
}

/// Sets a key to another value, written as in TOML, from the next frame on.
export function set(library, {key, value}) {
  library.call("rr_set", opened(library), key, value);
  return info(library);
}

/// The state between frames: bytes, which `load` takes for the same scene.
export function save(library) {
  const {module} = library, parts = [];
  const write = module.addFunction((user, at, count) => { parts.push(library.bytes(at, count)); return 0; }, "iiii");
  try {
    library.call("rr_save", opened(library), write, 0);
  } finally {
    module.removeFunction(write);
  }
  const state = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  parts.reduce((at, part) => (state.set(part, at), at + part.length), 0);
  return {result: state, transfer: [state.buffer]};
}
export function load(library, {state}) {
  const {module} = library;
  let at = 0;
  const read = module.addFunction((user, to, count) => {
    const part = state.subarray(at, at + count);
    module.HEAPU8.set(part, to);
    at += part.length;
    return BigInt(part.length);
  }, "jiii");
  try {
    library.call("rr_load", opened(library), read, 0);
  } finally {
    module.removeFunction(read);
  }
}

/// The next frame: {lines, milliseconds, width, height, picture}; picture: RGBA of 8 bits, top row first.
export function step(library) {
  const begin = performance.now();
  const lines = library.text(library.out("rr_next_frame_hashes", opened(library))).trimEnd().split("\n");
  const milliseconds = performance.now() - begin, shown = picture(library);
  // What the first frame needed has been made. The answer goes first.
  if (keptFor !== null) setTimeout(kept.keep.bind(kept, keptFor));
  keptFor = null;
  return {result: {lines, milliseconds, ...shown}, transfer: [shown.picture.buffer]};
}

/// The next frame, with the inputs and outputs of the named pass: {milliseconds, width, height, picture, cases} (live_cases.js).
export function stepWithCases(library, {pass}) {
  const begin = performance.now(), cases = addCases(library, opened(library), pass);
  const milliseconds = performance.now() - begin, shown = picture(library);
  return {result: {milliseconds, ...shown, cases}, transfer: [shown.picture.buffer]};
}

/// Judges a port's results for the cases of the last stepWithCases: {status, reason, elements, outside, differing, outputs}
/// (live_cases.js).
export const judge = (library, {profile, given}) => judgeCases(library, profile, given);

function picture(library) {
  const {width, height, row_bytes, texel_bytes, plane} = library.filled("rr_array", "rr_get_picture", simulation);
  if (texel_bytes !== 4) throw new Error(`a picture of ${texel_bytes} bytes a texel`);
  const heap = library.module.HEAPU8, picture = new Uint8ClampedArray(4 * width * height);
  for (let y = 0; y < height; ++y) {  // the library's row 0 is the bottom one
    const from = plane[0] + (height - 1 - y) * row_bytes;
    picture.set(heap.subarray(from, from + 4 * width), 4 * width * y);
  }
  return {width, height, picture};
}
