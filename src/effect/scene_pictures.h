// The pictures of a scene, as effects take them: read in one way, refused in the same words.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "effect/inputs.h"

namespace rainref::effect {

/// Row 0 = bottom, four float channels, each value(channel value, channel).
Image floats_of(const image_io::Picture& picture, const std::function<float(float, int)>& value);
/// As linear radiance: rgba32f, row 0 = bottom, alpha as stored.
Image linear_of(const image_io::Picture& picture);
/// The picture that `key` names, likewise.
Image read_linear(const scene::Config& config, const std::string& key, Inputs& inputs);

/// The first channel of the picture that scene.depth_image names, times scene.depth_scale: metres along the view axis, r32f,
/// row 0 = bottom. Throws Error(usage) where it has not the size of scene.image, or is below 0. depth_of: of a picture, times `scale`.
Image depth_of(const image_io::Picture& picture, double scale, const Image& colour);
Image read_depth(const scene::Config& config, const Image& colour, Inputs& inputs);

/// The tile that `key` names, row 0 = bottom, as stored; a warning where its edges do not fit. With `needs_alpha` throws
/// Error(usage) where the file has none.
Image read_tile(const scene::Config& config, const std::string& key, bool needs_alpha, Inputs& inputs);

/// The panorama that scene.panorama names, linear, rgba32f, row 0 straight down; empty where it names none. Throws Error(usage)
/// beside a scene.image.
Image read_panorama(const scene::Config& config, Inputs& inputs);

}  // namespace rainref::effect
