// The pictures of a scene, as effects take them: read in one way, refused in the same words.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "effect/picture_sequence.h"

namespace rainref::effect {

/// Row 0 = bottom, four float channels, each value(channel value, channel).
Image floats_of(const image_io::Picture& picture, const std::function<float(float, int)>& value);
/// As linear radiance: rgba32f, row 0 = bottom, alpha as stored.
Image linear_of(const image_io::Picture& picture);
/// The same, remembered (cache/prepared.h): of a picture that stays.
Image linear_once(const image_io::Picture& picture);
/// The picture that `key` names, likewise.
Image read_linear(const scene::Config& config, const std::string& key, Inputs& inputs);

/// The picture that scene.depth_image names, times `scale` (scene.depth_scale): metres along the view axis, r32f, row 0 = bottom. The sky
/// (is_sky) lies `far` metres away. Throws Error(usage) where it has not the size of scene.image, or is below 0.
Image depth_of(const image_io::Picture& picture, double scale, double far, const Image& colour);
/// The same of the picture that `depth` shows in a frame; what it says of a texel names the file of a sequence.
Image depth_in(const PictureSource& depth, int frame, double scale, double far, const Image& colour, Inputs& inputs);
/// The picture behind a glass that a scene names, and its depth, frame by frame: scene.image, scene.depth_image.
class ScenePictures {
 public:
  /// Looks at the files of sequences. `takes_depth`: whether the variant has a depth. Throws Error for a depth without a picture, for a
  /// sequence's keys without one, and as PictureSource does.
  ScenePictures(const scene::Config& config, bool takes_depth, Inputs& files);
  bool are_named() const { return colour_.has_value(); }
  bool have_depth() const { return depth_.has_value(); }
  /// Which picture of each key a frame shows: colour, depth.
  using Shown = std::array<std::int64_t, 2>;
  Shown shown_in(int frame) const;
  /// Of a frame, where it is named, as linear_of; a single file is added to `files`.
  Image colour(int frame, Inputs& files) const;
  /// The depth of that frame and colour, as depth_in.
  Image depth(int frame, double far, const Image& colour, Inputs& files) const;

 private:
  std::optional<PictureSource> colour_, depth_;
  double depth_scale_ = 1;
};
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
