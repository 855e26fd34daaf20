"""The puddle's wave_step and display (corrected) in OpenCL C: opencl_port.py FLAT OUT. Debian: python3-pyopencl, pocl-opencl-icd."""
import sys

import numpy
import pyopencl as cl

import flat

SOURCE = """
typedef struct { float damping, step, courant_sq; int drop_count; float rest, rim_damping, rim_inverse, padding_0; float2 size, padding_1; } Wave;
typedef struct { float x, y, amplitude, radius; } Drop;
typedef struct { float vignette, exposure, width, height; } Display;

// A texel of the wave; beyond its border the water is level.
float2 texel(__global const half* wave, constant Wave* u, int x, int y, int2 size) {
  if (x < 0 || y < 0 || x >= size.x || y >= size.y) return (float2)(u->rest, u->rest);
  return vload_half2(y * size.x + x, wave);
}
float crater(Drop drop, float2 here) {
  float2 scaled = (here - (float2)(drop.x, drop.y)) * (1.0f / drop.radius);
  float q2 = scaled.x * scaled.x + scaled.y * scaled.y, rim = max(1.0f - q2, 0.0f);
  return drop.amplitude * (rim * rim * (1.0f - 4.0f * q2));
}
__kernel void wave_step(constant Wave* u, __global const half* wave, __global const Drop* drops, __global half* next) {
  int2 at = (int2)(get_global_id(0), get_global_id(1)), size = (int2)(get_global_size(0), get_global_size(1));
  float2 stored = texel(wave, u, at.x, at.y, size), here = convert_float2(at) + 0.5f;
  float newest = stored.x, previous = stored.y, rim = 1.0f, craters = 0.0f;
  float around = texel(wave, u, at.x - 1, at.y, size).x + texel(wave, u, at.x + 1, at.y, size).x
               + texel(wave, u, at.x, at.y - 1, size).x + texel(wave, u, at.x, at.y + 1, size).x;
  if (u->rim_damping > 0.0f) {
    float2 edge = min(here, u->size - here);
    float depth = max(1.0f - u->rim_inverse * min(edge.x, edge.y), 0.0f);
    rim = 1.0f - u->rim_damping * (depth * depth);
    previous = u->rest + rim * (previous - u->rest);
  }
  for (int i = 0; i < u->drop_count; ++i) craters += crater(drops[i], here);
  float level = newest + u->damping * (newest - previous) + u->courant_sq * (around - 4.0f * newest) + craters;
  if (u->rim_damping > 0.0f) level = u->rest + rim * (level - u->rest);
  vstore_half2((float2)(level, newest + craters), at.y * size.x + at.x, next);
}

float3 encode_srgb(float3 linear) {
  float3 curve = 1.055f * pow(linear, (float3)(1.0f / 2.4f)) - 0.055f;
  return select(curve, 12.92f * linear, linear <= 0.0031308f);
}
__kernel void display(constant Display* u, __global const half* colour, __global uchar4* picture) {
  int x = get_global_id(0), y = get_global_id(1), at = y * get_global_size(0) + x;
  float2 offset = ((float2)(x, y) + 0.5f) / (float2)(u->width, u->height) - 0.5f;
  float light = max(1.0f - u->vignette * sqrt(offset.x * offset.x + offset.y * offset.y), 0.0f) * u->exposure;
  float3 code = encode_srgb(clamp(light * vload_half4(at, colour).xyz, 0.0f, 1.0f));
  picture[at] = convert_uchar4_sat_rte((float4)(code, 1.0f) * 255.0f);
}
"""


def main(folder, out):
    context = cl.create_some_context(interactive=False)
    queue, program = cl.CommandQueue(context), cl.Program(context, SOURCE).build()
    device = context.devices[0]

    def given(content):
        content = content or bytes(16)  # an empty list
        return cl.Buffer(context, cl.mem_flags.READ_ONLY | cl.mem_flags.COPY_HOST_PTR, hostbuf=numpy.frombuffer(content, numpy.uint8))

    for case in flat.cases(folder, "wave_step", "display"):
        output = case["outputs"][0]
        kind, channels = flat.TYPES[output["format"]]
        result = numpy.empty((output["height"], output["width"], channels), kind)
        inputs = [flat.named(case, name) for name in (("wave", "drops") if case["pass"] == "wave_step" else ("colour",))]
        stored = cl.Buffer(context, cl.mem_flags.WRITE_ONLY, result.nbytes)
        getattr(program, case["pass"])(queue, (output["width"], output["height"]), None, given(flat.data(folder, case["uniforms"])),
                                       *[given(flat.data(folder, entry)) for entry in inputs], stored)
        cl.enqueue_copy(queue, result, stored)
        flat.save(out, output, result.tobytes())
    flat.describe(out, api=device.version, device=device.name.strip(), driver=device.driver_version, half_store="rne")


main(*sys.argv[1:3])
