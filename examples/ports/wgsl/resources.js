// What a case binds, on a WebGPU device. Everything made is put on `made`, to be destroyed after the run.
import {formatOf, texelBytes} from "./formats.js";
import {npyData} from "./npy.js";
import {isRecords, levelsOf, recordOf} from "./pack.js";

/// Bytes before the first record of a list that a shader writes: the count, and padding.
export const countBytes = 16;

function keep(made, resource) {
  made.push(resource);
  return resource;
}
function storageBuffer(device, size, usage, made) {
  if (size > device.limits.maxStorageBufferBindingSize) throw new Error(`a list of ${size} bytes is larger than this device binds`);
  return keep(made, device.createBuffer({size, usage: GPUBufferUsage.STORAGE | usage}));
}

/// The uniform block, as its file has it.
export function uniformBuffer(device, bytes, made) {
  const buffer = keep(made, device.createBuffer({size: bytes.length, usage: GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST}));
  device.queue.writeBuffer(buffer, 0, bytes);
  return buffer;
}

/// An input's records, one behind the other. A list without records, or that the case lacks, is one record of zeros.
export function inputList(device, manifest, buffer, files, made) {
  const none = buffer === null, size = none ? 256 : recordOf(manifest, buffer).size;
  const data = none ? new Uint8Array() : npyData(files[buffer.file], size * buffer.count, buffer.file);
  const list = storageBuffer(device, Math.max(data.length, size), GPUBufferUsage.COPY_DST, made);
  if (data.length > 0) device.queue.writeBuffer(list, 0, data);
  return list;
}
/// Room for `capacity` records behind their count; zeros.
export const outputList = (device, size, capacity, made) => storageBuffer(device, countBytes + size * capacity, GPUBufferUsage.COPY_SRC, made);

function checkSize(device, buffer) {
  const most = device.limits.maxTextureDimension2D;
  if (buffer.width > most || buffer.height > most)
    throw new Error(`buffer ${buffer.name}: ${buffer.width} x ${buffer.height} texels; this device has at most ${most}`);
}
/// An input's image with all its levels. An image that the case lacks is one texel of zeros.
export function inputTexture(device, buffer, files, made) {
  const usage = GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST;
  if (buffer === null) return keep(made, device.createTexture({size: [1, 1], format: "rgba8unorm", usage}));
  checkSize(device, buffer);
  const format = formatOf(buffer), levels = levelsOf(buffer);
  const texture = keep(made, device.createTexture({size: [buffer.width, buffer.height], mipLevelCount: levels.length, format: format.gpu, usage}));
  levels.forEach((level, mipLevel) => {
    const bytesPerRow = level.width * texelBytes(format);
    const data = npyData(files[level.file], bytesPerRow * level.height, level.file);
    device.queue.writeTexture({texture, mipLevel}, data, {bytesPerRow}, [level.width, level.height]);
  });
  return texture;
}
/// An image for an output, zeros.
export function outputTexture(device, buffer, isCompute, made) {
  checkSize(device, buffer);
  const use = isCompute ? GPUTextureUsage.STORAGE_BINDING : GPUTextureUsage.RENDER_ATTACHMENT;
  return keep(made, device.createTexture({size: [buffer.width, buffer.height], format: formatOf(buffer).gpu, usage: use | GPUTextureUsage.COPY_SRC}));
}

/// How a sampler of this input filters: "filtering" or "non-filtering".
export const samplerType = buffer => buffer?.min_filter === "linear" ? "filtering" : "non-filtering";
/// The manifest's sampler; throws where WebGPU, or this device, has none such.
export function samplerFor(device, buffer) {
  if (buffer === null) return device.createSampler();
  const modes = {clamp: "clamp-to-edge", repeat: "repeat", mirror: "mirror-repeat"};
  const mode = address => {
    if (modes[address]) return modes[address];
    throw new Error(`input ${buffer.name}: no sampler of WebGPU has the address mode ${address}: load its texels, and ask for override ${buffer.name}_border`);
  };
  if (samplerType(buffer) === "filtering" && formatOf(buffer).float32 && !device.features.has("float32-filterable"))
    throw new Error(`input ${buffer.name}: this device does not filter ${buffer.format} (no float32-filterable): load its texels and blend them`);
  const filter = buffer.min_filter === "linear" ? "linear" : "nearest";
  return device.createSampler({
    addressModeU: mode(buffer.address_u), addressModeV: mode(buffer.address_v), magFilter: filter, minFilter: filter,
    mipmapFilter: buffer.mip_filter === "linear" ? "linear" : "nearest",
  });
}

/// A function that, called after the queue was submitted, gives the bytes of `texture`, rows without padding.
export function readTexture(device, encoder, texture, buffer, made) {
  const row = buffer.width * texelBytes(formatOf(buffer)), pitch = Math.ceil(row / 256) * 256;  // of a copy
  const back = keep(made, device.createBuffer({size: pitch * buffer.height, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ}));
  encoder.copyTextureToBuffer({texture}, {buffer: back, bytesPerRow: pitch}, [buffer.width, buffer.height]);
  return async () => {
    await back.mapAsync(GPUMapMode.READ);
    const from = new Uint8Array(back.getMappedRange()), bytes = new Uint8Array(row * buffer.height);
    for (let y = 0; y < buffer.height; ++y) bytes.set(from.subarray(y * pitch, y * pitch + row), y * row);
    back.unmap();
    return bytes;
  };
}
/// The same for a list: its bytes, the count first.
export function readList(device, encoder, list, made) {
  const back = keep(made, device.createBuffer({size: list.size, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ}));
  encoder.copyBufferToBuffer(list, 0, back, 0, list.size);
  return async () => {
    await back.mapAsync(GPUMapMode.READ);
    const bytes = new Uint8Array(back.getMappedRange()).slice();
    back.unmap();
    return bytes;
  };
}
