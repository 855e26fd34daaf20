#include "effect/scene_pictures.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "image/colour.h"
#include "image/flipped.h"
#include "image/seam.h"
#include "image/texture.h"
#include "rainref/error.h"

namespace rainref::effect {

Image floats_of(const image_io::Picture& picture, const std::function<float(float, int)>& value) {
  const Image image = flipped(picture.image);
  const TextureData decoded(image, Address::clamp, Address::clamp);
  Image out(Format::rgba32f, image.width(), image.height());
  const float* in = decoded.view().texels;
  for (int y = 0; y < image.height(); ++y) {
    for (int i = 0; i < 4 * image.width(); ++i) out.row<float>(y)[i] = value(*in++, i % 4);
  }
  return out;
}
Image read_linear(const scene::Config& config, const std::string& key, Inputs& inputs) {
  return linear_of(read_input(config, key, inputs));
}
Image linear_of(const image_io::Picture& p) {
  return floats_of(p, [&](float x, int c) { return c < 3 && p.srgb_encoded ? static_cast<float>(decode_srgb(x)) : x; });
}

bool is_sky(float stored, float metres) {
  constexpr float largest_half = 65504;
  return stored == 0 || stored == largest_half || metres >= largest_half;
}
Image depth_of(const image_io::Picture& picture, double in_metres, double far, const Image& colour) {
  const Image four = floats_of(picture, [](float x, int) { return x; });
  if (four.width() != colour.width() || four.height() != colour.height()) {
    throw Error(ExitCode::usage, fmt::format("scene.depth_image: expected {}x{} texels as scene.image has, found {}x{}", colour.width(),
                                             colour.height(), four.width(), four.height()));
  }
  const auto scale = static_cast<float>(in_metres), sky = static_cast<float>(far);
  Image depth(Format::r32f, four.width(), four.height());
  for (int y = 0; y < depth.height(); ++y) {
    for (int x = 0; x < depth.width(); ++x) {
      const float stored = four.row<float>(y)[4 * x], metres = stored * scale, z = is_sky(stored, metres) ? sky : metres;
      if (!(z >= 0))
        throw Error(
            ExitCode::usage,
            fmt::format("scene.depth_image: expected depths of 0 m or more, found {} at column {}, row {} from the bottom", z, x, y));
      depth.row<float>(y)[x] = z;
    }
  }
  return depth;
}
Image depth_in(const PictureSource& depth, int frame, double scale, double far, const Image& colour, Inputs& inputs) {
  const std::int64_t picture = depth.shown_in(frame);
  const image_io::Picture read = depth.read(picture, inputs);
  try {
    return depth_of(read, scale, far, colour);
  } catch (const Error& e) {
    throw depth.about(e, picture);
  }
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
