// What the tests of splat share: glasses, images as numbers, the scalar evaluation of a whole texture.
#pragma once

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "drops/splat/scalar.h"
#include "drops/splat/splat.h"
#include "image/images.h"
#include "math/half.h"
#include "rainref/executor.h"

namespace rainref::drops {

inline constexpr double pi = 3.14159265358979323846;

/// Axes of the glass in its plane: e_u = (u, 0), e_v = (v cos phi, v sin phi) [m].
struct Glass {
  const char* name;
  double u, v, phi;
  std::array<double, 3> frame() const { return {u, v * std::cos(phi), v * std::sin(phi)}; }
  std::array<double, 3> axes() const { return {u, 0, v}; }
};
inline constexpr Glass square_glass{"square", 0.96, 0.96, pi / 2}, oblong_glass{"oblong", 1.2, 0.8, pi / 2},
    sheared_glass{"sheared", 1.0, 0.9, 70 * pi / 180};

inline SplatSettings settings_on(const Glass& glass, bool corrected, int width, int height, SplatKernel kernel = SplatKernel::paraboloid) {
  SplatSettings s;
  s.corrected = corrected;
  s.frame = corrected ? glass.frame() : glass.axes();
  s.keys.width = width;
  s.keys.height = height;
  s.keys.kernel = kernel;
  s.keys.half_accumulation = !corrected;
  return s;
}
inline Drop drop_at(double u, double v, double mass, std::uint32_t id = 0) {
  return {{static_cast<float>(u), static_cast<float>(v)}, {0, 0}, static_cast<float>(mass), 1, id, 0};
}
inline Image splatted(const parallel::Executor& executor, const SplatSettings& s, const std::vector<Drop>& drops,
                      const Image* film = nullptr, const Pull& pull = {}, std::span<const Neck> necks = {}) {
  Image height(Format::r16f, s.keys.width, s.keys.height);
  SplatScratch scratch;
  splat(executor, splat_uniforms(s, pull), s.keys.half_accumulation, s.keys.rounding, drops, necks, film, height, scratch);
  return height;
}
inline const parallel::Executor& two_threads() {
  static const parallel::Executor executor(2);
  return executor;
}
inline double at(const Image& image, int x, int y) { return to_float(image.row<Half>(y)[x]); }

/// Evenly spread over the glass and a little beyond, some dead, in every size.
inline std::vector<Drop> any_drops(int count, unsigned seed, double mass) {
  std::mt19937 words(seed);
  const auto unit = [&] { return words() * 0x1p-32; };
  std::vector<Drop> drops;
  for (int i = 0; i < count; ++i) {
    Drop d = drop_at(1.3 * unit() - 0.15, 1.3 * unit() - 0.15, mass * unit() * unit() * unit(), static_cast<std::uint32_t>(i));
    if (words() % 8 == 0) d.life = 0;
    drops.push_back(d);
  }
  return drops;
}
/// Whole mass units.
inline Image any_film(int width, int height, unsigned seed) {
  std::mt19937 words(seed);
  return make_image(Format::r32f, width, height, [&](int, int, int) { return static_cast<float>(words() % 100000); });
}

/// Of every third of them, of shares and rests of all sizes.
inline std::vector<Neck> any_necks(const std::vector<Drop>& drops, unsigned seed) {
  std::mt19937 words(seed);
  const auto unit = [&] { return words() * 0x1p-32; };
  std::vector<Neck> necks;
  for (std::size_t i = 0; i < drops.size(); i += 3) {
    const double angle = 2 * pi * unit(), apart = 1.58 * unit();
    necks.push_back({{static_cast<float>(apart * std::cos(angle)), static_cast<float>(apart * std::sin(angle))},
                     static_cast<float>(0.5 * unit()),
                     static_cast<float>(unit()),
                     drops[i].id,
                     0,
                     0,
                     0});
  }
  return necks;
}

/// Stamps, and which of them have necks.
template <class N>
struct Stamps {
  std::vector<scalar::Stamp<N>> all;
  std::vector<unsigned char> have_necks;
};
template <class N>
Stamps<N> stamps_of(const SplatUniforms& u, const std::vector<Drop>& drops, std::span<const Neck> necks = {}) {
  Stamps<N> stamps;
  for (const Drop& d : drops) {
    const Neck* const neck = SplatPass::neck_of(necks, d.id);
    scalar::NeckState<N> both;
    if (neck) both = scalar::loaded_neck<N>(neck->offset, neck->share, neck->left);
    stamps.all.push_back(scalar::splat_stamp(u, N(d.position[0]), N(d.position[1]), N(d.mass), N(d.life), neck ? &both : nullptr));
    stamps.have_necks.push_back(neck != nullptr);
  }
  return stamps;
}
/// One texel of the finished texture, before it is stored, by a scalar evaluation.
template <class N>
N plain_texel(SplatUniforms u, bool half_accumulation, Rounding rounding, const Stamps<N>& stamps, const Image* film, int x, int y) {
  u.drop_count = static_cast<std::int32_t>(stamps.all.size());
  const N sum = scalar::splat_drops(u, stamps.all.data(), stamps.have_necks.data(), x, y, [&](N h) {
    if constexpr (std::is_same_v<N, scalar::Scalar<float>>) {
      if (!half_accumulation) return h;
      Half stored;
      store(&stored, h, rounding);
      return N(to_float(stored));
    } else {
      return h;
    }
  });
  if (!film) return sum;
  float rows[3][3];
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) {
      rows[j][i] = film->row<float>(std::clamp(y + j - 1, 0, film->height() - 1))[std::clamp(x + i - 1, 0, film->width() - 1)];
    }
  }
  return scalar::film_height<N>(u, rows[0] + 1, rows[1] + 1, rows[2] + 1, 0) + sum;
}

}  // namespace rainref::drops
