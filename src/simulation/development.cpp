#include "simulation/development.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include "image/colour.h"
#include "math/half.h"
#include "math/real64.h"
#include "random/counter.h"
#include "scene/member_parameter.h"
#include "simulation/bloom.h"
#include "simulation/light_mean.h"
#include "simulation/tone_curve.h"

namespace rainref::simulation {
namespace {

const std::vector<scene::MemberParameter<Development>>& table() {
  using D = Development;
  static const std::vector<scene::MemberParameter<D>> all{
      scene::real<&D::shoulder>(
          "picture.shoulder", "1", 0, 1,
          "Light from which highlights are compressed (Khronos PBR Neutral), where 1 is white. With 1 they are clipped."),
      scene::real<&D::desaturation>("picture.desaturation", "1", 0, 1, "How fast compressed highlights fade to white."),
      scene::real<&D::bloom>("picture.bloom", "1", 0, 1, "Share of the light that the lens scatters around bright places; 0: none."),
      scene::real<&D::bloom_threshold>("picture.bloom_threshold", "1", 0, 1000,
                                       "The lens scatters the light above this, where 1 is white."),
      scene::real<&D::bloom_radius>("picture.bloom_radius", "1", 0.001, 1, "Width of the widest blur, in heights of the picture."),
      scene::boolean<&D::dither>("picture.dither", "Codes are rounded at random, so that their mean is the light and no bands appear."),
      scene::boolean<&D::has_layer>("picture.layer",
                                    "EXR files also hold layers of the drops: drops (premultiplied), background (what they cover), and "
                                    "offset (where their light comes from, in widths and heights)."),
  };
  return all;
}

constexpr float brightest = 65504;

float held(float x) { return x > 0 ? std::min(x, brightest) : 0; }

/// Exposed light of one sample.
class Exposed {
 public:
  explicit Exposed(const effect::Display& display)
      : radiance_(*display.radiance),
        is_half_(radiance_.format() == Format::rgba16f),
        factor_(static_cast<float>(exp2_real(Real64(display.exposure)).v)) {}
  int width() const { return radiance_.width(); }
  int height() const { return radiance_.height(); }
  void row(int y, std::vector<float>& light) const {
    light.resize(3 * static_cast<std::size_t>(width()));
    for (std::size_t x = 0; x < static_cast<std::size_t>(width()); ++x)
      for (std::size_t c = 0; c < 3; ++c) {
        const float stored = is_half_ ? to_float(radiance_.row<Half>(y)[4 * x + c]) : radiance_.row<float>(y)[4 * x + c];
        light[3 * x + c] = factor_ * held(stored);
      }
  }

 private:
  const Image& radiance_;
  bool is_half_;
  float factor_;
};

/// The share of a sample's light above the threshold, the same for all channels, from the brightest one.
float share_above(const float* light, float threshold) {
  const float peak = std::max({light[0], light[1], light[2]});
  return peak > threshold ? (peak - threshold) / peak : 0;
}

/// Returns the scattered light at the size of the picture: the mean of n x n samples, blurred.
LightImage scattered(const Exposed& exposed, const Development& options, int n, const parallel::Executor& executor) {
  LightImage bright(exposed.width() / n, exposed.height() / n);
  const float weight = 1 / static_cast<float>(n * n), threshold = static_cast<float>(options.bloom_threshold);
  executor.for_tiles(bright.width, bright.height, bright.width, tile_rows, [&](const parallel::Tile& tile) {
    std::vector<float> light;
    for (int y = n * tile.y0; y < n * tile.y1; ++y) {
      exposed.row(y, light);
      float* to = bright.row(y / n);
      for (int x = 0; x < n * bright.width; ++x) {
        const float* in = light.data() + 3 * x;
        const float share = weight * share_above(in, threshold);
        for (int c = 0; c < 3; ++c) to[3 * (x / n) + c] += share * in[c];
      }
    }
  });
  const int levels = bloom_levels(bright.height, options.bloom_radius);
  return bloomed(std::move(bright), levels, executor);
}

}  // namespace

std::vector<scene::Parameter> development_parameters() { return scene::parameters_of(table()); }

Development development_from(const scene::Config& config) {
  Development options;
  const auto declared = [](const scene::Config::Entry& e) { return e.parameter.key.starts_with("picture."); };
  if (std::any_of(config.entries().begin(), config.entries().end(), declared)) scene::apply(table(), config, options);
  return options;
}

void hold_development(effect::RunMemory& memory, const Development& options, int samples) {
  if (options.bloom <= 0) return;
  const int width = memory.width / samples, height = memory.height / samples;
  memory.peak.pass(12 * static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) + bloom_bytes(width, height));
}

Image developed(const effect::Display& display, const Development& options, int n, std::uint64_t seed, int frame,
                const parallel::Executor& executor) {
  const Exposed exposed(display);
  const int width = exposed.width() / n, height = exposed.height() / n;
  const float bloom = static_cast<float>(options.bloom), threshold = static_cast<float>(options.bloom_threshold);
  LightImage around;
  if (bloom > 0) around = scattered(exposed, options, n, executor);

  const auto row_of = [&](int y, std::span<double> light) {
    thread_local std::vector<float> samples;
    exposed.row(y, samples);
    const double v = (y + 0.5) / exposed.height() - 0.5;
    for (int x = 0; x < exposed.width(); ++x) {
      float* s = samples.data() + 3 * x;
      if (bloom > 0) {
        const float kept = 1 - bloom * share_above(s, threshold);
        const float* more = around.row(y / n) + 3 * (x / n);
        for (int c = 0; c < 3; ++c) s[c] = kept * s[c] + bloom * more[c];
      }
      double gain = 1;
      if (display.vignette > 0) {
        const double u = (x + 0.5) / exposed.width() - 0.5;
        gain = std::max(0.0, 1 - display.vignette * std::sqrt(u * u + v * v));
      }
      const Light out = shown({gain * s[0], gain * s[1], gain * s[2]}, options.shoulder, options.desaturation);
      for (std::size_t c = 0; c < 3; ++c) light[static_cast<std::size_t>(3 * x) + c] = out[c];
      if (display.code != effect::Display::Code::power) continue;
      for (std::size_t c = 0; c < 3; ++c)
        if (double& l = light[static_cast<std::size_t>(3 * x) + c]; l > 0) l = decode_srgb(pow_real(Real64(l), Real64(0.4545)).v);
    }
  };
  const auto codes_of = [&](int x, int y, const double* light, std::uint8_t* codes) {
    random::Block words{};
    if (options.dither)
      words = random::block(seed, random::Purpose::picture_dither, static_cast<std::uint32_t>(y) << 16 | static_cast<std::uint32_t>(x),
                            static_cast<std::uint32_t>(frame));
    for (std::size_t c = 0; c < 3; ++c)
      codes[c] = options.dither ? dithered_code(light[c], static_cast<double>(random::uniform(words[c]))) : nearest_code(light[c]);
  };
  return picture_of_means(width, height, n, row_of, codes_of, executor);
}

}  // namespace rainref::simulation
