// Packs as one file each: .tar.gz, as scripts/web makes them.

/// The files of a gzipped tar archive (ustar): from a path to its bytes.
export async function filesOfTar(gzipped) {
  const stream = new Blob([gzipped]).stream().pipeThrough(new DecompressionStream("gzip"));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer()), files = {}, decoder = new TextDecoder();
  const text = (at, length) => decoder.decode(bytes.subarray(at, at + length)).replace(/\0.*$/s, "");
  for (let at = 0; at + 512 <= bytes.length && bytes[at] !== 0;) {
    const size = parseInt(text(at + 124, 12), 8), prefix = text(at + 345, 155), name = (prefix ? prefix + "/" : "") + text(at, 100), isFile = "0\0".includes(String.fromCharCode(bytes[at + 156]));
    if (!(size >= 0) || at + 512 + size > bytes.length || text(at + 257, 5) !== "ustar") throw new Error(`the archive is damaged at byte ${at}`);
    if (isFile) files[name] = bytes.slice(at + 512, at + 512 + size);
    at += 512 * (1 + Math.ceil(size / 512));
  }
  return files;
}
/// A reader of such files, for takeCensus.
export const readerOf = (files, archive) => path => {
  if (!files[path]) throw new Error(`${archive}: no file ${path}`);
  return files[path];
};
