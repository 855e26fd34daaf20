// node module_test.cjs MODULE.js HASHES: what a page does with the module, through the functions of rainref.h. Every effect's default scene is
// opened and stepped through frames 0, 1 and 2, whose lines must be those that the native program printed (HASHES/hash-<effect>.native), and
// the scenes of tests/c_library/scenes, whose lines stand in tests/golden/hashes.txt. Then a pack is judged that lies in memory.
const assert = require('assert'), fs = require('fs'), path = require('path');
const [modulePath, hashes] = process.argv.slice(2);

(async () => {
  const m = await require(path.resolve(modulePath))();
  const text = (pointer) => m.UTF8ToString(pointer);
  const check = (result) => assert.strictEqual(result, 0, text(m._rr_error()));
  /// What a function writes to its last argument, an address.
  const given = (f, ...args) => {
    const to = m._malloc(4);
    check(f(...args, to));
    const value = m.getValue(to, 'i32');
    m._free(to);
    return value;
  };
  const texts = (strings) => {
    const array = m._malloc(4 * Math.max(1, strings.length));
    strings.forEach((s, i) => m.setValue(array + 4 * i, m.stringToNewUTF8(s), 'i32'));
    return array;
  };
  /// struct rr_open_options: its size, file, set, set_count, threads.
  const options = (set) => {
    const o = m._malloc(20);
    [20, 0, texts(set), set.length, 1].forEach((value, i) => m.setValue(o + 4 * i, value, 'i32'));
    return o;
  };
  const open = (toml, set) => given(m._rr_open, m.stringToNewUTF8(toml), options(set));
  const frame = (simulation) => text(given(m._rr_next_frame_hashes, simulation)).trimEnd().split('\n');
  let lines = 0;

  for (let i = 0, pointer; (pointer = m._rr_effect_name(i)) !== 0; ++i) {
    const effect = text(pointer);
    const native = fs.readFileSync(path.join(hashes, `hash-${effect}.native`), 'utf8').split('\n').filter((l) => /^\d/.test(l));
    const simulation = open(fs.readFileSync(`scenes/${effect}/default.toml`, 'utf8'), ['run.size=[64, 36]']);
    const found = [0, 1, 2].flatMap(() => frame(simulation));
    m._rr_close(simulation);
    assert.deepStrictEqual(found, native, `${effect}: not the native hashes`);
    lines += found.length;
  }

  const recorded = new Set(fs.readFileSync('tests/golden/hashes.txt', 'utf8').split('\n'));
  let scenes = 0;
  for (const file of fs.readdirSync('tests/c_library/scenes')) {
    const toml = fs.readFileSync(`tests/c_library/scenes/${file}`, 'utf8');
    const name = toml.match(/^# (\S+)/)[1], simulation = open(toml, []);
    for (let f = 0; f < 3; ++f) {
      for (const line of frame(simulation)) {
        assert(recorded.has(`${name} ${line}`), `${name} ${line}: not as recorded`);
        ++lines;
      }
    }
    m._rr_close(simulation);
    ++scenes;
  }
  assert(scenes > 0);

  // A pack in memory, judged twice: as it is, and with one number of one output changed.
  const pack = 'build/release/packs/puddle-corrected';
  for (const entry of fs.readdirSync(pack, {recursive: true, withFileTypes: true})) {
    const from = path.join(entry.parentPath ?? entry.path, entry.name), to = path.join('/pack', path.relative(pack, from));
    if (entry.isDirectory()) continue;
    m.FS.mkdirTree(path.dirname(to));
    m.FS.writeFile(to, fs.readFileSync(from));
  }
  // struct rr_array and rr_verdict where addresses have 32 bits; the library refuses another size. Words of rr_array: 4 channels, 5 width,
  // 6 height, 9 texel_bytes, 10 row_bytes, 11 the first plane.
  const array = m._malloc(64), word = (k) => m.getValue(array + 4 * k, 'i32');
  const judged = (broken) => {
    const cases = given(m._rr_cases_of_pack, m.stringToNewUTF8('/pack'), 0, 0);
    let wrong = broken;
    for (let c = 0; c < m._rr_case_count(cases); ++c) {
      for (let output = 0;; ++output) {
        m.setValue(array, 64, 'i32');
        if (m._rr_get_expected(cases, c, output, array) !== 0) break;
        const records = word(15) !== 0, count = records ? word(5) : word(6), pitch = records ? word(9) : word(10);
        const copy = m._malloc(count * pitch + 1);
        m.HEAPU8.copyWithin(copy, word(11), word(11) + count * pitch);
        if (wrong && !records) {
          m.HEAPU8[copy + 1] ^= 0x40;
          wrong = false;
        }
        check(m._rr_give(cases, c, output, copy, pitch, count));
        m._free(copy);
      }
    }
    const judgement = given(m._rr_judge, cases, 0), verdict = m._malloc(24);
    m.setValue(verdict, 24, 'i32');
    check(m._rr_get_verdict(judgement, verdict));
    const status = text(m.getValue(verdict + 4, 'i32'));
    assert(text(given(m._rr_report_html, judgement)).includes('</html>'));
    m._rr_free_judgement(judgement);
    m._rr_free_cases(cases);
    return status;
  };
  assert.deepStrictEqual([judged(false), judged(true)], ['PASS', 'FAIL']);
  console.log(`module: ${lines} lines of frames as native and as recorded, ${scenes} golden scenes`);
})().catch((e) => {
  console.error(e);
  process.exitCode = 1;
});
