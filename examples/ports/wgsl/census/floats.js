// Floats and halves as bits, for probes that say what a device made of them.

const words = new Uint32Array(1), floats = new Float32Array(words.buffer), wide = new DataView(new ArrayBuffer(8));

/// The bits of a number as a 32-bit float, and back.
export const bitsOf = x => (floats[0] = x, words[0]);
export const fromBits = bits => (words[0] = bits, floats[0]);
export const isNumber = bits => (bits & 0x7fffffff) <= 0x7f800000;

/// The exponent of a number that is not 0: floor(log2 |x|), exactly.
export function exponentOf(x) {
  wide.setFloat64(0, x);
  return (wide.getUint16(0) >> 4 & 0x7ff) - 1023;
}
/// The gap between the 32-bit floats around y; the larger one at a power of two.
export const gapAt = y => y === 0 ? 2 ** -149 : 2 ** (Math.max(exponentOf(y), -126) - 23);

/// a b + c rounded once. The product is exact in a double; a sum that is not is made odd, so that the second rounding is the only one.
export function fused(a, b, c) {
  const product = a * b, sum = product + c, part = sum - product, rest = (product - (sum - part)) + (c - part);
  if (rest === 0 || !Number.isFinite(sum)) return Math.fround(sum);
  wide.setFloat64(0, sum);
  const bits = wide.getBigInt64(0), isUp = (rest > 0) === (sum > 0);
  if ((bits & 1n) === 0n) wide.setBigInt64(0, bits + (isUp ? 1n : -1n));
  return Math.fround(wide.getFloat64(0));
}

/// The value of a half's bits.
export function halfValue(bits) {
  const sign = bits & 0x8000 ? -1 : 1, exponent = bits >> 10 & 31, mantissa = bits & 1023;
  if (exponent === 31) return mantissa ? NaN : sign * Infinity;
  return sign * (exponent ? (1024 + mantissa) * 2 ** (exponent - 25) : mantissa * 2 ** -24);
}

export const encodeSrgb = x => x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055;
export const decodeSrgb = x => x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4;

/// Numbers in [0, 1), the same ones each time.
export function drawing(seed) {
  let state = seed >>> 0;
  return () => {
    state = Math.imul(state, 1664525) + 1013904223 >>> 0;
    let mixed = Math.imul(state ^ state >>> 16, 0x45d9f3b);
    mixed ^= mixed >>> 15;
    return (mixed >>> 0) / 2 ** 32;
  };
}
/// A float with a random mantissa, sign as asked for, and an exponent in [low, high).
export const drawFloat = (draw, low, high, signed = false) =>
  Math.fround((signed && draw() < 0.5 ? -1 : 1) * (1 + Math.floor(draw() * 2 ** 23) / 2 ** 23) * 2 ** Math.floor(low + draw() * (high - low)));
