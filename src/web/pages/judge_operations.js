// Operations of the judge page on the library (engine.js): folders of Blobs, judged without copies in memory.
import {structs} from "./c_library.js";

structs.rr_folder_options = [["profile", "text"], ["passes", "pointer"], ["pass_count", "size"], ["partial", "i32"], ["threads", "i32"],
                             ["progress", "pointer"], ["user", "pointer"], ["strict", "i32"], ["exhaustive", "i32"],
                             ["spirv", "text"]];

/// The names of the profiles.
export function profiles(library) {
  const names = [];
  for (let i = 0, pointer; (pointer = library.value("rr_profile_name", i)) !== 0; ++i) names.push(library.text(pointer));
  return names;
}
export const version = library => library.text(library.value("rr_version"));

/// The library works in a folder of its own for each call, because folders have names from outside: "dev" and "proc" are there already.
function inFolder({FS}, calls) {
  const at = `/judging/${calls}`;
  FS.mkdirTree(at);
  FS.chdir(at);
  return at;
}
let calls = 0;

/// Makes a folder, {path, files: [[path, Blob]]}, visible to the library; returns a function that removes it. Blobs are read by
/// FileReaderSync. Emscripten keeps names as keys of objects, so those that each object has are left out; no port's file has one.
function mounted({FS, WORKERFS}, root, {path, files}) {
  const at = `${root}/${path}`, blobs = files.filter(([name]) => !name.split("/").some(part => part in Object.prototype));
  FS.mkdirTree(at);
  FS.mount(WORKERFS, {blobs: blobs.map(([name, data]) => ({name, data}))}, at);
  return () => FS.unmount(at);
}

/// Judges a port's folder for a pack: {text, json, html, junit}. `spirv`: a folder of the port's shaders, which are asked who is wrong, and where.
/// Paths are relative. progress(done, of) after each run.
export function judgeFolder(library, {pack, port, spirv = null, profile, passes = [], partial = false}, progress) {
  const {module} = library, undo = [];
  const root = inFolder(module, ++calls);
  try {
    for (const folder of [pack, port, spirv]) if (folder) undo.push(mounted(module, root, folder));
    const callback = module.addFunction((user, done, of) => { progress(done, of); return 0; }, "iiii");
    undo.push(() => module.removeFunction(callback));
    const judgement = library.withTexts(passes, (names, count) => library.withStruct("rr_folder_options",
      {profile, passes: count ? names : 0, pass_count: count, partial: partial ? 1 : 0, progress: callback, spirv: spirv?.path},
      options => library.out("rr_judge_folder", pack.path, port.path, options)));
    undo.push(() => library.value("rr_free_judgement", judgement));
    return Object.fromEntries(["text", "json", "html", "junit"].map(kind => [kind, library.text(library.out(`rr_report_${kind}`, judgement))]));
  } finally {
    module.FS.chdir("/");
    for (const step of undo.reverse()) {
      try {
        step();
      } catch {}  // what could not be removed must not hide the result, and meets no later call
    }
  }
}
