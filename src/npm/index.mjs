// rainref for JavaScript: scenes that run, and verdicts on the files of GPU ports. The library is WebAssembly; it runs in the caller's
// thread, and a verdict may take minutes, so a page puts it into a worker.
import {CLibrary, RainrefError} from "./c_library.js";
import {judgeFolder} from "./judge_files.mjs";
import {Simulation} from "./simulation.mjs";
import {load} from "#load";

export {RainrefError, Simulation};

/// The whole library, or without the judge and without what reads pictures in files, which is half as large.
export async function loadRainref({judge = true} = {}) {
  return new Rainref(new CLibrary(await load(judge ? "rainref_module" : "rainref_simulator")));
}

export class Rainref {
  /// `library`: a CLibrary, for what has no function here (include/rainref.h).
  constructor(library) {
    this.library = library;
  }
  get version() { return this.library.text(this.library.value("rr_version")); }
  get goldenGeneration() { return this.library.value("rr_golden_generation"); }
  get effects() { return this.#names("rr_effect_name"); }
  /// Not without the judge.
  get profiles() { return this.#names("rr_profile_name"); }

  /// Parameters, passes, buffers and layouts of an effect.
  describe(effect) { return JSON.parse(this.library.text(this.library.out("rr_describe", effect))); }

  /// Opens the text of a scene. `set`: ["key=value", ...]. `files`: Map from a path, relative to the scene, to the bytes of a file that it
  /// names. Call close() on the result.
  open(toml, {set = [], files = new Map(), name = "scene.toml"} = {}) {
    return new Simulation(this.library, toml, set, files, name);
  }

  /// Judges the files that a port wrote for a pack. Folders are Maps from a path to its bytes. Returns {status, text, json, html, junit}.
  judge(pack, port, options = {}) { return judgeFolder(this.library, pack, port, options); }

  #names(name) {
    const found = [];
    for (let k = 0, text; (text = this.library.text(this.library.value(name, k))) !== null; ++k) found.push(text);
    return found;
  }
}
