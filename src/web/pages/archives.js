// Archives as files: .tar, .tar.gz and .zip. The libraries of src/web/libraries read them; each is loaded with the first archive of its kind.
const endings = /\.(tar|tar\.gz|tgz|zip)$/i;
/// What an archive may unpack to, so that a small file cannot fill the memory of the tab.
export const limits = {bytes: 2 ** 31, files: 200000};

/// What we refuse by a sentence of our own; what a library throws is damage.
class Refused extends Error {}

/// The archive's name without its ending; throws if it has none of ours.
export function archiveName(file) {
  const name = file.name.replace(endings, "");
  if (name === file.name) throw new Error(`${file.name}: expected a folder, or one as .zip, .tar or .tar.gz`);
  return ["", ".", ".."].includes(name) ? "folder" : name;
}

/// The files of an archive, from a path to a Blob. Hard links are files; other links are refused. progress(count) after some files.
export async function filesOfArchive(file, progress = () => {}) {
  const given = new Files(progress), magic = new Uint8Array(await file.slice(0, 4).arrayBuffer());
  const isZip = magic[0] === 0x50 && magic[1] === 0x4b, isGzip = magic[0] === 0x1f && magic[1] === 0x8b;
  try {
    if (isZip) await readZip(file, given);
    else await readTar(isGzip ? file.stream().pipeThrough(new DecompressionStream("gzip")) : file.stream(), given);
    return given.finished();
  } catch (error) {
    const reason = given.refusal ?? error;  // a stream that we ended may give an error of its own
    if (reason instanceof Refused) throw new Error(`${file.name}: ${reason.message}`);
    if (/^Failed to fetch dynamically|^error loading dynamically|^Importing a module/.test(error.message)) throw error;
    throw new Error(`${file.name}: the archive is damaged or cut, or not what its name says (${error.message})`);
  }
}

/// What was unpacked, within the limits.
class Files {
  #files = new Map();
  #links = new Map();
  #bytes = 0;
  #progress;
  #shown = performance.now();
  refusal = null;

  constructor(progress) {
    this.#progress = progress;
  }
  refuse(sentence) {
    throw this.refusal = new Refused(sentence);
  }
  /// Counts unpacked bytes as they pass.
  counting() {
    return new TransformStream({transform: (chunk, to) => {
      this.#bytes += chunk.length;
      if (this.#bytes > limits.bytes) this.refuse(`the archive is too large: it unpacks to more than ${Math.round(limits.bytes / 2 ** 20)} MiB. Unpack it, and drop the folder.`);
      to.enqueue(chunk);
    }});
  }
  async add(path, blob) {
    this.#files.set(path, blob);
    this.#checkCount();
    if (performance.now() - this.#shown < 100) return;
    this.#progress(this.#files.size);
    await new Promise(next => setTimeout(next));  // a stream that is there already leaves the page no time to draw
    this.#shown = performance.now();
  }
  link(path, target) {
    this.#links.set(path, target);
    this.#checkCount();
  }
  #checkCount() {
    if (this.#files.size + this.#links.size > limits.files) this.refuse(`the archive is too large: it has more than ${limits.files} files. Unpack it, and drop the folder.`);
  }
  /// The path below the folder into which `tar` would unpack; null for what systems add beside a file.
  placed(path) {
    const parts = path.split("/").filter(part => part !== "" && part !== ".");
    if (parts.includes("..")) this.refuse(`"${path}" leads out of the folder`);
    if (parts.length === 0) this.refuse("a file has no name");
    const last = parts[parts.length - 1];
    return parts[0] === "__MACOSX" || last.startsWith("._") || last === ".DS_Store" ? null : parts.join("/");
  }
  finished() {
    for (const path of this.#links.keys()) {
      let target = path;
      for (const passed = new Set(); this.#links.has(target) && !passed.has(target); target = this.#links.get(target)) passed.add(target);
      if (!this.#files.has(target)) this.refuse(`"${path}" is a hard link to "${target}", which the archive does not hold`);
      this.#files.set(path, this.#files.get(target));
    }
    const folders = new Set();
    for (const path of this.#files.keys()) for (let at = path.indexOf("/"); at >= 0; at = path.indexOf("/", at + 1)) folders.add(path.slice(0, at));
    for (const path of this.#files.keys()) if (folders.has(path)) this.refuse(`"${path}" is a file and a folder`);
    return this.#files;
  }
}

/// A stream as a Blob, which the browser may keep outside memory. Response would do, but Firefox logs each stream that ends with an error.
async function blobOf(stream) {
  const reader = stream.getReader(), parts = [];
  for (let chunks = [], bytes = 0;;) {
    const {done, value} = await reader.read();
    if (!done) chunks.push(value);
    bytes += value?.length ?? 0;
    if (!done && bytes < 2 ** 24) continue;
    parts.push(new Blob(chunks));
    [chunks, bytes] = [[], 0];
    if (done) return parts.length === 1 ? parts[0] : new Blob(parts);
  }
}
const kinds = {symlink: "a symbolic link: pack the file that it leads to (tar -h)", fifo: "a pipe", "character-device": "a device", "block-device": "a device"};

async function readTar(stream, given) {
  const {createTarDecoder} = await import("./libraries/tar.js");
  const reader = stream.pipeThrough(given.counting()).pipeThrough(createTarDecoder({strict: true})).getReader();
  for (;;) {
    const {done, value} = await reader.read();
    if (done) return;
    const {header: {name, type, linkname, pax}, body} = value;
    if (type in kinds) given.refuse(`"${name}" is ${kinds[type]}`);
    if (Object.keys(pax ?? {}).some(key => key.startsWith("GNU.sparse."))) given.refuse(`"${name}" is stored with holes: pack it without --sparse`);
    const path = type === "directory" ? null : given.placed(name);
    if (path === null) await body.cancel();
    else if (type === "link") given.link(path, given.placed(linkname));
    else await given.add(path, await blobOf(body));
  }
}

async function readZip(file, given) {
  const {ZipReader} = await import("./libraries/zip.js");
  const part = (at, size) => file.slice(at, at + size);
  const source = {size: file.size, createReadable: ({offset, size}) => part(offset, size).stream(), readUint8Array: async (at, size) => new Uint8Array(await part(at, size).arrayBuffer())};
  const reader = new ZipReader(source, {useWebWorkers: false, checkCrc32: true, filenameValidation: "tolerant"});  // placed() checks names
  for (const entry of await reader.getEntries()) {
    const name = entry.filename.replaceAll("\\", "/");  // as old programs of Windows write
    if (entry.directory || name.endsWith("/")) continue;
    if (entry.encrypted) given.refuse(`"${name}" is encrypted: pack it without a password`);
    if ((entry.externalFileAttributes >>> 28) === 0o12) given.refuse(`"${name}" is ${kinds.symlink.replace("tar -h", "zip without -y")}`);
    const path = given.placed(name);
    if (path === null) continue;
    const {readable, writable} = given.counting(), [blob] = await Promise.all([blobOf(readable), entry.getData(writable)]);
    await given.add(path, blob);
  }
}
