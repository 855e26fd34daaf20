// A WebM file (Matroska) of one film without sound, from the chunks that WebCodecs gives: RFC 9559. Every chunk is a frame; a tick of time is the
// time of a frame, so no time is rounded.

/// An element: its id, and its content: bytes, or elements. Its size takes eight bytes, so that positions are known before all is written.
function made(id, ...content) {
  const bytes = [], size = content.reduce((sum, part) => sum + part.length, 0);
  for (let shift = 24; shift >= 0; shift -= 8) if (id >= 2 ** shift) bytes.push(Math.floor(id / 2 ** shift) & 255);
  const head = new Uint8Array(bytes.length + 8);
  head.set(bytes);
  new DataView(head.buffer).setBigUint64(bytes.length, (1n << 56n) | BigInt(size));
  return joined([head, ...content]);
}
function joined(parts) {
  const all = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
  parts.reduce((at, part) => (all.set(part, at), at + part.length), 0);
  return all;
}
const number = value => {  // always of eight bytes, which readers accept
  const bytes = new Uint8Array(8);
  new DataView(bytes.buffer).setBigUint64(0, BigInt(value));
  return bytes;
};
const real = value => {
  const bytes = new Uint8Array(8);
  new DataView(bytes.buffer).setFloat64(0, value);
  return bytes;
};
const text = value => new TextEncoder().encode(value);

// Numbers of ITU-T H.273 for the names that WebCodecs has.
const primaries = {bt709: 1, bt470bg: 5, smpte170m: 6, bt2020: 9}, transfers = {bt709: 1, smpte170m: 6, linear: 8, "iec61966-2-1": 13};
const matrices = {rgb: 0, bt709: 1, bt470bg: 5, smpte170m: 6, "bt2020-ncl": 9};
function colourOf({primaries: p, transfer: t, matrix: m, fullRange}) {
  const parts = [];
  if (m in matrices) parts.push(made(0x55B1, number(matrices[m])));
  if (typeof fullRange === "boolean") parts.push(made(0x55B9, number(fullRange ? 2 : 1)));
  if (t in transfers) parts.push(made(0x55BA, number(transfers[t])));
  if (p in primaries) parts.push(made(0x55BB, number(primaries[p])));
  return made(0x55B0, ...parts);
}

/// chunks: [{isKey, bytes}], the first of them a key frame; codec: "V_VP9" or "V_VP8"; colour: the decoder's colorSpace, or null.
export function webmOf({chunks, codec, width, height, fps, colour}) {
  const tick = Math.round(1e9 / fps), longest = 30000;  // a block's time has 16 bits with a sign
  const head = made(0x1A45DFA3, made(0x4286, number(1)), made(0x42F7, number(1)), made(0x42F2, number(4)), made(0x42F3, number(8)),
    made(0x4282, text("webm")), made(0x4287, number(4)), made(0x4285, number(2)));
  const info = made(0x1549A966, made(0x2AD7B1, number(tick)), made(0x4489, real(chunks.length)), made(0x4D80, text("rainref")), made(0x5741, text("rainref")));
  const video = made(0xE0, made(0xB0, number(width)), made(0xBA, number(height)), ...(colour ? [colourOf(colour)] : []));
  const tracks = made(0x1654AE6B, made(0xAE, made(0xD7, number(1)), made(0x73C5, number(1)), made(0x83, number(1)), made(0x9C, number(0)),
    made(0x23E383, number(tick)), made(0x86, text(codec)), video));

  // A cluster begins at each key frame.
  const clusters = [];
  chunks.forEach(({isKey, bytes}, frame) => {
    if (isKey || frame - clusters[clusters.length - 1].first >= longest) clusters.push({first: frame, isKey, blocks: []});
    const cluster = clusters[clusters.length - 1], since = frame - cluster.first;
    cluster.blocks.push(made(0xA3, new Uint8Array([0x81, since >> 8, since & 255, isKey ? 0x80 : 0]), bytes));
  });
  const written = clusters.map(({first, blocks}) => made(0x1F43B675, made(0xE7, number(first)), ...blocks));
  // For jumps: where each cluster lies. Numbers have one length, so the cues' length does not depend on what they say.
  const cues = at => made(0x1C53BB6B, ...clusters.map(({first}, k) =>
    made(0xBB, made(0xB3, number(first)), made(0xB7, made(0xF7, number(1)), made(0xF1, number(at[k]))))));
  let at = info.length + tracks.length + cues(clusters.map(() => 0)).length;
  const places = written.map(cluster => {
    const place = at;
    at += cluster.length;
    return place;
  });
  return joined([head, made(0x18538067, info, tracks, cues(places), ...written)]);
}
