// What a device does with a value between two codes of an image, and with subnormal halves.
import {bitsOf, decodeSrgb, drawing, encodeSrgb, fromBits, gapAt, halfValue} from "./floats.js";

/// Of a value between the halves h and h + 1 (magnitudes), with the share `part` of the way: whether the second one is stored.
const roundings = {
  "to nearest, ties to even": ({part, h}) => part > 0.5 || (part === 0.5 && h % 2 === 1),
  "toward zero": () => false,
  "to nearest, ties away from zero": ({part}) => part >= 0.5,
  "to nearest, ties toward zero": ({part}) => part > 0.5,
  "away from zero": () => true,
  "up": ({negative}) => !negative,
  "down": ({negative}) => negative,
};

function halfSamples() {
  const draw = drawing(11), samples = [], parts = [1 / 8, 1 / 4, 3 / 8, 0.5 - 2 ** -10, 0.5, 0.5 + 2 ** -10, 5 / 8, 3 / 4, 7 / 8];
  for (let i = 0; i < 4096; ++i) {
    const h = 0x0400 + Math.floor(draw() * (0x7bff - 0x0400)), part = parts[i % parts.length], negative = draw() < 0.5;
    const value = halfValue(h) + part * (halfValue(h + 1) - halfValue(h));
    samples.push({h, part, negative, value: negative ? -value : value});
  }
  return samples;
}
/// "kept", "flushed to zero", or how many of them were kept.
export function kept(found, expected) {
  const same = found.filter((x, i) => x === expected[i]).length, zeros = found.filter(x => (x & 0x7fffffff) === 0 || x === 0x8000).length;
  if (same === found.length) return "kept";
  return zeros === found.length ? "flushed to zero" : `${same} of ${found.length} kept, ${zeros} flushed to zero`;
}

/// What halves of these bits are, beside the largest one.
function overflowOf(codes) {
  const words = code => (code & 0x7fff) > 0x7c00 ? "NaN" : (code & 0x7fff) === 0x7c00 ? "infinity" : (code & 0x7fff) === 0x7bff ? "the largest half" : "another half";
  return [...new Set(codes.map(words))].join(" or ");
}
/// How halves are made: {rounding, overflow, beyond, subnormals}; overflow: of what is below 2^16, beyond: of larger ones.
/// store(values) gives the bits of halves.
async function halves(store) {
  const samples = halfSamples(), above = [65520, 65528, 65535], beyond = [65536, 65600, 131072, 1e6, 1e20], small = Array.from({length: 1023}, (_, i) => i + 1);
  const codes = await store([...samples.map(s => s.value), ...above, ...above.map(x => -x), ...beyond, ...beyond.map(x => -x),
                             ...small.map(k => k * 2 ** -24)]);
  let read = samples.length;
  const next = length => codes.slice(read, read += length);
  const isRule = rule => samples.every((s, i) => (codes[i] & 0x7fff) === s.h + (rule(s) ? 1 : 0) && codes[i] >> 15 === (s.negative ? 1 : 0));
  const agree = rule => samples.filter((s, i) => (codes[i] & 0x7fff) === s.h + (rule(s) ? 1 : 0)).length;
  const rounding = Object.keys(roundings).find(name => isRule(roundings[name])) ??
    `by no rule: ${agree(roundings["to nearest, ties to even"])} of ${samples.length} to nearest, ${agree(roundings["toward zero"])} toward zero`;
  return {rounding, overflow: overflowOf(next(2 * above.length)), beyond: overflowOf(next(2 * beyond.length)), subnormals: kept(next(small.length), small)};
}

/// Stores to halves: by a render target, by a storage image, and pack2x16float.
export async function halfStores(tools) {
  const packed = async values => Array.from(await tools.evaluate("pack2x16float(vec2f(a, b))", values.map(x => [bitsOf(x), 0, 0, 0])), word => word & 0xffff);
  return {
    render: await halves(values => tools.store("rgba16float", "render", values)),
    storage: await halves(values => tools.store("rgba16float", "storage", values)),
    pack2x16float: await halves(packed),
  };
}

/// Values around the middle between neighbouring codes of 8 bits, where decode(code / 255) is the value of a code.
function codeSamples(decode) {
  const values = [];
  for (let k = 0; k < 255; ++k) {
    for (let i = 2; i < 15; ++i)
      for (const side of [-1, 1]) values.push(Math.fround(decode((k + 0.5 + side * 2 ** -i) / 255)));
    values.push(Math.fround(decode((k + 0.5) / 255)));
  }
  return values;
}
/// The furthest stored code from the exact one [codes], and what 0.5 is stored as.
async function codes8(store, encode, decode) {
  const values = codeSamples(decode), codes = await store([...values, 0.5]);
  let furthest = 0, at = 0;
  values.forEach((value, i) => {
    const distance = Math.abs(codes[i] - 255 * encode(value));
    if (distance > furthest) [furthest, at] = [distance, value];
  });
  return {furthest: Number(furthest.toPrecision(9)), at, half: codes[values.length]};
}
/// Stores to 8 bits: `furthest` is 0.5 of a device that rounds to nearest, and nearly 1 of one that cuts.
export async function unormStores(tools) {
  const same = x => x;
  return {
    render: await codes8(values => tools.store("rgba8unorm", "render", values), same, same),
    storage: await codes8(values => tools.store("rgba8unorm", "storage", values), same, same),
  };
}
export const srgbStores = async tools => ({render: await codes8(values => tools.store("rgba8unorm-srgb", "render", values), encodeSrgb, decodeSrgb)});

/// How a code of 8 bits may become a float.
const unormRules = {"the nearest float": k => Math.fround(k / 255), "code * (1 / 255) in floats": k => Math.fround(k * Math.fround(1 / 255))};
/// Loads: subnormal halves from images and by unpack2x16float, and codes of 8 bits.
export async function loads(tools) {
  const small = Array.from({length: 1023}, (_, i) => i + 1), exact = small.map(k => bitsOf(k * 2 ** -24));
  const unpacked = await tools.evaluate("unpack2x16float(bitcast<u32>(a)).x", small.map(k => [k, 0, 0, 0]));
  const codes = Array.from({length: 256}, (_, k) => k), unorm = await tools.load("r8unorm", codes);
  return {
    half_subnormals: kept(Array.from(await tools.load("r16float", small)), exact),
    unpack2x16float_subnormals: kept(Array.from(unpacked), exact),
    unorm8: Object.keys(unormRules).find(name => codes.every(k => fromBits(unorm[k]) === unormRules[name](k))) ?? "by no rule",
    unorm8_ulp: Math.max(...codes.map(k => Math.abs(fromBits(unorm[k]) - Math.fround(k / 255)) / gapAt(Math.fround(k / 255)))),
  };
}
