// Texels of a buffer as numbers and as pixels. Types are those of rr_type.
const unorm8 = 1, srgb8 = 2, float16 = 3, float32 = 4, uint32 = 5;

/// Each channel's value: 8 bits as code / 255.
export function channelsOf(bytes, type) {
  if (type === unorm8 || type === srgb8) return Float32Array.from(bytes, code => code / 255);
  const {buffer, byteOffset, length} = bytes.slice();
  if (type === float32) return new Float32Array(buffer, byteOffset, length / 4);
  if (type === uint32) return Float32Array.from(new Uint32Array(buffer, byteOffset, length / 4));
  if (type === float16) return Float32Array.from(new Uint16Array(buffer, byteOffset, length / 2), halfValue);
  throw new Error(`texels of type ${type}`);
}
/// The value of a binary16.
export function halfValue(bits) {
  const sign = bits & 0x8000 ? -1 : 1, exponent = bits >> 10 & 31, fraction = bits & 1023;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (exponent === 0 ? fraction * 2 ** -24 : (1 + fraction / 1024) * 2 ** (exponent - 15));
}

/// How many elements of `size` bytes are not the same in both.
export function differingOf(a, b, size) {
  const common = Math.min(a.length, b.length) / size;
  let count = Math.abs(a.length - b.length) / size;
  for (let k = 0; k < common; ++k) {
    let same = true;
    for (let byte = k * size; byte < (k + 1) * size; ++byte) same &&= a[byte] === b[byte];
    if (!same) ++count;
  }
  return count;
}

/// RGBA, top row first, of values from `low` (black) to `high`; one channel is grey, two are red and green.
export const pixelsOf = (values, channels, width, height, [low, high]) =>
  pixels(channels, width, height, at => 255 * (values[at] - low) / (high - low || 1));
/// |a - b| times `gain`; NaN in one of them alone is white.
export const differenceOf = (a, b, channels, width, height, gain) => pixels(channels, width, height, at => {
  const difference = Math.abs(a[at] - b[at]);
  return Object.is(a[at], b[at]) || difference === 0 ? 0 : Number.isNaN(difference) ? 255 : 255 * gain * difference;
});

function pixels(channels, width, height, code) {
  const all = new Uint8ClampedArray(4 * width * height), shown = Math.min(3, channels);
  for (let y = 0, to = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x, to += 4) {
      const at = ((height - 1 - y) * width + x) * channels;  // a buffer's row 0 is the bottom one
      for (let c = 0; c < shown; ++c) all[to + c] = code(at + c);
      if (shown === 1) all[to + 1] = all[to + 2] = all[to];
      all[to + 3] = 255;
    }
  }
  return all;
}
