// Folders in pages: {name, files}, with files a Map from a path to a Blob. A Blob is read when it is needed, so a folder may be larger than
// memory.

/// The dropped folders; archives (.tar, .tar.gz, .tgz) count as folders. Call it before the event handler returns.
export async function droppedFolders(transfer) {
  const entries = [...transfer.items].map(item => item.webkitGetAsEntry?.() ?? item.getAsFile());
  const folders = [];
  for (const entry of entries) {
    if (entry instanceof File) folders.push(await folderOfArchive(entry));
    else if (entry?.isFile) folders.push(await folderOfArchive(await new Promise((done, fail) => entry.file(done, fail))));
    else if (entry?.isDirectory) folders.push(await folderOfEntry(entry));
  }
  return folders;
}

/// The content of an <input type="file">: files of one folder (webkitdirectory), or archives.
export async function chosenFolders(list) {
  const files = [...list];
  if (files.length === 0) return [];
  if (!files[0].webkitRelativePath) return Promise.all(files.map(folderOfArchive));
  const name = files[0].webkitRelativePath.split("/")[0];
  return [{name, files: new Map(files.map(file => [file.webkitRelativePath.split("/").slice(1).join("/"), file]))}];
}

async function folderOfEntry(folder) {
  const files = new Map();
  const walk = async (entry, path) => {
    const reader = entry.createReader();
    for (;;) {  // it gives some at a time
      const some = await new Promise((done, fail) => reader.readEntries(done, fail));
      if (some.length === 0) return;
      for (const inner of some) {
        if (inner.isDirectory) await walk(inner, `${path}${inner.name}/`);
        else files.set(path + inner.name, await new Promise((done, fail) => inner.file(done, fail)));
      }
    }
  };
  await walk(folder, "");
  return {name: folder.name, files};
}

/// An archive as a folder, named like it.
export async function folderOfArchive(file) {
  const name = file.name.replace(/\.(tar|tar\.gz|tgz)$/i, "");
  if (name === file.name) throw new Error(`${file.name}: expected a folder, or one as .tar or .tar.gz`);
  let files = untarred(await unpacked(file), file.name);
  // Most archives hold one folder.
  const tops = new Set([...files.keys()].map(path => path.split("/")[0]));
  if (tops.size === 1 && !files.has([...tops][0])) files = new Map([...files].map(([path, blob]) => [path.slice(path.indexOf("/") + 1), blob]));
  return {name, files};
}

/// The bytes of a file that may be gzipped; some servers decompress it in transfer.
export async function unpacked(blob) {
  const magic = new Uint8Array(await blob.slice(0, 2).arrayBuffer());
  if (magic[0] !== 0x1f || magic[1] !== 0x8b) return new Uint8Array(await blob.arrayBuffer());
  return new Uint8Array(await new Response(blob.stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer());
}

/// The files of a tar archive: ustar, with the long names of GNU and pax.
export function untarred(bytes, name) {
  const files = new Map(), text = (at, length) => new TextDecoder().decode(bytes.subarray(at, at + length)).replace(/\0.*$/s, "");
  let longName = null;
  for (let at = 0; at + 512 <= bytes.length && bytes[at] !== 0;) {
    const size = parseInt(text(at + 124, 12).trim() || "0", 8), kind = String.fromCharCode(bytes[at + 156]), begin = at + 512;
    if (text(at + 257, 5) !== "ustar" || !(size >= 0) || begin + size > bytes.length) throw new Error(`${name}: not a tar archive, or cut short`);
    const prefix = text(at + 345, 155), path = longName ?? (prefix && text(at + 263, 2) === "00" ? `${prefix}/` : "") + text(at, 100);
    longName = null;
    if (kind === "L") longName = text(begin, size);
    else if (kind === "x") longName = /(?:^|\n)\d+ path=([^\n]*)\n/.exec(text(begin, size))?.[1] ?? null;
    else if (kind === "0" || kind === "\0") files.set(path.replace(/^\.\//, ""), new Blob([bytes.subarray(begin, begin + size)]));
    at = begin + Math.ceil(size / 512) * 512;
  }
  return files;
}

/// The JSON in a file of a folder; throws an Error with its name if there is no such file.
export async function jsonOf(folder, path) {
  const blob = folder.files.get(path);
  if (!blob) throw new Error(`${folder.name}: it has no ${path}`);
  try {
    return JSON.parse(await blob.text());
  } catch (error) {
    throw new Error(`${folder.name}/${path}: ${error.message}`);
  }
}
export async function bytesOf(folder, path) {
  const blob = folder.files.get(path);
  if (!blob) throw new Error(`${folder.name}: it has no ${path}`);
  return new Uint8Array(await blob.arrayBuffer());
}
