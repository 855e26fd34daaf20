#include "edge_splash/readings.h"

#include <algorithm>
#include <array>
#include <type_traits>

#include <fmt/format.h>

#include "capture/bound_texture.h"
#include "capture/display.h"
#include "edge_splash/every_reading.h"
#include "rainref/error.h"

namespace rainref::edge_splash {
namespace {

using capture::BoundTexture;
using capture::PassCase;
using capture::PassModel;
using enclosed::Enclosure;

/// An image of this size and these channels.
BoundTexture image_of(const PassCase& c, const char* name, int width, int height, int channels) {
  const capture::CaseInput& input = capture::image_input(c, name);
  const capture::Array& a = input.array;
  const bool right = info(a.format).channels == channels && (width == 0 || (a.width == width && a.height == height));
  if (!right) throw Error(ExitCode::port_files, fmt::format("{}: in.{} is {} {}x{}: {} channels{} were expected", c.folder(), name, info(a.format).name, a.width, a.height, channels,
                                                            width == 0 ? "" : fmt::format(" of {}x{}", width, height)));
  return BoundTexture(input);
}
/// The texel of an image of four channels.
template <class N>
every::Channels<N, 4> four_channels(const BoundTexture& image, int x, int y) {
  const Texture t = image.view();
  every::Channels<N, 4> out;
  for (int k = 0; k < 4; ++k) out[k] = N::load(t.texels + 4 * (static_cast<std::ptrdiff_t>(y) * t.width[0] + x) + k);
  return out;
}

// ---- splash, as published --------------------------------------------------------------------------------------------
// Many decisions lead to few masks: where the scroll ends on a whole texel each coordinate of the noise may be one of two
// texels, and in a flat place the angle is rounding alone. So an enclosure asks for the set of masks that the decisions can
// give, and decides once, among these.
template <std::size_t Count>
class MaskSet {
 public:
  /// body() gives masks of 0 and 1, and decides what it must.
  template <class Body>
  explicit MaskSet(const Body& body) {
    enclosed::Replay replay;
    const bool is_whole = replay.for_each_alternative([&] {
      const std::array<Enclosure, Count> masks = body();
      std::size_t word = 0;
      for (std::size_t k = 0; k < Count; ++k) word |= static_cast<std::size_t>(masks[k].lo != 0) << k;
      if (std::find(words_.begin(), words_.end(), word) == words_.end()) words_.push_back(word);
    });
    if (!is_whole) enclosed::give_up();
  }
  std::array<Enclosure, Count> decide() const {
    const std::size_t word = words_[words_.size() < 2 ? 0 : static_cast<std::size_t>(enclosed::choose(static_cast<int>(words_.size())))];
    std::array<Enclosure, Count> masks;
    for (std::size_t k = 0; k < Count; ++k) masks[k] = Enclosure(word >> k & 1 ? 1.0f : 0.0f);
    return masks;
  }

 private:
  std::vector<std::size_t> words_;
};
template <class N>
every::Splash<N> as_published(const PublishedSplashUniforms& u, const Texture& depth, const Texture& noise_map, const every::Channels<N, 4>& scene, int x, int y) {
  if constexpr (std::is_same_v<N, Enclosure>) {
    const N px = N::index(x), py = N::index(y);
    const auto edge_and_angle = MaskSet<2>([&] {
                                  const every::EdgeMasks<N> m = every::edge_masks(u, depth, px, py);
                                  return std::array<N, 2>{m.edge, m.angle};
                                }).decide();
    const auto noise = MaskSet<1>([&] { return std::array<N, 1>{every::noise_mask(u, noise_map, px, py)}; }).decide();
    return every::blend_as_published<N>(u, {edge_and_angle[0], edge_and_angle[1]}, noise[0], scene, px, py);
  } else {
    return every::splash_as_published<N>(u, depth, noise_map, scene, x, y);
  }
}

// ---- splash --------------------------------------------------------------------------------------------------------
struct Splash {
  int width, height, values = 7;
  bool corrected;
  PublishedSplashUniforms published_uniforms;
  SplashUniforms uniforms;
  BoundTexture scene, depth, noise;
  std::vector<Unorm8> layer;

  template <class N>
  void operator()(int x, int y, N* out) const {
    const every::Channels<N, 4> below = four_channels<N>(scene, x, y);
    const every::Splash<N> s = corrected ? every::splash_corrected<N>(uniforms, depth.view(), noise.view(), N::load(&layer[static_cast<std::size_t>(y) * width + x]), below, x, y)
                                         : as_published<N>(published_uniforms, depth.view(), noise.view(), below, x, y);
    out[0] = s.edge;
    out[1] = s.angle;
    out[2] = s.noise;
    for (int k = 0; k < 4; ++k) out[3 + k] = s.colour[k];
  }
};
std::unique_ptr<PassModel> bind_splash(const PassCase& c) {
  Splash m;
  const capture::Array& scene = capture::image_input(c, "scene").array;
  m.width = scene.width;
  m.height = scene.height;
  m.corrected = c.corrected();
  m.scene = image_of(c, "scene", m.width, m.height, 4);
  m.depth = image_of(c, "depth", m.width, m.height, 1);
  m.noise = image_of(c, "noise_map", 0, 0, 1);
  if (m.corrected) {
    m.uniforms = capture::uniforms_of<SplashUniforms>(c);
    image_of(c, "layer", m.width, m.height, 1);
    for (const std::byte code : capture::image_input(c, "layer").array.levels[0]) m.layer.push_back({static_cast<std::uint8_t>(code)});
  } else {
    m.published_uniforms = capture::uniforms_of<PublishedSplashUniforms>(c);
  }
  return capture::model_of(std::move(m));
}

}  // namespace

const std::vector<capture::PassReadings>& readings() {
  static const std::vector<capture::PassReadings> all{{"splash", bind_splash}, {"display", capture::bind_display}};
  return all;
}

}  // namespace rainref::edge_splash
