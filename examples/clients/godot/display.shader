shader_type canvas_item;
render_mode unshaded, blend_disabled;
// From `rainref describe puddle --layout gdshader --pass display --variant corrected`, without its comments.
uniform float vignette;
uniform float exposure;
uniform float width;
uniform float height;
uniform sampler2D colour;

vec3 encode_srgb(vec3 linear) {
	vec3 curve = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
	return mix(curve, 12.92 * linear, vec3(lessThanEqual(linear, vec3(0.0031308))));
}
void fragment() {
	ivec2 at = ivec2(floor(UV * vec2(width, height)));
	vec2 offset = (vec2(at) + 0.5) / vec2(width, height) - 0.5;
	float light = max(1.0 - vignette * length(offset), 0.0) * exposure;
	COLOR = vec4(encode_srgb(clamp(light * texelFetch(colour, at, 0).rgb, 0.0, 1.0)), 1.0);
}
