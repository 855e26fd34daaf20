#include "edge_splash/scene_pictures.h"

#include <fmt/format.h>

#include "effect/scene_pictures.h"
#include "image/flipped.h"
#include "rainref/error.h"

namespace rainref::edge_splash {

ScenePictures::ScenePictures(const scene::Config& config, effect::Inputs& files) {
  const bool corrected = config.variant() == name(Variant::corrected);
  const std::string source = config.text("scene.source");
  for (const char* key : {"scene.image", "scene.depth_image"}) {
    const bool is_named = !config.text(key).empty();
    if (source == "files" && !is_named)
      throw Error(ExitCode::usage, fmt::format("{}: expected a file, because scene.source is \"files\"", key));
    if (source != "files" && is_named)
      throw Error(ExitCode::usage, fmt::format("{}: needs scene.source = \"files\", found \"{}\"", key, source));
  }
  if (corrected)
    effect::refuse_unused_sequence(config, {"scene.image", "scene.depth_image", "scene.layer_image"});
  else
    effect::refuse_unused_sequence(config, {"scene.image", "scene.depth_image"});
  if (source == "files") {
    colour_.emplace(config, "scene.image", files);
    depth_.emplace(config, "scene.depth_image", files, &*colour_);
    is_metres_ = config.text("scene.depth_encoding") == "metres";
    scale_ = config.real("scene.depth_scale");
    far_ = config.real("scene.far");
  }
  if (corrected && !config.text("scene.layer_image").empty())
    layer_.emplace(config, "scene.layer_image", files, colour_ ? &*colour_ : nullptr);
  if (layer_ && layer_->is_sequence() && !colour_)
    throw Error(ExitCode::usage, fmt::format("scene.layer_image: a sequence needs scene.source = \"files\", found \"{}\"", source));
}

ScenePictures::Shown ScenePictures::shown_in(int frame) const {
  const auto of = [&](const std::optional<effect::PictureSource>& source) { return source ? source->shown_in(frame) : 0; };
  return {of(colour_), of(depth_), of(layer_)};
}

void ScenePictures::fill(int frame, Inputs& in, effect::Inputs& files) const {
  const auto [colour, depth, layer] = shown_in(frame);
  if (colour_) {
    const image_io::Picture picture = colour_->read(colour, files);
    in.colour = flipped(picture.image);
    in.colour_is_encoded = picture.srgb_encoded;
  }
  if (depth_) {
    in.depth_is_distance = is_metres_;
    in.depth = is_metres_ ? effect::depth_in(*depth_, frame, scale_, far_, in.colour, files) : flipped(depth_->read(depth, files).image);
  }
  if (layer_) in.layer = flipped(layer_->read(layer, files).image);
}

Error ScenePictures::about_depth(const Error& error, int frame) const {
  return depth_ ? depth_->about(error, depth_->shown_in(frame)) : error;
}

}  // namespace rainref::edge_splash
