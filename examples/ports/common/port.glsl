// What the shaders with an invocation for each texel share.
#extension GL_EXT_shader_image_load_formatted : enable

layout(local_size_x = 8, local_size_y = 8) in;

// The address rules of a manifest, as the runner hands them over.
const int CLAMP = 0, REPEAT = 1, BORDER = 2;

bool outside(ivec2 pixel, ivec2 size) { return any(greaterThanEqual(pixel, size)); }
