#include "effect/scene_pictures.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cache/prepared.h"
#include "effect/run_memory.h"
#include "image/colour.h"
#include "image/flipped.h"
#include "image/seam.h"
#include "image/texture.h"
#include "rainref/error.h"

namespace rainref::effect {

namespace {

Image floats_of(const Image& stored, const std::function<float(float, int)>& value) {
  const Image image = flipped(stored);
  const TextureData decoded(image, Address::clamp, Address::clamp);
  Image out(Format::rgba32f, image.width(), image.height());
  const float* in = decoded.view().texels;
  for (int y = 0; y < image.height(); ++y) {
    for (int i = 0; i < 4 * image.width(); ++i) out.row<float>(y)[i] = value(*in++, i % 4);
  }
  return out;
}
Image made_linear(const int&, const Image& stored, const bool& is_encoded) {
  return floats_of(stored, [&](float x, int c) { return c < 3 && is_encoded ? static_cast<float>(decode_srgb(x)) : x; });
}

}  // namespace

Image floats_of(const image_io::Picture& picture, const std::function<float(float, int)>& value) { return floats_of(picture.image, value); }
Image read_linear(const scene::Config& config, const std::string& key, Inputs& inputs) {
  return linear_once(read_input(config, key, inputs));
}
Image linear_of(const image_io::Picture& p) { return made_linear(0, p.image, p.srgb_encoded); }
Image linear_once(const image_io::Picture& p) {
  return cache::prepared("linear picture", 0, made_linear, p.image, p.srgb_encoded)->shared();
}

bool is_sky(float stored, float metres) {
  constexpr float largest_half = 65504;
  return stored == 0 || stored == largest_half || metres >= largest_half;
}
namespace {

Image made_depth(const int&, const Image& stored, const double& in_metres, const double& far, const Image& colour) {
  const Image four = floats_of(stored, [](float x, int) { return x; });
  if (four.width() != colour.width() || four.height() != colour.height()) {
    throw Error(ExitCode::usage, fmt::format("scene.depth_image: expected {}x{} texels as scene.image has, found {}x{}", colour.width(),
                                             colour.height(), four.width(), four.height()));
  }
  const auto scale = static_cast<float>(in_metres), sky = static_cast<float>(far);
  Image depth(Format::r32f, four.width(), four.height());
  for (int y = 0; y < depth.height(); ++y) {
    for (int x = 0; x < depth.width(); ++x) {
      const float in_file = four.row<float>(y)[4 * x], metres = in_file * scale, z = is_sky(in_file, metres) ? sky : metres;
      if (!(z >= 0))
        throw Error(
            ExitCode::usage,
            fmt::format("scene.depth_image: expected depths of 0 m or more, found {} at column {}, row {} from the bottom", z, x, y));
      depth.row<float>(y)[x] = z;
    }
  }
  return depth;
}

}  // namespace

Image depth_of(const image_io::Picture& picture, double in_metres, double far, const Image& colour) {
  return made_depth(0, picture.image, in_metres, far, colour);
}
Image depth_in(const PictureSource& depth, int frame, double scale, double far, const Image& colour, Inputs& inputs) {
  const std::int64_t picture = depth.shown_in(frame);
  const image_io::Picture read = depth.read(picture, inputs);
  try {
    if (depth.is_sequence()) return depth_of(read, scale, far, colour);
    return cache::prepared("depth picture", 0, made_depth, read.image, scale, far, colour)->shared();
  } catch (const Error& e) {
    throw depth.about(e, picture);
  }
}

ScenePictures::ScenePictures(const scene::Config& config, bool takes_depth, Inputs& files) {
  if (takes_depth)
    refuse_unused_sequence(config, {"scene.image", "scene.depth_image"});
  else
    refuse_unused_sequence(config, {"scene.image"});
  const bool has_depth = takes_depth && is_named(config, "scene.depth_image");
  if (is_named(config, "scene.image"))
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
Image ScenePictures::colour(int frame, Inputs& files) const {
  const image_io::Picture read = colour_->read(colour_->shown_in(frame), files);
  return colour_->is_sequence() ? linear_of(read) : linear_once(read);
}
Image ScenePictures::depth(int frame, double far, const Image& colour, Inputs& files) const {
  return depth_in(*depth_, frame, depth_scale_, far, colour, files);
}

Image read_tile(const scene::Config& config, const std::string& key, bool needs_alpha, Inputs& inputs) {
  const image_io::Picture p = read_input(config, key, inputs);
  const auto is_alpha = [](const std::string& name) { return name == "A" || name == "a"; };
  if (needs_alpha && std::none_of(p.channel_names.begin(), p.channel_names.end(), is_alpha)) {
    throw Error(ExitCode::usage, fmt::format("{}: expected four channels, with an alpha, found {}", key, fmt::join(p.channel_names, " ")));
  }
  Image tile = flipped(p.image);
  const double seam = seam_ratio(tile);
  if (seam > worst_seam_ratio) {
    inputs.warnings.push_back(fmt::format("{}: {} does not tile: the step across its edges is {:.1f} times the one between its texels", key,
                                          config.text(key), seam));
  }
  return tile;
}

Image read_panorama(const scene::Config& config, Inputs& inputs) {
  if (config.text("scene.panorama").empty()) return {};
  if (!config.text("scene.image").empty())
    throw Error(ExitCode::usage, "scene.panorama: expected no scene.image beside it, for each is the whole scene");
  return read_linear(config, "scene.panorama", inputs);
}

}  // namespace rainref::effect
