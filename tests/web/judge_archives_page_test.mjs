// node judge_archives_page_test.mjs SITE chromium|firefox RAINREF SOURCES: what the judge page reads of archives, and what it says of those
// that it does not take.
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import zlib from "node:zlib";
import {ready, started} from "./judge_page.mjs";

const test = await started(), {name, browser, site, step, errors} = test, work = fs.mkdtempSync(path.join(os.tmpdir(), "judge-archives-"));

/// What a port's folder holds: a name that is longer than a header of tar has room for, one that is not ASCII, an empty file.
const content = {"port.json": "{}", "puddle.raindrops/0011.0/out.drops.npy": "drops", [`puddle.look/0011.0/${"long".repeat(40)}/out.x.npy`]: "long", "Tröpfchen/é.txt": "name", "empty": ""};
for (const [file, text] of Object.entries(content)) {
  fs.mkdirSync(path.dirname(path.join(work, "p", file)), {recursive: true});
  fs.writeFileSync(path.join(work, "p", file), text);
}
const at = file => path.join(work, file);
const run = (program, ...args) => execFileSync(program, args, {cwd: work, stdio: ["ignore", "ignore", "inherit"]});
const tar = (file, ...args) => { run("tar", "-cf", file, ...args); return fs.readFileSync(at(file)); };
/// A ZIP of [name, text, mode of Unix]s, stored or deflated, and with one flag of the entries set.
const zip = (entries, {method = 8, flag = 0} = {}) => {
  fs.writeFileSync(at("entries.json"), JSON.stringify(entries));
  run("python3", "-c", `
import json, zipfile
with zipfile.ZipFile("made.zip", "w", ${method}) as z:
  for name, text, mode in json.load(open("entries.json")):
    info = zipfile.ZipInfo(name); info.external_attr = mode << 16; info.create_system = 3; info.compress_type = ${method}
    z.writestr(info, text)
    info.filename = info.orig_filename = name
b = bytearray(open("made.zip", "rb").read())
for begin, offset in ((b"PK\\3\\4", 6), (b"PK\\1\\2", 8)):
  k = b.find(begin)
  while k >= 0: b[k + offset] |= ${flag}; k = b.find(begin, k + 1)
open("made.zip", "wb").write(b)`);
  return fs.readFileSync(at("made.zip"));
};
const plain = Object.entries(content).map(([file, text]) => [`p/${file}`, text, 0o100644]);

/// A header of tar with a right checksum, and the data.
function entry(file, data, {kind = "0", link = "", size = null, magic = "ustar\0" + "00", sum = null} = {}) {
  const block = Buffer.alloc(512), bytes = Buffer.from(data);
  block.write(file, 0);
  block.write("0000644\0" + "0000000\0" + "0000000\0", 100);
  block.set(size ?? Buffer.from(`${bytes.length.toString(8).padStart(11, "0")}\0`), 124);
  block.write("00000000000\0" + " ".repeat(8) + kind, 136);
  block.write(link, 157);
  block.write(magic, 257, "latin1");
  block.write(sum ?? `${block.reduce((a, b) => a + b, 0).toString(8).padStart(6, "0")}\0 `, 148);
  return Buffer.concat([block, bytes, Buffer.alloc(-bytes.length & 511)]);
}
const end = Buffer.alloc(1024), small = entry("p/port.json", "{}");
const base256 = value => { const bytes = Buffer.alloc(12); bytes[0] = 0x80; bytes.writeUInt32BE(value, 8); return bytes; };

/// What the page makes of an archive: {name, files} with texts, or {error}.
const read = (page, file, bytes, limits = {}) => page.evaluate(async (called, base64, lower) => {
  const data = Uint8Array.from(atob(base64), c => c.charCodeAt(0)), archives = await import("./archives.js"), usual = {...archives.limits};
  Object.assign(archives.limits, lower);
  try {
    const {name, files} = await (await import("./files.js")).folderOfArchive(new File([data], called));
    return {name, files: Object.fromEntries(await Promise.all([...files].map(async ([path, blob]) => [path, await blob.text()])))};
  } catch (error) {
    return {error: error.message};
  } finally {
    Object.assign(archives.limits, usual);
  }
}, file, bytes.toString("base64"), limits);

