#include "edge_splash/scene_pictures.h"

#include <fmt/format.h>

#include "effect/scene_pictures.h"
#include "image/flipped.h"
#include "rainref/error.h"

namespace rainref::edge_splash {

std::string source_of(const scene::Config& config) { return config.text("scene.image").empty() ? config.text("scene.source") : "files"; }

ScenePictures::ScenePictures(const scene::Config& config, Size size, effect::Inputs& files) : place_{size, size} {
  const bool corrected = config.variant() == name(Variant::corrected), is_named = !config.text("scene.image").empty(),
             has_depth = !config.text("scene.depth_image").empty();
  const std::string source = source_of(config);
  if (source == "files" && !is_named) throw Error(ExitCode::usage, "scene.image: expected a file, because scene.source is \"files\"");
  if (has_depth && !is_named)
    throw Error(ExitCode::usage, config.entry("scene.depth_image").origin.at,
                "scene.depth_image: expected scene.image beside it, found none");
  if (corrected)
    effect::refuse_unused_sequence(config, {"scene.image", "scene.depth_image", "scene.layer_image"});
  else
    effect::refuse_unused_sequence(config, {"scene.image", "scene.depth_image"});
  if (is_named) colour_.emplace(config, "scene.image", files);
  if (is_named && !has_depth)
    files.warnings.push_back("scene.image: without scene.depth_image nothing in it has an edge, so nothing splashes");
  if (has_depth) {
    depth_.emplace(config, "scene.depth_image", files, &*colour_);
    is_metres_ = config.text("scene.depth_encoding") == "metres";
    scale_ = config.real("scene.depth_scale");
  }
  far_ = config.real("scene.far");
  if (corrected && !config.text("scene.layer_image").empty())
    layer_.emplace(config, "scene.layer_image", files, colour_ ? &*colour_ : nullptr);
  if (layer_ && layer_->is_moving() && !colour_)
    throw Error(ExitCode::usage, fmt::format("scene.layer_image: a sequence needs scene.source = \"files\", found \"{}\"", source));
}

ScenePictures::Shown ScenePictures::shown_in(int frame) const {
  const auto of = [&](const std::optional<effect::PictureSource>& source) { return source ? source->shown_in(frame) : 0; };
  return {of(colour_), of(depth_), of(layer_)};
}

void ScenePictures::fill(int frame, Inputs& in, effect::Inputs& files) const {
  const auto [colour, depth, layer] = shown_in(frame);
  Size of = place_.size;
  if (colour_) {
    const image_io::Picture picture = colour_->read(colour, files);
    of = size_of(picture.image);
    const bool fits = of == place_.size;
    in.colour = fits ? flipped(picture.image) : effect::linear_of(picture, place_);
    in.colour_is_encoded = fits && picture.srgb_encoded;
  }
  const auto numbers = [&](const effect::PictureSource& source, std::int64_t shown, const char* key) {
    const Image image = flipped(source.read(shown, files).image);
    return effect::beside(image, colour_ ? of : size_of(image), place_, key);
  };
  if (depth_) {
    in.depth_is_distance = is_metres_;
    in.depth =
        is_metres_ ? effect::depth_in(*depth_, frame, scale_, far_, of, place_, files) : numbers(*depth_, depth, "scene.depth_image");
  } else if (colour_) {
    in.depth_is_distance = true;
    in.depth = effect::constant_depth(place_.size, far_);
  }
  if (layer_) in.layer = numbers(*layer_, layer, "scene.layer_image");
}

Error ScenePictures::about_depth(const Error& error, int frame) const {
  return depth_ ? depth_->about(error, depth_->shown_in(frame)) : error;
}

}  // namespace rainref::edge_splash
