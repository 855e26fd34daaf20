#include "effect/scene_pictures.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cache/prepared.h"
#include "effect/run_memory.h"
#include "image/colour.h"
#include "image/flipped.h"
#include "image/seam.h"
#include "image/texture.h"
#include "math/half.h"
#include "math/unorm.h"
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
/// Rows of a picture in linear light, from the bottom.
ReadRow linear_rows(const Image& stored, bool is_encoded) {
  const auto linear = [=](float x, int i) { return i % 4 < 3 && is_encoded ? static_cast<float>(decode_srgb(x)) : x; };
  const int last = stored.height() - 1, numbers = 4 * stored.width();
  if (stored.format() == Format::rgba32f) {
    return [=, &stored](int y, float* out) {
      for (int i = 0; i < numbers; ++i) out[i] = linear(stored.row<float>(last - y)[i], i);
    };
  }
  if (stored.format() == Format::rgba16f) {
    return [=, &stored](int y, float* out) {
      for (int i = 0; i < numbers; ++i) out[i] = linear(to_float(stored.row<Half>(last - y)[i]), i);
    };
  }
  std::vector<float> codes;  // four numbers for each code
  for (int code = 0; code < 256; ++code)
    for (int c = 0; c < 4; ++c) codes.push_back(linear(to_float(Unorm8{static_cast<std::uint8_t>(code)}), c));
  return [=, &stored](int y, float* out) {
    const Unorm8* in = stored.row<Unorm8>(last - y);
    for (int i = 0; i < numbers; ++i) out[i] = codes[static_cast<std::size_t>(4 * in[i].code + i % 4)];
  };
}
/// All of a picture that already has the place's size.
Part part_in(const Place& place, Size picture) {
  return picture == place.size ? Part{0, 0, picture[0], picture[1]} : centred_part(picture, place.aspect);
}
Image made_linear(const int&, const Image& stored, const bool& is_encoded, const Place& place) {
  const Size of = size_of(stored);
  const ReadRow row = linear_rows(stored, is_encoded);
  if (of != place.size) return fitted(row, of, part_in(place, of), place.size);
  Image out(Format::rgba32f, of[0], of[1]);
  for (int y = 0; y < of[1]; ++y) row(y, out.row<float>(y));
  return out;
}

}  // namespace

Image floats_of(const image_io::Picture& picture, const std::function<float(float, int)>& value) { return floats_of(picture.image, value); }
Image read_linear(const scene::Config& config, const std::string& key, Inputs& inputs) {
  const image_io::Picture picture = read_input(config, key, inputs);
  return linear_once(picture, {size_of(picture.image), size_of(picture.image)});
}
Image linear_of(const image_io::Picture& p, const Place& place) { return made_linear(0, p.image, p.srgb_encoded, place); }
Image linear_once(const image_io::Picture& p, const Place& place) {
  return cache::prepared("linear picture", 0, made_linear, p.image, p.srgb_encoded, place)->shared();
}

bool is_sky(float stored, float metres) {
  constexpr float largest_half = 65504;
  return stored == 0 || stored == largest_half || metres >= largest_half;
}

Image beside(const Image& numbers, Size of, const Place& place, const char* key) {
  // Sides that were rounded once have the same shape.
  const std::int64_t across = std::int64_t{numbers.width()} * of[1], along = std::int64_t{numbers.height()} * of[0];
  if (2 * std::abs(across - along) > std::int64_t{of[0]} + of[1])
    throw Error(ExitCode::usage, fmt::format("{}: expected {}x{} texels as scene.image has, or another size of this shape, found {}x{}",
                                             key, of[0], of[1], numbers.width(), numbers.height()));
  return fitted_nearest(numbers, of, part_in(place, of), place.size);
}
namespace {

Image made_depth(const int&, const Image& stored, const double& in_metres, const double& far, const Size& of, const Place& place) {
  const Image four = floats_of(stored, [](float x, int) { return x; });
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
  return beside(depth, of, place, "scene.depth_image");
}

}  // namespace

Image depth_in(const PictureSource& depth, int frame, double scale, double far, Size of, const Place& place, Inputs& inputs) {
  const std::int64_t picture = depth.shown_in(frame);
  const image_io::Picture read = depth.read(picture, inputs);
  try {
    if (depth.is_moving()) return made_depth(0, read.image, scale, far, of, place);
    return cache::prepared("depth picture", 0, made_depth, read.image, scale, far, of, place)->shared();
  } catch (const Error& e) {
    throw depth.about(e, picture);
  }
}
Image constant_depth(Size size, double metres) {
  Image depth(Format::r32f, size[0], size[1]);
  for (int y = 0; y < size[1]; ++y) std::fill_n(depth.row<float>(y), size[0], static_cast<float>(metres));
  return depth;
}

scene::Parameter depth_parameter() {
  return scene::real("scene.depth", "m", 0, 65000, 0,
                     "Distance of all of scene.image if there is no scene.depth_image; 0: far, without fog.");
}
bool is_picture_far(const scene::Config& config) {
  return is_named(config, "scene.image") && !is_named(config, "scene.depth_image") && config.real("scene.depth") == 0;
}

ScenePictures::ScenePictures(const scene::Config& config, bool takes_depth, const Place& place, Inputs& files)
    : place_(place), takes_depth_(takes_depth) {
  if (takes_depth)
    refuse_unused_sequence(config, {"scene.image", "scene.depth_image"});
  else
    refuse_unused_sequence(config, {"scene.image"});
  const bool has_depth = takes_depth && is_named(config, "scene.depth_image");
  if (takes_depth) constant_ = config.real("scene.depth");
  if (is_named(config, "scene.image"))
    colour_.emplace(config, "scene.image", files);
  else if (has_depth || constant_ > 0) {
    const char* key = has_depth ? "scene.depth_image" : "scene.depth";
    throw Error(ExitCode::usage, config.entry(key).origin.at, fmt::format("{}: expected scene.image beside it, found none", key));
  }
  if (!has_depth) return;
  if (constant_ > 0)
    throw Error(ExitCode::usage, config.entry("scene.depth").origin.at,
                fmt::format("scene.depth: expected none beside scene.depth_image, found {:g}", constant_));
  depth_.emplace(config, "scene.depth_image", files, &*colour_);
  depth_scale_ = config.real("scene.depth_scale");
}

ScenePictures::Shown ScenePictures::shown_in(int frame) const {
  return {colour_ ? colour_->shown_in(frame) : 0, depth_ ? depth_->shown_in(frame) : 0};
}
ScenePictures::Seen ScenePictures::in(int frame, double far, Inputs& files) const {
  const image_io::Picture read = colour_->read(colour_->shown_in(frame), files);
  Seen seen{colour_->is_moving() ? linear_of(read, place_) : linear_once(read, place_), {}};
  if (depth_)
    seen.depth = depth_in(*depth_, frame, depth_scale_, far, size_of(read.image), place_, files);
  else if (takes_depth_)
    seen.depth = constant_depth(place_.size, constant_ > 0 ? constant_ : far);
  return seen;
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