try {
  const page = await ready(test);
  await step("libraries are loaded with the first archive of their kind", async () => {
    assert(!site.requests().some(asked => asked.startsWith("/libraries/")));
    await read(page, "p.tar", Buffer.concat([small, end]));
    assert.deepEqual(site.requests().filter(asked => asked.startsWith("/libraries/")), ["/libraries/tar.js"]);
  });

  await step("archives are read", async () => {
    const gnu = tar("gnu.tar", "--format=gnu", "p"), mac = [["__MACOSX/p/._port.json", "x", 0], ["p/.DS_Store", "x", 0], ["p/._empty", "x", 0]];
    const archives = {
      "gnu.tar": gnu, "gnu.tar.gz": zlib.gzipSync(gnu), "pax.tgz": zlib.gzipSync(tar("pax.tar", "--format=posix", "p")),
      "dot.tar": tar("dot.tar", "-C", "p", "."), "absolute.tar": Buffer.concat([...plain.flatMap(([f, text]) => [entry("././@LongLink", `/${f}\0`, {kind: "L"}), entry("x", text)]), end]),
      "windows.zip": zip(plain.map(([f, text]) => [f.replaceAll("/", "\\\\"), text, 0])), "mac.zip": zip([...mac, ...plain]), "stored.zip": zip(plain, {method: 0}),
      "a zip that is named.tar": zip(plain),
    };
    for (const [file, bytes] of Object.entries(archives))
      assert.deepEqual(await read(page, file, bytes), {name: file.replace(/\.(tar\.gz|tar|tgz|zip)$/, ""), files: content}, file);
    const one = {"port.json": "{}"};
    for (const [file, bytes] of Object.entries({
      "v7.tar": Buffer.concat([entry("p/port.json", "{}", {magic: ""}), end]), "base256.tar": Buffer.concat([entry("p/port.json", "{}", {size: base256(2)}), end]),
      "twice.tar": Buffer.concat([entry("p/port.json", "old"), small, end]), "...tar": Buffer.concat([small, end]),
    })) assert.deepEqual((await read(page, file, bytes)).files, one, file);
    // The folder of the only pass stays.
    assert.deepEqual(Object.keys((await read(page, "one.tar", Buffer.concat([entry("puddle.look/0011.0/out.x.npy", "x"), end]))).files), ["puddle.look/0011.0/out.x.npy"]);
  });

  await step("hard links are followed", async () => {
    fs.linkSync(at("p/port.json"), at("p/linked.json"));
    assert.deepEqual(await read(page, "p.tar", tar("linked.tar", "p")), {name: "p", files: {...content, "linked.json": "{}"}});
    fs.rmSync(at("p/linked.json"));
    const missing = await read(page, "p.tar", Buffer.concat([small, entry("p/a", "", {kind: "1", link: "p/none"}), end]));
    assert.match(missing.error, /^p\.tar: "p\/a" is a hard link to "p\/none", which the archive does not hold$/);
    const round = [entry("p/a", "", {kind: "1", link: "p/b"}), entry("p/b", "", {kind: "1", link: "p/a"})];
    assert.match((await read(page, "p.tar", Buffer.concat([small, ...round, end]))).error, /is a hard link to/);
  });

  await step("damaged and foreign archives are named", async () => {
    const whole = tar("whole.tar", "p"), packed = zlib.gzipSync(whole), crc = Buffer.from(packed), stored = zip(plain, {method: 0}), zipped = zip(plain), flipped = Buffer.from(stored);
    crc[crc.length - 8] ^= 1;
    flipped[flipped.indexOf("drops", flipped.indexOf("out.drops.npy") + 13)] ^= 1;
    const damaged = {
      "cut.tar": whole.subarray(0, 700), "cut at a file.tar": small, "cut.tar.gz": packed.subarray(0, packed.length - 20), "crc.tar.gz": crc,
      "text.tar": Buffer.from("no archive at all, but a text ".repeat(60)), "text.tar.gz": Buffer.from("no gzip"), "nothing.tar": Buffer.alloc(0), "noise.tar.gz": Buffer.concat([Buffer.from([0x1f, 0x8b]), whole]),
      "checksum.tar": Buffer.concat([entry("p/port.json", "{}", {sum: "000000\0 "}), end]), "negative.tar": Buffer.concat([entry("p/a", "", {size: Buffer.alloc(12, 255)}), end]),
      "cut.zip": zipped.subarray(0, zipped.length - 30), "flipped.zip": flipped, "half.zip": zipped.subarray(0, zipped.length / 2),
    };
    for (const [file, bytes] of Object.entries(damaged)) {
      const {error} = await read(page, file, bytes);
      assert(error?.startsWith(`${file}: the archive is damaged or cut`), `${file}: ${error}`);
    }
    const refused = [
      [entry("p/l", "", {kind: "2", link: "/etc/passwd"}), /^p\.tar: "p\/l" is a symbolic link/], [entry("p/d", "", {kind: "3"}), /"p\/d" is a device/],
      [entry("p/f", "", {kind: "6"}), /"p\/f" is a pipe/], [entry("p/../../x", "x"), /"p\/\.\.\/\.\.\/x" leads out of the folder/],
      [entry("p/port.json/x", "x"), /"p\/port\.json" is a file and a folder/], [entry("", "x"), /a file has no name/],
    ];
    for (const [bytes, sentence] of refused) assert.match((await read(page, "p.tar", Buffer.concat([small, bytes, end]))).error ?? "", sentence);
    assert.match((await read(page, "p.zip", zip([["p/a", "x", 0o100644], ["p/l", "/etc/passwd", 0o120777]]))).error, /^p\.zip: "p\/l" is a symbolic link/);
    assert.match((await read(page, "p.zip", zip(plain, {flag: 1}))).error, /"p\/port\.json" is encrypted/);
    assert.match((await read(page, "p.zip", zip([["../x", "x", 0]]))).error, /"\.\.\/x" leads out of the folder/);
    assert.match((await read(page, "p.rar", small)).error, /^p\.rar: expected a folder, or one as \.zip, \.tar or \.tar\.gz$/);
  });

  await step("archives that unpack to too much are refused", async () => {
    const large = "\0".repeat(3 << 20), sentence = /^p\.(tar\.gz|zip): the archive is too large: it unpacks to more than 2 MiB/;
    assert.match((await read(page, "p.tar.gz", zlib.gzipSync(Buffer.concat([entry("p/a", large), end])), {bytes: 2 << 20})).error, sentence);
    assert.match((await read(page, "p.zip", zip([["p/a", large, 0]]), {bytes: 2 << 20})).error, sentence);
    assert.match((await read(page, "p.tar", Buffer.concat([small, entry("p/a", "x"), entry("p/b", "x"), end]), {files: 2})).error, /it has more than 2 files/);
    assert.deepEqual(await page.evaluate(async () => (await import("./archives.js")).limits), {bytes: 2 ** 31, files: 200000});
  });
  assert.deepEqual(errors, []);
} finally {
  await browser.close();
  site.close();
  fs.rmSync(work, {recursive: true, force: true});
}
