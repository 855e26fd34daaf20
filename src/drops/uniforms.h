// Uniform blocks of the passes that move drops, byte for byte as a GPU takes them; see records.h for what they exchange.
#pragma once

#include <cstdint>

namespace rainref::drops {

/// spawn. Arrival i of a step takes its place from the first two words of the hash of (seed, step, i), and its mass from
/// the upper ten bits of the third.
struct SpawnUniforms {
  std::uint32_t seed[2];         ///< low word, high word
  std::uint32_t step;            ///< steps made before, modulo 2^32
  std::uint32_t parts;           ///< the count is a sum of this many draws
  std::int32_t first_count;      ///< of one draw, where its word is below every threshold
  std::int32_t threshold_count;  ///< 0: every draw gives first_count
  std::uint32_t first_id;        ///< of the step's first arrival; the others follow
  std::uint32_t room;            ///< free slots: later arrivals are lost
  float life;                    ///< of a new drop [s]
  float padding0, padding1, padding2;
};

/// integrate. mass_3 in the comments is the cube root of the mass in mass units.
struct IntegrateUniforms {
  float frame[3];          ///< corrected: x = frame0 u + frame1 v, y = frame2 v, in the plane of the glass [m]
  float dt;                ///< [s]
  float inertia_coupling;  ///< as-published [1]
  float wind_coupling;     ///< as-published [1/s]
  float drag;              ///< as-published: rate [1/s]; corrected: rate times mass_3^2 [1/s]
  float wind_push;         ///< corrected: acceleration over wind speed squared, times mass_3 [1/m]
  float hold;              ///< corrected: acceleration that hysteresis holds, times mass_3^2 [m/s^2]
  float evaporation;       ///< corrected: loss over mass_3 [mass units/s]
  float margin;            ///< corrected: a drop lives up to this far outside the glass, in u and v
  float rest_speed;        ///< corrected: a held drop that is slower rests [m/s]
  float phase_rate;        ///< corrected: turns in 64 s of the phase that rounds losses: a golden section in each step [1]
  float padding0, padding1, padding2;
};

/// merge and its trails.
struct MergeUniforms {
  float frame[3];        ///< as IntegrateUniforms::frame [m]
  float radius;          ///< base radius over the cube root of the mass in mass units [m]
  float trail;           ///< loss over base radius and way in a step [mass units/m^2]
  float dt;              ///< [s]
  std::int32_t film[2];  ///< columns and rows of the film [texel]
  float drying;          ///< what each texel of the film loses in this step, whole [mass units]
  float padding0, padding1, padding2;
};

/// necks.
struct NecksUniforms {
  float frame[3];  ///< as IntegrateUniforms::frame [m]
  float radius;    ///< as MergeUniforms::radius [m]
  float dt;        ///< [s]
  float keep;      ///< share of a neck that a step leaves
  float padding0, padding1;
};

static_assert(sizeof(NecksUniforms) == 32 && sizeof(SpawnUniforms) == 48 && sizeof(IntegrateUniforms) == 64 && sizeof(MergeUniforms) == 48);

}  // namespace rainref::drops
