#include "windshield/scene/pictures.h"

#include <algorithm>

#include "effect/run_memory.h"
#include "effect/scene_pictures.h"
#include "math/half.h"
#include "rainref/error.h"
#include "windshield/scene/street.h"

namespace rainref::windshield {

ScenePictures::ScenePictures(const scene::Config& config, effect::Inputs& files) {
  effect::refuse_unused_sequence(config, {"scene.image", "scene.depth_image"});
  const bool has_depth = effect::is_named(config, "scene.depth_image");
  if (effect::is_named(config, "scene.image"))
    colour_.emplace(config, "scene.image", files);
  else if (has_depth)
    throw Error(ExitCode::usage, config.entry("scene.depth_image").origin.at,
                "scene.depth_image: expected scene.image beside it, found none");
  if (!has_depth) return;
  depth_.emplace(config, "scene.depth_image", files, &*colour_);
  depth_scale_ = config.real("scene.depth_scale");
}

ScenePictures::Shown ScenePictures::shown_in(int frame) const {
  return {colour_ ? colour_->shown_in(frame) : 0, depth_ ? depth_->shown_in(frame) : 0};
}

Surroundings ScenePictures::read(int frame, effect::Inputs& files) const {
  Surroundings s;
  if (!colour_) return s;
  const Image colour = effect::linear_of(colour_->read(colour_->shown_in(frame), files));
  s.colour = opaque_half(colour);
  s.depth = depth_ ? effect::depth_in(*depth_, frame, depth_scale_, street_far, colour, files) : far_depth(colour.width(), colour.height());
  return s;
}

Image opaque_half(const Image& linear) {
  Image out(Format::rgba16f, linear.width(), linear.height());
  for (int y = 0; y < out.height(); ++y) {
    const float* from = linear.row<float>(y);
    Half* to = out.row<Half>(y);
    for (int i = 0; i < 4 * out.width(); ++i) to[i] = to_half(i % 4 == 3 ? 1.0f : std::clamp(from[i], 0.0f, 65504.0f));
  }
  return out;
}

Image far_depth(int width, int height) {
  Image out(Format::r32f, width, height);
  for (int y = 0; y < height; ++y) std::fill_n(out.row<float>(y), width, static_cast<float>(street_far));
  return out;
}

}  // namespace rainref::windshield
