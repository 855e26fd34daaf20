// Folders in pages: {name, files}, with files a Map from a path to a Blob. A Blob is read when it is needed, so a folder may be larger than
// memory.
import {archiveName, filesOfArchive} from "./archives.js";

/// The dropped folders; archives count as folders. Call it before the event handler returns. progress as for folderOfArchive.
export async function droppedFolders(transfer, progress) {
  const entries = [...transfer.items].map(item => item.webkitGetAsEntry?.() ?? item.getAsFile());
  const folders = [];
  for (const entry of entries) {
    if (entry instanceof File) folders.push(await folderOfArchive(entry, progress));
    else if (entry?.isFile) folders.push(await folderOfArchive(await new Promise((done, fail) => entry.file(done, fail)), progress));
    else if (entry?.isDirectory) folders.push(await folderOfEntry(entry));
  }
  return folders;
}

/// The content of an <input type="file">: files of one folder (webkitdirectory), or archives.
export async function chosenFolders(list, progress) {
  const files = [...list];
  if (files.length === 0) return [];
  if (!files[0].webkitRelativePath) {
    const folders = [];
    for (const file of files) folders.push(await folderOfArchive(file, progress));
    return folders;
  }
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

/// An archive as a folder, named like it. progress(name, count) after some files.
export async function folderOfArchive(file, progress = () => {}) {
  const name = archiveName(file);
  progress(file.name, 0);
  const files = await filesOfArchive(file, count => progress(file.name, count));
  // Most archives hold one folder, which is not that of the only pass.
  const tops = new Set([...files.keys()].map(path => path.split("/")[0])), [top] = tops;
  const isFolder = tops.size === 1 && !files.has(top) && ![...files.keys()].some(path => isOutput(path));
  return {name, files: isFolder ? new Map([...files].map(([path, blob]) => [path.slice(top.length + 1), blob])) : files};
}
/// Whether a path is that of a port's output: EFFECT.PASS/FRAME.STEP/out.BUFFER.ENDING.
export const isOutput = path => /^[^/]+\.[^/]+\/\d+\.\d+[^/]*\/out\.[^/]+$/.test(path);

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
