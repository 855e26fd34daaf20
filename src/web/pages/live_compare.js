// The example port of a pass on this GPU beside the reference, in the same frame.
import {runCase, filesOf, requestDevice} from "./ports/port.js";
import {shaderOf} from "./ports/run_pack.js";
import {npyData} from "./ports/npy.js";
import {formatOf, texelBytes} from "./ports/formats.js";

let gpu = null;
const json = async path => {
  const answer = await fetch(path);
  if (!answer.ok) throw new Error(`${path}: ${answer.status} ${answer.statusText}`);
  return answer.json();
};

/// The passes of a variant that have a port: [{name, sentence, formula, reads, writes, usual}], in their order; not `usual` are those that only
/// special scenes run.
export async function passesOf(effect, variant) {
  const [{packs}, {programs}] = await Promise.all([json("packs/index.json"), json(`ports/${effect}/programs.json`)]), found = new Map();
  for (const pack of packs.filter(p => p.effect === effect && p.variant === variant))
    for (const pass of pack.passes) if (programs[pass.formula] && !found.has(pass.name)) 
        found.set(pass.name, {...pass, program: programs[pass.formula], usual: pack.name === `${effect}-${variant}`});
  return [...found.values()];
}

/// Runs the port of `pass` on a case (live_cases.js). Gives {device, milliseconds, outputs: [{name, format, width, height, expected, given}]} with
/// the numbers of images, row 0 the bottom one; lists are left out.
export async function runPort(effect, pass, given) {
  gpu ??= await requestDevice(navigator.gpu);
  const manifest = {effect, passes: [pass], records: given.records};
  const shader = await shaderOf(pass.program, effect, async path => {
    const answer = await fetch(`ports/${path}`);
    if (!answer.ok) throw new Error(`ports/${path}: ${answer.status} ${answer.statusText}`);
    return new Uint8Array(await answer.arrayBuffer());
  });
  const files = Object.fromEntries(filesOf(given.case).map(file => [file, given.files[file]])), begin = performance.now();
  const done = await runCase(gpu.device, manifest, given.case, files, shader), milliseconds = performance.now() - begin, outputs = [];
  for (const output of given.case.outputs) {
    if (output.format === "records") continue;
    const format = formatOf(output), {file, name, width, height} = output;
    const data = npyData(done.find(d => d.file === file).bytes, width * height * texelBytes(format), file);
    outputs.push({name, format, width, height, expected: numbers(format, given.expected[name]), given: numbers(format, data)});
  }
  return {device: gpu.name, milliseconds, outputs};
}

/// The numbers that an image's bytes stand for; codes of 8 bits in [0, 1].
function numbers(format, bytes) {
  const whole = bytes.slice();  // aligned
  if (format.type === "|u1") return Float32Array.from(whole, code => code / 255);
  if (format.type === "<f4") return new Float32Array(whole.buffer);
  if (format.type === "<u4") return Float32Array.from(new Uint32Array(whole.buffer));
  return Float32Array.from(new Uint16Array(whole.buffer), half);
}
function half(bits) {
  const sign = bits & 0x8000 ? -1 : 1, exponent = bits >> 10 & 31, fraction = bits & 1023;
  if (exponent === 0) return sign * fraction * 2 ** -24;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (1024 + fraction) * 2 ** (exponent - 25);
}

/// {texels, differ, most}: how many there are, how many have another value in some channel, and the largest distance of two numbers.
export function difference({format, width, height, expected, given}) {
  let differ = 0, most = 0;
  for (let i = 0; i < width * height; ++i) {
    let other = false;
    for (let c = 0; c < format.channels; ++c) {
      const a = expected[i * format.channels + c], b = given[i * format.channels + c];
      if (Object.is(a, b) || a === b) continue;
      other = true;
      most = Math.max(most, Math.abs(a - b));
    }
    differ += other;
  }
  return {texels: width * height, differ, most};
}

/// Draws numbers: one channel as grey, two as red and green; shade(number) is 1 where the screen is brightest.
export function draw(canvas, {format, width, height}, values, shade) {
  canvas.width = width;
  canvas.height = height;
  const image = new ImageData(width, height), channels = format.channels;
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const from = (y * width + x) * channels, to = 4 * ((height - 1 - y) * width + x);
      for (let c = 0; c < 3; ++c) image.data[to + c] = channels === 1 ? 255 * shade(values[from]) : c < channels ? 255 * shade(values[from + c]) : 0;
      image.data[to + 3] = 255;
    }
  }
  canvas.getContext("2d").putImageData(image, 0, 0);
}
/// 1 at every texel with a distance other than 0 and at those around it, so that a single one is seen.
export function spread({format, width, height}, distances) {
  const shown = new Float32Array(width * height);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const first = (y * width + x) * format.channels;
      if (!distances.subarray(first, first + format.channels).some(d => d !== 0)) continue;
      for (let j = Math.max(0, y - 1); j <= Math.min(height - 1, y + 1); ++j)
        for (let i = Math.max(0, x - 1); i <= Math.min(width - 1, x + 1); ++i) shown[j * width + i] = 1;
    }
  }
  return shown;
}
/// What brings all but the largest 200th of the numbers below 1.
export function brightness(values) {
  const sizes = values.filter(Number.isFinite).map(Math.abs).sort();
  return 1 / (sizes[Math.floor(0.995 * (sizes.length - 1))] || sizes[sizes.length - 1] || 1);
}
