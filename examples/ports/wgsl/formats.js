// The storage formats of a pack, as WebGPU has them.

/// Of each format: WebGPU's name, channels, bytes of a channel, the NumPy type of a channel; `float32`: a sampler filters it only
/// with the feature float32-filterable; `storage`: a compute shader may write it in core WebGPU.
const formats = {
  r8: {gpu: "r8unorm", channels: 1, bytes: 1, type: "|u1"},
  rg8: {gpu: "rg8unorm", channels: 2, bytes: 1, type: "|u1"},
  rgba8: {gpu: "rgba8unorm", channels: 4, bytes: 1, type: "|u1", storage: true},
  rgba8_srgb: {gpu: "rgba8unorm-srgb", channels: 4, bytes: 1, type: "|u1"},
  r16f: {gpu: "r16float", channels: 1, bytes: 2, type: "<f2"},
  rg16f: {gpu: "rg16float", channels: 2, bytes: 2, type: "<f2"},
  rgba16f: {gpu: "rgba16float", channels: 4, bytes: 2, type: "<f2", storage: true},
  r32f: {gpu: "r32float", channels: 1, bytes: 4, type: "<f4", storage: true, float32: true},
  rg32f: {gpu: "rg32float", channels: 2, bytes: 4, type: "<f4", storage: true, float32: true},
  rgba32f: {gpu: "rgba32float", channels: 4, bytes: 4, type: "<f4", storage: true, float32: true},
  r32ui: {gpu: "r32uint", channels: 1, bytes: 4, type: "<u4", storage: true, isInteger: true},
};

/// The format of a buffer of the manifest; throws where it is not known.
export function formatOf(buffer) {
  const format = formats[buffer.format];
  if (!format) throw new Error(`buffer ${buffer.name}: unknown format ${buffer.format}`);
  return format;
}
export const texelBytes = format => format.channels * format.bytes;
