// The pictures that a scene names for what lies before the car, frame by frame.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "effect/picture_sequence.h"
#include "rainref/image.h"
#include "rainref/windshield.h"

namespace rainref::windshield {

class ScenePictures {
 public:
  /// Looks at the files of sequences. Throws Error for a depth without a picture, and as PictureSource does.
  ScenePictures(const scene::Config& config, effect::Inputs& files);
  /// Whether a picture takes the street's place.
  bool are_named() const { return colour_.has_value(); }
  /// Which picture of each key a frame shows: colour, depth.
  using Shown = std::array<std::int64_t, 2>;
  Shown shown_in(int frame) const;
  /// Those of a frame, as the passes take them; empty where none is named. Single files are added to `files`.
  Surroundings read(int frame, effect::Inputs& files) const;

 private:
  std::optional<effect::PictureSource> colour_, depth_;
  double depth_scale_ = 1;
};

/// Of linear radiance, rgba32f, as rgba16f, alpha 1; negative values become 0, those beyond the range of a half its largest
/// value.
Image opaque_half(const Image& linear);
/// As far as the street's sky everywhere.
Image far_depth(int width, int height);

}  // namespace rainref::windshield
