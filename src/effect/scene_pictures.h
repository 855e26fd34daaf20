// The pictures of a scene, read and checked in one way for all effects.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "effect/picture_sequence.h"
#include "image/fit.h"

namespace rainref::effect {

/// The place that a picture of any size fills: its texels, and its shape as columns for rows of square texels.
struct Place {
  Size size, aspect;
};
/// Row 0 = bottom, four float channels; each is value(channel value, channel).
Image floats_of(const image_io::Picture& picture, const std::function<float(float, int)>& value);
/// Converts to linear radiance: rgba32f, row 0 = bottom, alpha as stored. A picture of another size than the place's is fitted into it
/// (image/fit.h) in linear light.
Image linear_of(const image_io::Picture& picture, const Place& place);
/// The same, cached (cache/prepared.h), for a picture that does not change.
Image linear_once(const image_io::Picture& picture, const Place& place);
/// Reads the picture that `key` names, and converts it likewise at its own size.
Image read_linear(const scene::Config& config, const std::string& key, Inputs& inputs);

/// A picture of numbers beside another one of size `of`, row 0 = bottom, where that one is fitted into the place: no number is mixed with
/// another. Throws Error(usage) with the key if the two do not have the same shape.
Image beside(const Image& numbers, Size of, const Place& place, const char* key);
/// The picture that scene.depth_image shows in a frame, times `scale` (scene.depth_scale): metres along the view axis, r32f, row 0 =
/// bottom, fitted beside scene.image, whose size is `of`. The sky (is_sky) lies `far` metres away. Throws Error(usage) if the shape
/// differs, or if a depth is below 0; errors about texels name the file of a sequence.
Image depth_in(const PictureSource& depth, int frame, double scale, double far, Size of, const Place& place, Inputs& inputs);
/// A depth that is the same everywhere.
Image constant_depth(Size size, double metres);

/// scene.depth: the distance of a picture without a depth of its own.
scene::Parameter depth_parameter();
/// True if the scene names a picture and does not say how far away it is.
bool is_picture_far(const scene::Config& config);
/// The picture behind a glass and its depth, frame by frame, as the scene names them: scene.image, and scene.depth_image or scene.depth.
class ScenePictures {
 public:
  /// Checks the files of sequences. `takes_depth`: true if the variant has a depth. Throws Error for a depth without a picture, for two
  /// depths, for keys of a sequence without one, and as PictureSource does.
  ScenePictures(const scene::Config& config, bool takes_depth, const Place& place, Inputs& files);
  bool are_named() const { return colour_.has_value(); }
  bool change() const { return (colour_ && colour_->is_moving()) || (depth_ && depth_->is_moving()); }
  /// Index of the shown picture for each key: colour, depth.
  using Shown = std::array<std::int64_t, 2>;
  Shown shown_in(int frame) const;
  struct Seen {
    Image colour, depth;  ///< linear_of; depth_in, empty if the variant has none
  };
  /// What is named in that frame, in the place; what nothing gives a distance, and the sky, is `far` metres away. Adds single files to
  /// `files`.
  Seen in(int frame, double far, Inputs& files) const;

 private:
  Place place_;
  std::optional<PictureSource> colour_, depth_;
  double depth_scale_ = 1, constant_ = 0;
  bool takes_depth_;
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
