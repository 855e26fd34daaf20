// Records that the passes of moving drops exchange. Sizes are multiples of 16 bytes and every gap is a named padding member, so that the
// bytes are valid in every GPU language.
#pragma once

#include <cstdint>
#include <vector>

namespace rainref::scene {
struct UniformBlock;
}
namespace rainref::capture {
struct FieldRange;
}

namespace rainref::drops {

/// One drop on a glass. Positions are glass coordinates (u, v); a live drop has life > 0.
struct Drop {
  float position[2], velocity[2];
  float mass, life;
  std::uint32_t id;
  float padding0;
  static scene::UniformBlock layout();
  /// Usual ranges of the floats, used to decide when a bound is too wide to be useful.
  static const std::vector<capture::FieldRange>& ranges(bool corrected);
};
/// The mass unit: water [kg].
constexpr double mass_unit = 2e-11;
/// Largest number of mass units in one drop or one texel of film; up to here float represents all integers.
constexpr float most_mass = 0x1p24f;

/// The mass of one size class of arriving drops; see Drop::mass.
struct SpawnMass {
  float mass;
};
/// A random word at or above k thresholds draws first_count + k drops.
struct CountThreshold {
  std::uint32_t threshold;
};

/// Forces on drops in glass coordinates: the only output of windshield_frame.
struct GlassFrame {
  float gravity[2], wind[2];
  float acceleration[2];
  std::uint32_t id;
  float padding0;
  float spin[4];
  float coriolis[4];
  static scene::UniformBlock layout();
  static const std::vector<capture::FieldRange>& ranges(bool corrected);
};

/// corrected: the remaining outline of two merged drops, which hysteresis pins for a while.
struct Neck {
  float offset[2], share, left;
  std::uint32_t id;
  float padding0, padding1, padding2;
  static scene::UniformBlock layout();
  static const std::vector<capture::FieldRange>& ranges(bool corrected);
};

static_assert(sizeof(Neck) == 32 && sizeof(Drop) == 32 && sizeof(GlassFrame) == 64);

}  // namespace rainref::drops
