// Runs passes of a pack on a WebGPU device: the same in a page and in Node. README.md says how a shader is bound.
import {formatOf, texelBytes} from "./formats.js";
import {npyFile, recordType} from "./npy.js";
import {boundBuffers, factsOf, isRecords, levelsOf, recordOf} from "./pack.js";
import {countBytes, inputList, inputTexture, outputList, outputTexture, readList, readTexture, samplerFor, samplerType,
        uniformBuffer} from "./resources.js";
import {checkBindings, compile, declarationsOf, joined, samplerOf} from "./shader.js";

/// Records that there is room for in a list that a shader writes.
const capacity = 65536;

/// {device, name} of an adapter, with the feature that filters 32-bit floats where it has it.
export async function requestDevice(gpu) {
  const adapter = await gpu?.requestAdapter();
  if (!adapter) throw new Error("no WebGPU adapter");
  const device = await adapter.requestDevice({requiredFeatures: ["float32-filterable"].filter(f => adapter.features.has(f))});
  const {vendor, architecture, description} = adapter.info;
  return {device, name: [vendor, architecture, description].filter(word => word).join(" ") || "unknown"};
}

/// The files that running a case needs.
export function filesOf(oneCase) {
  const files = oneCase.inputs.flatMap(input => isRecords(input) ? [input.file] : levelsOf(input).map(level => level.file));
  return [oneCase.uniform_block.file, ...files];
}

/// Runs one case of `manifest` and gives [{file, bytes}]: its outputs as a port's folder holds them.
/// files: from a path in the pack to its bytes. shader: [{name, text}], WGSL that is joined in this order.
export async function runCase(device, manifest, oneCase, files, shader) {
  const bound = boundBuffers(manifest, oneCase), declared = declarationsOf(joined(shader)), made = [];
  checkBindings(declared, bound, isRecords);
  device.pushErrorScope("out-of-memory");
  device.pushErrorScope("validation");
  let outputs, failure;
  try {
    const module = await compile(device, shader);
    const binds = bind(device, manifest, oneCase, files, bound, declared, made);
    const facts = factsOf(bound), constants = {};
    for (const name of declared.overrides) if (Object.hasOwn(facts, name)) constants[name] = facts[name];
    const pipeline = await makePipeline(device, binds, declared, module, constants);
    const encoder = device.createCommandEncoder();
    record(device, encoder, pipeline, binds, declared);
    outputs = binds.outputs.map(output => ({...output, read: output.list ? readList(device, encoder, output.list, made)
                                                                         : readTexture(device, encoder, output.texture, output.buffer, made)}));
    device.queue.submit([encoder.finish()]);
  } catch (error) {
    failure = error;
  }
  // What was thrown, such as a line that does not compile, comes before what the device makes of it.
  const errors = [failure, await device.popErrorScope(), await device.popErrorScope()];
  failure = errors.find(error => error);
  if (failure) throw new Error(`${oneCase.id}: ${failure.message}`);
  const given = [];
  for (const output of outputs) given.push({file: output.buffer.file, bytes: fileOf(manifest, oneCase, output.buffer, await output.read())});
  for (const resource of made) resource.destroy();
  return given;
}

/// The bind group's layout and entries for what the shader declares, and the outputs: {buffer, list or texture}.
function bind(device, manifest, oneCase, files, bound, declared, made) {
  const visibility = declared.isCompute ? GPUShaderStage.COMPUTE : GPUShaderStage.FRAGMENT;
  const layout = [], entries = [], outputs = [];
  const add = (binding, kind, resource) => {
    layout.push({binding, visibility, ...kind});
    entries.push({binding, resource});
  };
  if (declared.bindings.has(0)) add(0, {buffer: {type: "uniform"}}, {buffer: uniformBuffer(device, files[oneCase.uniform_block.file], made)});
  for (const {binding, isOutput, buffer} of bound) {
    if (isOutput && isRecords(buffer)) {
      const list = outputList(device, recordOf(manifest, buffer).size, capacity, made);
      outputs.push({buffer, list});
      add(binding, {buffer: {type: "storage"}}, {buffer: list});
    } else if (isOutput) {
      const texture = outputTexture(device, buffer, declared.isCompute, made), format = formatOf(buffer);
      outputs.push({buffer, texture});
      if (!declared.isCompute) continue;
      if (!format.storage) throw new Error(`output ${buffer.name}: core WebGPU stores no ${format.gpu} from a @compute shader: write a @fragment shader`);
      add(binding, {storageTexture: {access: "write-only", format: format.gpu}}, texture.createView());
    } else if (declared.bindings.get(binding)?.kind === "read") {
      add(binding, {buffer: {type: "read-only-storage"}}, {buffer: inputList(device, manifest, buffer, files, made)});
    } else if (declared.bindings.has(binding)) {
      const isSampled = declared.bindings.has(samplerOf(binding));
      const sampleType = buffer && formatOf(buffer).isInteger ? "uint" : isSampled && samplerType(buffer) === "filtering" ? "float" : "unfilterable-float";
      add(binding, {texture: {sampleType}}, inputTexture(device, buffer, files, made).createView());
      if (isSampled) add(samplerOf(binding), {sampler: {type: samplerType(buffer)}}, samplerFor(device, buffer));
    }
  }
  checkLimits(device, layout, outputs, declared);
  const groupLayout = device.createBindGroupLayout({entries: layout});
  return {groupLayout, group: device.createBindGroup({layout: groupLayout, entries}), outputs};
}

