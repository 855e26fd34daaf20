// Water stepped by the scalar evaluations of wave_step over whole fields: in double the oracle of the tests, in float the
// definition of the bits. A shell like kernels_wave.cpp, without lanes, tiles or a choice of drops by place.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "puddle/host.h"
#include "puddle/scalar.h"

namespace rainref::puddle {

template <class Storage>
using WaveNumber = scalar::Scalar<std::conditional_t<std::is_same_v<Storage, double>, double, float>>;

// The texel that stands for index i outside [0, size); fixed boundaries have none.
inline int inner_index(int i, int size, Boundary boundary) {
  return boundary == Boundary::periodic ? ((i % size) + size) % size : std::clamp(i, 0, size - 1);
}

/// The number that steps water of this storage: double for the oracle, float for everything that is stored.
template <class Storage>
class ScalarWave {
 public:
  /// Level water of these settings' size, boundary, rounding and uniforms. The settings' own storage plays no part.
  explicit ScalarWave(const Settings& settings);
  /// As above, with uniforms that no settings give.
  ScalarWave(const Settings& settings, const WaveStepUniforms& uniforms);

  int width() const { return width_; }
  int height() const { return height_; }
  const WaveStepUniforms& uniforms() const { return uniforms_; }

  /// Stored values, row-major. Writable: the state is these two levels and nothing else.
  std::vector<Storage> newest, previous;

  /// One wave step; every drop is offered to every texel, in order.
  void step(std::span<const Drop> drops = {});

 private:
  bool corrected_;
  Rounding rounding_;
  Boundary boundary_;
  int width_, height_, ghosts_;  // ghosts_: texels on every side that a step may read
  WaveStepUniforms uniforms_;
  Storage rest_;
  std::vector<Storage> padded_;  // the newest level inside a frame of ghost texels

  void fill_padded();
};

using OracleWave = ScalarWave<double>;

template <class Storage>
ScalarWave<Storage>::ScalarWave(const Settings& settings) : ScalarWave(settings, wave_step_uniforms(settings)) {}

template <class Storage>
ScalarWave<Storage>::ScalarWave(const Settings& s, const WaveStepUniforms& uniforms)
    : corrected_(s.variant == Variant::corrected),
      rounding_(s.rounding),
      boundary_(s.boundary),
      width_(wave_size(s)[0]),
      height_(wave_size(s)[1]),
      ghosts_(static_cast<int>(uniforms.step) + 1),
      uniforms_(uniforms) {
  store(&rest_, WaveNumber<Storage>(uniforms.rest), rounding_);
  newest.assign(static_cast<std::size_t>(width_) * height_, rest_);
  previous = newest;
  padded_.resize(static_cast<std::size_t>(width_ + 2 * ghosts_) * (height_ + 2 * ghosts_));
}

template <class Storage>
void ScalarWave<Storage>::fill_padded() {
  Storage* to = padded_.data();
  for (int y = -ghosts_; y < height_ + ghosts_; ++y) {
    const bool outside = y < 0 || y >= height_;
    const Storage* from = newest.data() + static_cast<std::size_t>(inner_index(y, height_, boundary_)) * width_;
    for (int x = -ghosts_; x < width_ + ghosts_; ++x) {
      const bool rest = boundary_ == Boundary::fixed && (outside || x < 0 || x >= width_);
      *to++ = rest ? rest_ : from[inner_index(x, width_, boundary_)];
    }
  }
}

template <class Storage>
void ScalarWave<Storage>::step(std::span<const Drop> drops) {
  using N = WaveNumber<Storage>;
  fill_padded();
  WaveStepUniforms u = uniforms_;
  u.drop_count = static_cast<int>(drops.size());
  const std::ptrdiff_t stride = width_ + 2 * ghosts_;
  for (int y = 0; y < height_; ++y) {
    const Storage* here = padded_.data() + (y + ghosts_) * stride + ghosts_;
    Storage* out = previous.data() + static_cast<std::size_t>(y) * width_;
    const auto rows = scalar::rows_around<Storage>(
        u, corrected_, [&](int dy) { return here + dy * stride; }, out, nullptr);
    for (int x = 0; x < width_; ++x) {
      const N next =
          corrected_ ? scalar::wave_step_corrected<N>(u, rows, drops, x, y) : scalar::wave_step_as_published<N>(u, rows, drops, x, y);
      store(out + x, next, rounding_);
    }
    if (corrected_ && !drops.empty()) {
      Storage* level = newest.data() + static_cast<std::size_t>(y) * width_;
      for (int x = 0; x < width_; ++x) {
        store(level + x, scalar::wave_previous_corrected<N>(level, nullptr, drops, x, y), rounding_);
      }
    }
  }
  newest.swap(previous);
}

}  // namespace rainref::puddle
