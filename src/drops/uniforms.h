// Uniform blocks of the passes that move drops, in the layout of a GPU; see records.h for their records.
#pragma once

#include <cstdint>

namespace rainref::drops {

/// spawn. Arrival i of a step takes its position from the first two words of the hash of (seed, step, i), and its mass from the upper ten
/// bits of the third.
struct SpawnUniforms {
  std::uint32_t seed[2], step, parts;
  std::int32_t first_count, threshold_count;
  std::uint32_t first_id, room;
  float life, padding0, padding1, padding2;
};

/// integrate.
struct IntegrateUniforms {
  float frame[3], dt;
  float inertia_coupling, wind_coupling, drag, wind_push;
  float hold, evaporation, margin, rest_speed;
  float phase_rate, padding0, padding1, padding2;
};

/// merge and its trails.
struct MergeUniforms {
  float frame[3], radius;
  float trail, dt;
  std::int32_t film[2];
  float drying, padding0, padding1, padding2;
};

/// necks.
struct NecksUniforms {
  float frame[3], radius;
  float dt, keep, padding0, padding1;
};

static_assert(sizeof(NecksUniforms) == 32 && sizeof(SpawnUniforms) == 48 && sizeof(IntegrateUniforms) == 64 && sizeof(MergeUniforms) == 48);

}  // namespace rainref::drops
