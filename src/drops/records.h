// What the passes that move drops exchange as arrays of records: sizes are multiples of 16 bytes and every gap is a named
// padding member, so that the bytes serve every GPU language.
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
  float position[2];
  float velocity[2];  ///< [1/s]
  float mass;         ///< as-published: 1 is an ordinary drop; corrected: a whole number of mass units, at most 2^24
  float life;         ///< what remains [s]
  std::uint32_t id;   ///< its own for ever, ascending in the order of birth
  float padding0;

  static scene::UniformBlock layout();
  /// What the floats ordinarily are: how wide a bound of them may be and still say something.
  static const std::vector<capture::FieldRange>& ranges(bool corrected);
};
/// The mass unit: water [kg].
constexpr double mass_unit = 2e-11;
/// Mass units that one drop, or one texel of film, holds at most: up to here floats count without gaps.
constexpr float most_mass = 0x1p24f;

/// The mass of one size class of arriving drops, as Drop::mass.
struct SpawnMass {
  float mass;
};
/// A random word not below k thresholds draws first_count + k drops.
struct CountThreshold {
  std::uint32_t threshold;
};

/// What moves drops on a glass, in glass coordinates: the one output of windshield_frame.
struct GlassFrame {
  float gravity[2];       ///< as-published: gravity; corrected: specific force at (0, 0), the car's motion included [1/s^2]
  float wind[2];          ///< apparent wind [1/s]
  float acceleration[2];  ///< as-published: of the vehicle; corrected: 0, it is in `gravity` [1/s^2]
  std::uint32_t id;       ///< 0
  float padding0;
  float spin[4];      ///< corrected: specific force per glass coordinate, rows u and v [1/s^2]
  float coriolis[4];  ///< corrected: specific force per velocity, rows u and v [1/s]

  static scene::UniformBlock layout();
  static const std::vector<capture::FieldRange>& ranges(bool corrected);
};

/// corrected: what is left of the outline of two drops that became one, which hysteresis pins for a while.
struct Neck {
  float offset[2];   ///< of the smaller one's middle from the larger one's, in axes of the plane [base radii of both together]
  float share;       ///< of the smaller one in the mass of both
  float left;        ///< 1 when they became one, 0 where their drop is round again
  std::uint32_t id;  ///< of their drop
  float padding0, padding1, padding2;

  static scene::UniformBlock layout();
  static const std::vector<capture::FieldRange>& ranges(bool corrected);
};

static_assert(sizeof(Neck) == 32 && sizeof(Drop) == 32 && sizeof(GlassFrame) == 64);

}  // namespace rainref::drops
