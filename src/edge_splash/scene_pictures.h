// The pictures that a scene names for edge_splash, frame by frame.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <optional>

#include "effect/scene_pictures.h"
#include "rainref/edge_splash.h"

namespace rainref::edge_splash {

/// Value of scene.source; "files" wherever the scene names a picture.
std::string source_of(const scene::Config& config);

class ScenePictures {
 public:
  /// `size`: the picture's, to which files are fitted. Checks the files of sequences, and warns of a picture without a depth. Throws Error
  /// for a picture that scene.source requires but the scene lacks, and for a depth without a picture.
  ScenePictures(const scene::Config& config, Size size, effect::Inputs& files);
  /// Index of the shown picture for each key: colour, depth, layer.
  using Shown = std::array<std::int64_t, 3>;
  Shown shown_in(int frame) const;
  /// Reads the existing ones into colour, depth and layer. Adds single files to `files`.
  void fill(int frame, Inputs& in, effect::Inputs& files) const;
  /// Returns `error`, which is about a frame's depth, with its file.
  Error about_depth(const Error& error, int frame) const;

 private:
  std::optional<effect::PictureSource> colour_, depth_, layer_;
  effect::Place place_;
  bool is_metres_ = false;
  double scale_ = 1, far_ = 1;
};

}  // namespace rainref::edge_splash
