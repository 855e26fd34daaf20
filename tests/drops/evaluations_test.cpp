// The texts of this room in every evaluation: they compile, agree, and enclose.
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

class DropsEvaluations : public testing::Test {
 protected:
  std::vector<Drop> drops_ = test::random_drops(2000, 5, 1e7f);
};

TEST_F(DropsEvaluations, DoubleLiesWithinTheErrorOfFloats) {
  int unequal = 0;
  for (std::size_t i = 0; i + 1 < drops_.size(); ++i) {
    std::vector<scalar::Scalar<float>> motion, whole;
    std::vector<scalar::Scalar<double>> motion_oracle, whole_oracle;
    evaluate(drops_[i], drops_[i + 1], motion, whole);
    evaluate(drops_[i], drops_[i + 1], motion_oracle, whole_oracle);
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

TEST_F(DropsEvaluations, PerturbedWithoutASlipIsTheScalarEvaluation) {
  for (std::size_t i = 0; i + 1 < drops_.size(); i += 10) {
    std::vector<scalar::Scalar<float>> motion, whole;
    std::vector<perturbed::Perturbed> motion_perturbed, whole_perturbed;
    evaluate(drops_[i], drops_[i + 1], motion, whole);
    evaluate(drops_[i], drops_[i + 1], motion_perturbed, whole_perturbed);
    for (std::size_t k = 0; k < motion.size(); ++k) ASSERT_EQ(motion[k].v, motion_perturbed[k].v) << k;
    for (std::size_t k = 0; k < whole.size(); ++k) ASSERT_EQ(whole[k].v, whole_perturbed[k].v) << k;
  }
}

TEST_F(DropsEvaluations, EnclosureHoldsTheScalarEvaluation) {
  for (std::size_t i = 0; i + 1 < drops_.size(); i += 10) {
    std::vector<scalar::Scalar<float>> motion, whole;
    std::vector<enclosed::Enclosure> motion_enclosed, whole_enclosed;
    evaluate(drops_[i], drops_[i + 1], motion, whole);
    evaluate(drops_[i], drops_[i + 1], motion_enclosed, whole_enclosed);
    for (std::size_t k = 0; k < motion.size(); ++k) {
      ASSERT_TRUE(motion_enclosed[k].contains(motion[k].v)) << k << " of " << i;
      ASSERT_LT(motion_enclosed[k].hi - motion_enclosed[k].lo, 1e-4f * std::max(1.0f, std::abs(motion[k].v))) << k << " of " << i;
    }
  }
}

}  // namespace
}  // namespace rainref::drops
