// Verdicts on files: folders as Maps from a path to bytes, put into the library's file system while it judges.
import {structs} from "./c_library.js";

structs.rr_folder_options = [["profile", "text"], ["passes", "pointer"], ["pass_count", "size"], ["partial", "i32"], ["threads", "i32"],
                             ["progress", "pointer"], ["user", "pointer"], ["strict", "i32"], ["exhaustive", "i32"],
                             ["spirv", "text"]];
const reports = ["text", "json", "html", "junit"];

/// Puts a folder at a path; returns a function that removes it.
function put({FS}, at, folder) {
  FS.mkdirTree(at);
  for (const [path, bytes] of folder) {
    const to = `${at}/${path}`;
    FS.mkdirTree(to.slice(0, to.lastIndexOf("/")));
    FS.writeFile(to, bytes);
  }
  const remove = path => {  // what stands in it first
    for (const name of FS.readdir(path)) {
      if (name === "." || name === "..") continue;
      const inner = `${path}/${name}`;
      if (FS.isDir(FS.stat(inner).mode)) remove(inner);
      else FS.unlink(inner);
    }
    FS.rmdir(path);
  };
  return () => remove(at);
}

/// `spirv`: a folder of the port's shaders, whose lines are then named. onProgress(done, of) is called after each run; if it returns false,
/// the judging ends with a RainrefError. `names`: what reports call the folders.
export function judgeFolder(library, pack, port, {profile = "vulkan", passes = [], partial = false, strict = false, exhaustive = false, spirv = null,
                                                  onProgress = () => true, names = {}} = {}) {
  const {module} = library, undo = [], at = {pack: `/pack/${names.pack ?? "pack"}`, port: `/port/${names.port ?? "port"}`, spirv: "/spirv"};
  try {
    undo.push(put(module, at.pack, pack));
    undo.push(put(module, at.port, port));
    if (spirv) undo.push(put(module, at.spirv, spirv));
    const callback = module.addFunction((user, done, of) => (onProgress(done, of) === false ? 1 : 0), "iiii");
    undo.push(() => module.removeFunction(callback));
    const judgement = library.withTexts(passes, (texts, count) => library.withStruct("rr_folder_options",
      {profile, passes: count ? texts : 0, pass_count: count, partial: +partial, threads: 1, progress: callback, strict: +strict,
       exhaustive: +exhaustive, spirv: spirv ? at.spirv : null},
      options => library.out("rr_judge_folder", at.pack, at.port, options)));
    undo.push(() => library.value("rr_free_judgement", judgement));
    const made = Object.fromEntries(reports.map(kind => [kind, library.text(library.out(`rr_report_${kind}`, judgement))]));
    return {status: JSON.parse(made.json).status, ...made};
  } finally {
    for (const step of undo.reverse()) step();
  }
}
