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
  /// Checks the files of sequences. Throws Error for pictures that scene.source requires but the scene lacks, or that it does not use.
  ScenePictures(const scene::Config& config, effect::Inputs& files);
  /// Index of the shown picture for each key: colour, depth, layer.
  using Shown = std::array<std::int64_t, 3>;
  Shown shown_in(int frame) const;
  /// Reads the existing ones into colour, depth and layer. Adds single files to `files`.
  void fill(int frame, Inputs& in, effect::Inputs& files) const;
  /// Returns `error`, which is about a frame's depth, with its file.
  Error about_depth(const Error& error, int frame) const;

 private:
  std::optional<effect::PictureSource> colour_, depth_, layer_;
  bool is_metres_ = false;
  double scale_ = 1, far_ = 1;
};

}  // namespace rainref::edge_splash
