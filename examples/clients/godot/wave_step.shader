shader_type canvas_item;
render_mode unshaded, blend_disabled;
// From `rainref describe puddle --layout gdshader --pass wave_step --variant corrected`, without its comments.
uniform float damping;
uniform float courant_sq;
uniform int drop_count;
uniform float rest;
uniform float rim_damping;
uniform float rim_inverse;
uniform vec2 size;
uniform sampler2D wave;
uniform sampler2D drops;

// A texel of the wave; beyond its border, which Godot has no address mode for, the water is level.
vec2 wave_texel(ivec2 at, float level, ivec2 whole) {
	if (at.x < 0 || at.y < 0 || at.x >= whole.x || at.y >= whole.y) { return vec2(level); }
	return texelFetch(wave, at, 0).xy;
}
float crater(vec4 drop, vec2 here) {
	vec2 scaled = (here - drop.xy) * (1.0 / drop.w);
	float q2 = dot(scaled, scaled);
	float rim = max(1.0 - q2, 0.0);
	return drop.z * (rim * rim * (1.0 - 4.0 * q2));
}
void fragment() {
	ivec2 whole = textureSize(wave, 0);
	ivec2 at = ivec2(floor(UV * vec2(whole)));
	vec2 here = vec2(at) + 0.5;
	vec2 stored = wave_texel(at, rest, whole);
	float newest = stored.x;
	float previous = stored.y;
	float around = wave_texel(at - ivec2(1, 0), rest, whole).x + wave_texel(at + ivec2(1, 0), rest, whole).x
			+ wave_texel(at - ivec2(0, 1), rest, whole).x + wave_texel(at + ivec2(0, 1), rest, whole).x;
	float rim = 1.0;
	if (rim_damping > 0.0) {
		vec2 edge = min(here, size - here);
		float depth = max(1.0 - rim_inverse * min(edge.x, edge.y), 0.0);
		rim = 1.0 - rim_damping * (depth * depth);
		previous = rest + rim * (previous - rest);
	}
	float craters = 0.0;
	for (int i = 0; i < drop_count; i++) { craters += crater(texelFetch(drops, ivec2(0, i), 0), here); }
	float level = newest + damping * (newest - previous) + courant_sq * (around - 4.0 * newest) + craters;
	if (rim_damping > 0.0) { level = rest + rim * (level - rest); }
	COLOR = vec4(level, newest + craters, 0.0, 1.0);
}
