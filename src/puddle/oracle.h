// Water stepped by the scalar evaluations of wave_step over whole fields: in double the oracle of the tests, in float the
// definition of the bits. A shell like kernels_wave.cpp, without lanes, tiles or a choice of drops by place.
#pragma once

#include <span>
#include <vector>

#include "puddle/host.h"

namespace rainref::puddle {

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

extern template class ScalarWave<double>;
extern template class ScalarWave<float>;
extern template class ScalarWave<Half>;
extern template class ScalarWave<Unorm8>;

}  // namespace rainref::puddle
