// The pictures of a scene, as effects take them: read in one way, refused in the same words.
#pragma once

#include <functional>
#include <string>

#include "effect/picture_sequence.h"

namespace rainref::effect {

/// Row 0 = bottom, four float channels, each value(channel value, channel).
Image floats_of(const image_io::Picture& picture, const std::function<float(float, int)>& value);
/// As linear radiance: rgba32f, row 0 = bottom, alpha as stored.
Image linear_of(const image_io::Picture& picture);
/// The picture that `key` names, likewise.
Image read_linear(const scene::Config& config, const std::string& key, Inputs& inputs);

/// The picture that scene.depth_image names, times `scale` (scene.depth_scale): metres along the view axis, r32f, row 0 = bottom. The sky
/// (is_sky) lies `far` metres away. Throws Error(usage) where it has not the size of scene.image, or is below 0.
Image depth_of(const image_io::Picture& picture, double scale, double far, const Image& colour);
/// The same of the picture that `depth` shows in a frame; what it says of a texel names the file of a sequence.
Image depth_in(const PictureSource& depth, int frame, double scale, double far, const Image& colour, Inputs& inputs);
/// Whether a file means the sky by a depth: 0 (nothing came back), infinity, the largest half 65504, or 65504 m and more. `stored`: the
/// number in the file, `metres`: what it stands for.
bool is_sky(float stored, float metres);

/// The tile that `key` names, row 0 = bottom, as stored; a warning where its edges do not fit. With `needs_alpha` throws
/// Error(usage) where the file has none.
Image read_tile(const scene::Config& config, const std::string& key, bool needs_alpha, Inputs& inputs);

/// The panorama that scene.panorama names, linear, rgba32f, row 0 straight down; empty where it names none. Throws Error(usage)
/// beside a scene.image.
Image read_panorama(const scene::Config& config, Inputs& inputs);

}  // namespace rainref::effect
