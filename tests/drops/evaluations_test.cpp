// The texts of this room in double lie as near as the rounding of floats allows.
#include <gtest/gtest.h>

#include "drops/motion/scalar.h"
#include "support.h"

namespace rainref::drops {
namespace {

template <class N>
scalar::DropState<N> every_state(const Drop& d) {
  scalar::DropState<N> s;
  s.u = N(d.position[0]);
  s.v = N(d.position[1]);
  s.velocity_u = N(d.velocity[0]);
  s.velocity_v = N(d.velocity[1]);
  s.mass = N(d.mass);
  s.life = N(d.life);
  return s;
}

constexpr double dt = 1.0 / 60;
// Gravity, wind, a turning car: every term of the force counts.
GlassFrame busy_glass() {
  GlassFrame g = test::glass_of(0.8, -4.4, 1.5, 9.0);
  g.acceleration[0] = 0.2f;
  g.acceleration[1] = 0.1f;
  for (int k = 0; k < 4; ++k) {
    g.spin[k] = 0.05f * static_cast<float>(k - 1);
    g.coriolis[k] = 0.1f * static_cast<float>(2 - k);
  }
  return g;
}

// Everything that the texts give for one drop: motion, then whole numbers.
template <class N>
void evaluate(const Drop& drop, const Drop& other, std::vector<N>& motion, std::vector<N>& whole) {
  Settings published;
  published.corrected = false;
  const auto d = every_state<N>(drop), o = every_state<N>(other);
  const GlassFrame glass = busy_glass();
  const auto p = scalar::integrate_as_published<N>(integrate_uniforms(published, {}, dt), glass, d);
  const auto c = scalar::integrate_corrected<N>(integrate_uniforms(Settings(), test::frame, dt), glass, d);
  const MergeUniforms merge = merge_uniforms(Settings(), test::frame, dt, 8, 8, 3);
  const auto both = scalar::absorb<N>(d, o);
  const auto left = scalar::trail<N>(merge, d);
  motion = {p.u,
            p.v,
            p.velocity_u,
            p.velocity_v,
            p.life,
            c.u,
            c.v,
            c.velocity_u,
            c.velocity_v,
            c.life,
            both.u,
            both.v,
            both.velocity_u,
            both.velocity_v,
            left.u,
            left.v,
            scalar::base_radius<N>(merge, d.mass)};
  whole = {c.mass, c.evaporated, c.removed, both.mass, left.mass_units, scalar::dried<N>(merge, N(drop.mass))};
}

TEST(DropsEvaluations, DoubleLiesWithinTheErrorOfFloats) {
  const std::vector<Drop> drops = test::random_drops(2000, 5, 1e7f);
  int unequal = 0;
  for (std::size_t i = 0; i + 1 < drops.size(); ++i) {
    std::vector<scalar::Scalar<float>> motion, whole;
    std::vector<scalar::Scalar<double>> motion_oracle, whole_oracle;
    evaluate(drops[i], drops[i + 1], motion, whole);
    evaluate(drops[i], drops[i + 1], motion_oracle, whole_oracle);
    // All are of order 1 and made by fewer than 60 roundings of 2^-24, of which those of the force, up to 50 per s^2,
    // count by dt: 64 roundings of 1 are a bound.
    for (std::size_t k = 0; k < motion.size(); ++k)
      ASSERT_NEAR(motion[k].v, motion_oracle[k].v, 64 * 0x1p-24 * std::max(1.0, std::abs(motion_oracle[k].v))) << k << " of " << i;
    // Where a rate times life is all but whole, the floor may fall on the other side.
    for (std::size_t k = 0; k < whole.size(); ++k) {
      const double off = std::abs(whole[k].v - whole_oracle[k].v);
      ASSERT_LE(off, std::max(1.0, 1e-5 * std::abs(whole_oracle[k].v))) << k << " of " << i;
      unequal += off > 0;
    }
  }
  EXPECT_LT(unequal, 100);
}

}  // namespace
}  // namespace rainref::drops
