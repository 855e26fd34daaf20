// The pictures that a scene names for edge_splash, frame by frame.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "effect/picture_sequence.h"
#include "rainref/edge_splash.h"

namespace rainref::edge_splash {

class ScenePictures {
 public:
  /// Looks at the files of sequences. Throws Error for pictures that scene.source wants and does not find, or does not use.
  ScenePictures(const scene::Config& config, effect::Inputs& files);
  /// Which picture of each key a frame shows: colour, depth, layer.
  using Shown = std::array<std::int64_t, 3>;
  Shown shown_in(int frame) const;
  /// Reads those that there are into colour, depth and layer. Single files are added to `files`.
  void fill(int frame, Inputs& in, effect::Inputs& files) const;
  /// `error`, which a frame's depth gave, with its file.
  Error about_depth(const Error& error, int frame) const;

 private:
  std::optional<effect::PictureSource> colour_, depth_, layer_;
  bool is_metres_ = false;
  double scale_ = 1, far_ = 1;
};

}  // namespace rainref::edge_splash
