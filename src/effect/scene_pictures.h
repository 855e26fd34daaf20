// The pictures of a scene, read and checked in one way for all effects.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "effect/picture_sequence.h"

namespace rainref::effect {

/// Row 0 = bottom, four float channels; each is value(channel value, channel).
Image floats_of(const image_io::Picture& picture, const std::function<float(float, int)>& value);
/// Converts to linear radiance: rgba32f, row 0 = bottom, alpha as stored.
Image linear_of(const image_io::Picture& picture);
/// The same, cached (cache/prepared.h), for a picture that does not change.
Image linear_once(const image_io::Picture& picture);
/// Reads the picture that `key` names, and converts it likewise.
Image read_linear(const scene::Config& config, const std::string& key, Inputs& inputs);

/// The picture that scene.depth_image names, times `scale` (scene.depth_scale): metres along the view axis, r32f, row 0 = bottom. The sky
/// (is_sky) lies `far` metres away. Throws Error(usage) if its size differs from scene.image, or if a depth is below 0.
Image depth_of(const image_io::Picture& picture, double scale, double far, const Image& colour);
/// The same for the picture that `depth` shows in a frame. Errors about texels name the file of a sequence.
Image depth_in(const PictureSource& depth, int frame, double scale, double far, const Image& colour, Inputs& inputs);
/// The picture behind a glass and its depth, frame by frame, as the scene names them: scene.image, scene.depth_image.
class ScenePictures {
 public:
  /// Checks the files of sequences. `takes_depth`: true if the variant has a depth. Throws Error for a depth without a picture, for keys of
  /// a sequence without one, and as PictureSource does.
  ScenePictures(const scene::Config& config, bool takes_depth, Inputs& files);
  bool are_named() const { return colour_.has_value(); }
  bool have_depth() const { return depth_.has_value(); }
  /// Index of the shown picture for each key: colour, depth.
  using Shown = std::array<std::int64_t, 2>;
  Shown shown_in(int frame) const;
  /// The colour of that frame as linear_of, if it is named; a single file is added to `files`.
  Image colour(int frame, Inputs& files) const;
  /// The depth of that frame and colour, as depth_in.
  Image depth(int frame, double far, const Image& colour, Inputs& files) const;

 private:
  std::optional<PictureSource> colour_, depth_;
  double depth_scale_ = 1;
};
/// True if a depth means the sky: 0 (nothing was hit), infinity, the largest half 65504, or 65504 m and more. `stored`: the number in the
/// file, `metres`: its distance.
bool is_sky(float stored, float metres);

/// Reads the tile that `key` names, row 0 = bottom, as stored; adds a warning if its edges do not fit. With `needs_alpha` throws
/// Error(usage) if the file has no alpha.
Image read_tile(const scene::Config& config, const std::string& key, bool needs_alpha, Inputs& inputs);

/// Reads the panorama that scene.panorama names, linear, rgba32f, row 0 straight down; empty if none is named. Throws Error(usage) if
/// scene.image is also set.
Image read_panorama(const scene::Config& config, Inputs& inputs);

}  // namespace rainref::effect
