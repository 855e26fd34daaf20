// A pack and what a port gave, judged by rainref's C library as WebAssembly (scripts/web, include/rainref.h).

/// Structs of rainref.h where addresses have 32 bits: their bytes. Of rr_folder_options the words 1 profile, 2 passes, 3 pass_count; of rr_verdict 5
/// passes; of rr_pass_verdict 1 pass, 3 status, 4 reason, and from byte 24 on counts of 64 bits: cases, elements, outside.
const sizes = {folderOptions: 44, verdict: 24, passVerdict: 80};
const folders = {pack: "/census/pack", port: "/census/port"};

/// module: what createRainref() gives. pack, port: from a path to its bytes. Gives of each of the named passes {pass, status, reason, elements,
/// outside}.
export function judgePack(module, {pack, port, passes, profile = "webgpu"}) {
  const taken = [], written = [];
  const text = pointer => module.UTF8ToString(pointer), keep = pointer => (taken.push(pointer), pointer), string = s => keep(module.stringToNewUTF8(s));
  const word = (at, k) => module.getValue(at + 4 * k, "i32"), count = at => (word(at, 0) >>> 0) + 2 ** 32 * word(at, 1);
  const check = result => {
    if (result !== 0) throw new Error(text(module._rr_error()));
  };
  const struct = (bytes, words = {}) => {
    const at = keep(module._malloc(bytes));
    module.HEAPU8.fill(0, at, at + bytes);
    for (const [k, value] of Object.entries({0: bytes, ...words})) module.setValue(at + 4 * Number(k), value, "i32");
    return at;
  };
  const write = (folder, files) => {
    for (const [path, bytes] of Object.entries(files)) {
      const file = `${folder}/${path}`;
      module.FS.mkdirTree(file.replace(/\/[^/]*$/, ""));
      module.FS.writeFile(file, bytes);
      written.push(file);
    }
  };
  let judgement = 0;
  try {
    write(folders.pack, pack);
    write(folders.port, port);
    const names = keep(module._malloc(4 * Math.max(1, passes.length))), to = keep(module._malloc(4));
    passes.forEach((pass, k) => module.setValue(names + 4 * k, string(pass), "i32"));
    const options = struct(sizes.folderOptions, {1: string(profile), 2: names, 3: passes.length});
    check(module._rr_judge_folder(string(folders.pack), string(folders.port), options, to));
    judgement = word(to, 0);
    const verdict = struct(sizes.verdict), of = struct(sizes.passVerdict), given = [];
    check(module._rr_get_verdict(judgement, verdict));
    for (let p = 0; p < word(verdict, 5); ++p) {
      check(module._rr_get_pass_verdict(judgement, p, of));
      given.push({pass: text(word(of, 1)), status: text(word(of, 3)), reason: text(word(of, 4)), elements: count(of + 32), outside: count(of + 40)});
    }
    return given;
  } finally {
    module._rr_free_judgement(judgement);
    for (const pointer of taken) module._free(pointer);
    for (const file of written) module.FS.unlink(file);
  }
}
