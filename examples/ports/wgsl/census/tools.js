// What probes ask of a device: to evaluate an expression, to store, to load, to sample. tests/web has a device in JavaScript with the same
// four functions, whose habits are known.

const most = 65536;  // elements of one question: it fits every device's limits

/// The four functions on a GPUDevice, and `filtersFloats`: whether samplers filter 32-bit floats.
export function toolsOf(device) {
  const buffer = (size, usage) => device.createBuffer({size: Math.max(16, size), usage});
  const upload = data => {
    const made = buffer(data.byteLength, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST);
    device.queue.writeBuffer(made, 0, data);
    return made;
  };
  /// Asks for errors of what `make` does; gives what it gives, and destroys what it puts on `made`.
  const checked = async make => {
    const made = [];
    device.pushErrorScope("validation");
    let given, failure;
    try {
      given = await make(made);
    } catch (error) {
      failure = error;
    }
    const error = await device.popErrorScope();
    for (const resource of made) resource.destroy();
    if (error || failure) throw new Error((error ?? failure).message);
    return given;
  };
  const readBack = async (made, encoder, size, copy) => {
    const back = buffer(size, GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ);
    made.push(back);
    copy(back);
    device.queue.submit([encoder.finish()]);
    await back.mapAsync(GPUMapMode.READ);
    return back.getMappedRange().slice(0, size);
  };
  const groupOf = (pipeline, resources) => device.createBindGroup({
    layout: pipeline.getBindGroupLayout(0),
    entries: resources.map((resource, binding) => ({binding, resource: resource instanceof GPUBuffer ? {buffer: resource} : resource})),
  });
  const computePipeline = code => device.createComputePipelineAsync({layout: "auto", compute: {module: device.createShaderModule({code}), entryPoint: "main"}});
  const dispatch = (encoder, pipeline, resources, count) => {
    const pass = encoder.beginComputePass();
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, groupOf(pipeline, resources));
    pass.dispatchWorkgroups(Math.ceil(count / 64));
    pass.end();
  };
  /// Runs `code`, which reads what `resources` hold and writes `count` words to the last binding.
  const words = (code, resources, count, made) => {
    const found = buffer(4 * count, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC), encoder = device.createCommandEncoder();
    made.push(found, ...resources.filter(r => r instanceof GPUBuffer));
    return computePipeline(code).then(pipeline => {
      dispatch(encoder, pipeline, [...resources, found], count);
      return readBack(made, encoder, 4 * count, back => encoder.copyBufferToBuffer(found, 0, back, 0, 4 * count));
    }).then(bytes => new Uint32Array(bytes));
  };
  const textureOf = (format, bytesOfTexel, levels, made) => {
    const usage = GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST, {width, height} = levels[0];
    const texture = device.createTexture({size: [width, height], mipLevelCount: levels.length, format, usage});
    made.push(texture);
    levels.forEach(({width, height, data}, mipLevel) =>
      device.queue.writeTexture({texture, mipLevel}, data, {bytesPerRow: width * bytesOfTexel}, [width, height]));
    return texture;
  };

  return {
    filtersFloats: device.features.has("float32-filterable"),

    /// The bits of `expression` of a, b, c, d, which are given as bits: [[a, b, c, d], ...]. Nothing is known when the shader is compiled.
    evaluate(expression, rows) {
      if (rows.length > most) throw new Error(`${rows.length} rows; at most ${most}`);
      const given = new Uint32Array(4 * rows.length);
      rows.forEach((row, i) => given.set(row, 4 * i));
      const code = `@group(0) @binding(0) var<storage, read> given: array<vec4u>;
@group(0) @binding(1) var<storage, read_write> found: array<u32>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= ${rows.length}u) { return; }
  let row = bitcast<vec4f>(given[id.x]);
  let a = row.x; let b = row.y; let c = row.z; let d = row.w;
  found[id.x] = bitcast<u32>(${expression});
}`;
      return checked(made => words(code, [upload(given)], rows.length, made));
    },

    /// What an image of this format (rgba16float, rgba8unorm, rgba8unorm-srgb) holds of the values, as codes. how: "render", by a
    /// fragment shader, or "storage", by a compute shader.
    store(format, how, values) {
      const width = 256, height = Math.ceil(values.length / width), size = format === "rgba16float" ? 8 : 4, pitch = width * size;
      const use = how === "render" ? GPUTextureUsage.RENDER_ATTACHMENT : GPUTextureUsage.STORAGE_BINDING;
      const declared = `@group(0) @binding(0) var<storage, read> given: array<f32>;
fn value(x: u32, y: u32) -> vec4f { return vec4f(given[min(y * ${width}u + x, ${values.length - 1}u)]); }\n`;
      return checked(async made => {
        const texture = device.createTexture({size: [width, height], format, usage: use | GPUTextureUsage.COPY_SRC});
        const given = upload(Float32Array.from(values)), encoder = device.createCommandEncoder();
        made.push(texture, given);
        if (how === "render") {
          const module = device.createShaderModule({code: `${declared}
@vertex fn corner(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
  return vec4f(4.0 * f32(i & 1u) - 1.0, 4.0 * f32(i >> 1u) - 1.0, 0.0, 1.0);
}
@fragment fn main(@builtin(position) p: vec4f) -> @location(0) vec4f { return value(u32(p.x), u32(p.y)); }`});
          const pipeline = await device.createRenderPipelineAsync({
            layout: "auto", vertex: {module, entryPoint: "corner"}, fragment: {module, entryPoint: "main", targets: [{format}]}});
          const pass = encoder.beginRenderPass({colorAttachments: [{view: texture.createView(), loadOp: "clear", storeOp: "store"}]});
          pass.setPipeline(pipeline);
          pass.setBindGroup(0, groupOf(pipeline, [given]));
          pass.draw(3);
          pass.end();
        } else {
          const pipeline = await computePipeline(`${declared}@group(0) @binding(1) var image: texture_storage_2d<${format}, write>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  let p = vec2u(id.x % ${width}u, id.x / ${width}u);
  if (p.y < ${height}u) { textureStore(image, p, value(p.x, p.y)); }
}`);
          dispatch(encoder, pipeline, [given, texture.createView()], width * height);
        }
        const bytes = await readBack(made, encoder, pitch * height, back =>
          encoder.copyTextureToBuffer({texture}, {buffer: back, bytesPerRow: pitch}, [width, height]));
        const codes = size === 8 ? new Uint16Array(bytes) : new Uint8Array(bytes);
        return Array.from(values, (_, i) => codes[4 * i]);
      });
    },

    /// The bits of floats that a shader loads from an image (r16float, r8unorm) of these codes.
    load(format, codes) {
      const width = 256, height = Math.ceil(codes.length / width), size = format === "r16float" ? 2 : 1;
      const data = size === 2 ? new Uint16Array(width * height) : new Uint8Array(width * height);
      data.set(codes);
      const code = `@group(0) @binding(0) var image: texture_2d<f32>;
@group(0) @binding(1) var<storage, read_write> found: array<u32>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x < ${codes.length}u) { found[id.x] = bitcast<u32>(textureLoad(image, vec2u(id.x % ${width}u, id.x / ${width}u), 0).x); }
}`;
      return checked(made => words(code, [textureOf(format, size, [{width, height, data}], made).createView()], codes.length, made));
    },

    /// What textureSampleLevel gives with linear filters. levels: [{width, height, texels}], texels 0 or 1 each; coordinates: [[u, v,
    /// level], ...]. format: r16float, r32float.
    sample(format, levels, coordinates) {
      const isHalf = format === "r16float", ofTexels = texels => isHalf ? Uint16Array.from(texels, x => x ? 0x3c00 : 0) : Float32Array.from(texels);
      const given = new Float32Array(4 * coordinates.length);
      coordinates.forEach((place, i) => given.set(place, 4 * i));
      const code = `@group(0) @binding(0) var image: texture_2d<f32>;
@group(0) @binding(1) var linear: sampler;
@group(0) @binding(2) var<storage, read> given: array<vec4f>;
@group(0) @binding(3) var<storage, read_write> found: array<u32>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= ${coordinates.length}u) { return; }
  let place = given[id.x];
  found[id.x] = bitcast<u32>(textureSampleLevel(image, linear, place.xy, place.z).x);
}`;
      return checked(async made => {
        const texture = textureOf(format, isHalf ? 2 : 4, levels.map(level => ({...level, data: ofTexels(level.texels)})), made);
        const sampler = device.createSampler({magFilter: "linear", minFilter: "linear", mipmapFilter: "linear"});
        return new Float32Array((await words(code, [texture.createView(), sampler, upload(given)], coordinates.length, made)).buffer);
      });
    },
  };
}
