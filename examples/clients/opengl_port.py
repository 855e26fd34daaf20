"""The puddle's wave_step and display (corrected) as fragment shaders: opengl_port.py FLAT OUT [--es]. --es compiles them as GLSL ES 3.00.

Debian: python3-moderngl; LIBGL_ALWAYS_SOFTWARE=1 takes Mesa's llvmpipe. Blocks, records and images are what
`rainref describe puddle --layout glsl330 --pass PASS --variant corrected` prints, without its comments."""
import sys

import moderngl

import flat

HEAD = """
#ifdef GL_ES
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;
#endif
"""
TRIANGLE = "void main() { gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0); }"
WAVE_STEP = """
struct Drop { float x, y, amplitude, radius; };
layout(std140) uniform WaveStepUniforms {
  float damping, step, courant_sq; int drop_count; float rest, rim_damping, rim_inverse, padding_0; vec2 size; float padding_1, padding_2;
} u;
uniform sampler2D wave;
uniform usampler2D drops;
layout(location = 0) out vec4 wave_out;
Drop drops_at(int i) {
  uvec4 t = texelFetch(drops, ivec2(0, i), 0);
  return Drop(uintBitsToFloat(t.x), uintBitsToFloat(t.y), uintBitsToFloat(t.z), uintBitsToFloat(t.w));
}
// A texel of the wave; beyond its border, which OpenGL ES has no address mode for, the water is level.
vec2 wave_texel(ivec2 at) {
  ivec2 size = textureSize(wave, 0);
  if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) return vec2(u.rest);
  return texelFetch(wave, at, 0).xy;
}
float crater(Drop drop, vec2 here) {
  vec2 scaled = (here - vec2(drop.x, drop.y)) * (1.0 / drop.radius);
  float q2 = dot(scaled, scaled), rim = max(1.0 - q2, 0.0);
  return drop.amplitude * (rim * rim * (1.0 - 4.0 * q2));
}
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec2 stored = wave_texel(at), here = vec2(at) + 0.5;
  float newest = stored.x, previous = stored.y, rim = 1.0, craters = 0.0;
  float around = wave_texel(at - ivec2(1, 0)).x + wave_texel(at + ivec2(1, 0)).x + wave_texel(at - ivec2(0, 1)).x + wave_texel(at + ivec2(0, 1)).x;
  if (u.rim_damping > 0.0) {
    vec2 edge = min(here, u.size - here);
    float depth = max(1.0 - u.rim_inverse * min(edge.x, edge.y), 0.0);
    rim = 1.0 - u.rim_damping * (depth * depth);
    previous = u.rest + rim * (previous - u.rest);
  }
  for (int i = 0; i < u.drop_count; ++i) craters += crater(drops_at(i), here);
  float level = newest + u.damping * (newest - previous) + u.courant_sq * (around - 4.0 * newest) + craters;
  if (u.rim_damping > 0.0) level = u.rest + rim * (level - u.rest);
  wave_out = vec4(level, newest + craters, 0.0, 0.0);
}
"""
DISPLAY = """
layout(std140) uniform DisplayUniforms { float vignette, exposure, width, height; } u;
uniform sampler2D colour;
layout(location = 0) out vec4 picture;
vec3 encode_srgb(vec3 linear) {
  vec3 curve = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
  return mix(curve, 12.92 * linear, vec3(lessThanEqual(linear, vec3(0.0031308))));
}
void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec2 offset = (vec2(at) + 0.5) / vec2(u.width, u.height) - 0.5;
  float light = max(1.0 - u.vignette * length(offset), 0.0) * u.exposure;
  picture = vec4(encode_srgb(clamp(light * texelFetch(colour, at, 0).rgb, 0.0, 1.0)), 1.0);
}
"""
PASSES = {"wave_step": (WAVE_STEP, "WaveStepUniforms"), "display": (DISPLAY, "DisplayUniforms")}
KINDS = {"rg16f": (2, "f2"), "rgba16f": (4, "f2"), "rgba8": (4, "f1")}


def main(folder, out, *options):
    context = moderngl.create_context(standalone=True, backend="egl")
    context.disable_direct(0x0BD0)  # GL_DITHER, which is on by default
    version = "#version 300 es\n" if "--es" in options else "#version 330\n"
    programs = {}
    for name, (text, block) in PASSES.items():
        programs[name] = context.program(vertex_shader=version + TRIANGLE, fragment_shader=version + HEAD + text)
        programs[name][block].binding = 0

    def texture(entry):
        if entry["format"] == "records":  # a row for each record, an RGBA32UI texel for 16 bytes
            content = flat.data(folder, entry) or bytes(entry["struct_stride"])
            size = (entry["struct_stride"] // 16, len(content) // entry["struct_stride"])
            made = context.texture(size, 4, content, dtype="u4")
        else:
            channels, kind = KINDS[entry["format"]]
            made = context.texture((entry["width"], entry["height"]), channels, flat.data(folder, entry), dtype=kind, alignment=1)
        made.filter = moderngl.NEAREST, moderngl.NEAREST
        return made

    for case in flat.cases(folder, *PASSES):
        program, output = programs[case["pass"]], case["outputs"][0]
        block = context.buffer(flat.data(folder, case["uniforms"]))
        block.bind_to_uniform_block(0)
        channels, kind = KINDS[output["format"]]
        target = context.texture((output["width"], output["height"]), channels, dtype=kind, alignment=1)
        textures = [(texture(entry), entry["name"]) for entry in case["inputs"] if entry["name"] in program]
        for unit, (made, name) in enumerate(textures):
            made.use(unit)
            program[name].value = unit
        context.framebuffer([target]).use()
        context.vertex_array(program, []).render(moderngl.TRIANGLES, vertices=3)
        flat.save(out, output, target.read(alignment=1))
    about = context.info
    flat.describe(out, api=("OpenGL ES 3.0 on " if "--es" in options else "OpenGL ") + about["GL_VERSION"], device=about["GL_RENDERER"])


main(*sys.argv[1:])