function checkLimits(device, layout, outputs, declared) {
  const check = (count, limit, what) => {
    if (count > device.limits[limit]) throw new Error(`the shader has ${count} ${what}; this device has ${device.limits[limit]} (${limit})`);
  };
  check(layout.filter(e => e.storageTexture).length, "maxStorageTexturesPerShaderStage", "storage textures");
  check(layout.filter(e => e.texture).length, "maxSampledTexturesPerShaderStage", "sampled textures");
  check(layout.filter(e => e.sampler).length, "maxSamplersPerShaderStage", "samplers");
  check(layout.filter(e => e.buffer && e.buffer.type !== "uniform").length, "maxStorageBuffersPerShaderStage", "storage buffers");
  if (!declared.isCompute) check(outputs.length, "maxColorAttachments", "outputs");
  else check(declared.group[0] * declared.group[1], "maxComputeInvocationsPerWorkgroup", "invocations in a workgroup");
}

// A triangle that covers the image: one fragment for each texel, row 0 first.
const everyTexel = `@vertex fn main(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
  return vec4f(4.0 * f32(i & 1u) - 1.0, 4.0 * f32(i >> 1u) - 1.0, 0.0, 1.0);
}`;
function makePipeline(device, binds, declared, module, constants) {
  const layout = device.createPipelineLayout({bindGroupLayouts: [binds.groupLayout]}), stage = {module, entryPoint: "main", constants};
  if (declared.isCompute) return device.createComputePipelineAsync({layout, compute: stage});
  const vertex = {module: device.createShaderModule({code: everyTexel}), entryPoint: "main"};
  const targets = binds.outputs.map(output => ({format: formatOf(output.buffer).gpu}));
  return device.createRenderPipelineAsync({layout, vertex, fragment: {...stage, targets}, primitive: {topology: "triangle-list"}});
}

/// One fragment or invocation for each texel of the first output; one workgroup where that is a list.
function record(device, encoder, pipeline, binds, declared) {
  const first = binds.outputs[0].buffer, colour = output => ({view: output.texture.createView(), loadOp: "clear", storeOp: "store"});
  const pass = declared.isCompute ? encoder.beginComputePass() : encoder.beginRenderPass({colorAttachments: binds.outputs.map(colour)});
  pass.setPipeline(pipeline);
  pass.setBindGroup(0, binds.group);
  if (!declared.isCompute) pass.draw(3);
  else if (isRecords(first)) pass.dispatchWorkgroups(1);
  else pass.dispatchWorkgroups(Math.ceil(first.width / declared.group[0]), Math.ceil(first.height / declared.group[1]));
  pass.end();
}

/// An output's bytes, as read back, as a file of NumPy's.
function fileOf(manifest, oneCase, buffer, bytes) {
  if (!isRecords(buffer)) {
    const format = formatOf(buffer), shape = [buffer.height, buffer.width];
    return npyFile(`'${format.type}'`, format.channels > 1 ? [...shape, format.channels] : shape, bytes.subarray(0, buffer.height * buffer.width * texelBytes(format)));
  }
  const count = new DataView(bytes.buffer, bytes.byteOffset).getUint32(0, true), record = recordOf(manifest, buffer);
  if (count > capacity) throw new Error(`${oneCase.id}: the shader counts ${count} records of ${buffer.name}; there is room for ${capacity}`);
  return npyFile(recordType(record), [count], bytes.subarray(countBytes, countBytes + count * record.size));
}
