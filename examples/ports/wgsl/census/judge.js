// A pack and what a port gave, judged by rainref's C library as WebAssembly (scripts/web, include/rainref.h).

/// The bytes of the array in an .npy file.
const arrayOf = bytes => bytes.subarray(10 + bytes[8] + 256 * bytes[9]);
/// Structs of rainref.h where addresses have 32 bits: their bytes. Of rr_array the words 4 channels, 5 width, 6 height, 9 texel_bytes, 10 row_bytes,
/// 15 layout; of rr_case_info 1 id; of rr_pass_verdict 1 pass, 3 status, 4 reason, and from byte 24 on five counts of 64 bits.
const sizes = {array: 64, info: 52, options: 20, verdict: 24, passVerdict: 72};

/// module: what createRainref() gives. pack, port: from a path to its bytes. Gives of each pass that the port has anything of {pass, status,
/// reason, elements, outside}.
export function judgePack(module, manifest, pack, port, profile = "webgpu") {
  const text = pointer => module.UTF8ToString(pointer), taken = [];
  const room = bytes => (taken.push(module._malloc(bytes)), taken[taken.length - 1]);
  const string = s => (taken.push(module.stringToNewUTF8(s)), taken[taken.length - 1]);
  const word = (at, k) => module.getValue(at + 4 * k, "i32"), long = (at, byte) => (word(at + byte, 0) >>> 0) + 2 ** 32 * word(at + byte, 1);
  const check = result => {
    if (result !== 0) throw new Error(text(module._rr_error()));
  };
  const struct = bytes => {
    const at = room(bytes);
    module.HEAPU8.fill(0, at, at + bytes);
    module.setValue(at, bytes, "i32");
    return at;
  };
  const handle = (f, ...args) => {
    const to = room(4);
    check(f(...args, to));
    return module.getValue(to, "i32");
  };
  const folder = "/census";
  let cases = 0, judgement = 0;
  try {
    for (const [path, bytes] of Object.entries(pack)) {
      module.FS.mkdirTree(`${folder}/${path}`.replace(/\/[^/]*$/, ""));
      module.FS.writeFile(`${folder}/${path}`, bytes);
    }
    cases = handle(module._rr_cases_of_pack, string(folder), 0, 0);
    const array = struct(sizes.array), info = struct(sizes.info), byId = new Map(manifest.cases.map(c => [c.id, c]));
    for (let i = 0; i < module._rr_case_count(cases); ++i) {
      check(module._rr_get_case(cases, i, info));
      const oneCase = byId.get(text(word(info, 1)));
      oneCase.outputs.forEach((output, k) => {
        if (!port[output.file]) return;
        check(module._rr_get_expected(cases, i, k, array));
        const data = arrayOf(port[output.file]), isRecords = word(array, 15) !== 0, row = word(array, isRecords ? 9 : 10);
        const copy = room(Math.max(1, data.length));
        module.HEAPU8.set(data, copy);
        check(module._rr_give(cases, i, k, copy, row, isRecords ? data.length / row : word(array, 6)));
      });
    }
    const options = struct(sizes.options);
    module.setValue(options + 4, string(profile), "i32");
    judgement = handle(module._rr_judge, cases, options);
    const verdict = struct(sizes.verdict), of = struct(sizes.passVerdict), passes = [];
    check(module._rr_get_verdict(judgement, verdict));
    for (let p = 0; p < word(verdict, 5); ++p) {
      check(module._rr_get_pass_verdict(judgement, p, of));
      passes.push({pass: text(word(of, 1)), status: text(word(of, 3)), reason: text(word(of, 4)), elements: long(of, 32), outside: long(of, 40)});
    }
    return passes;
  } finally {
    module._rr_free_judgement(judgement);
    module._rr_free_cases(cases);
    for (const pointer of taken) module._free(pointer);
    for (const path of Object.keys(pack)) if (module.FS.analyzePath(`${folder}/${path}`).exists) module.FS.unlink(`${folder}/${path}`);
  }
}
