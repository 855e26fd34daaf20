// The texts of this room in every reading: they compile, agree, and enclose.
#include <gtest/gtest.h>

#include "drops/every_reading.h"

namespace rainref::drops {
namespace {

template <class N>
every::DropState<N> state(float u, float v, float velocity_u, float velocity_v, float mass, float life) {
  every::DropState<N> s;
  s.u = N(u);
  s.v = N(v);
  s.velocity_u = N(velocity_u);
  s.velocity_v = N(velocity_v);
  s.mass = N(mass);
  s.life = N(life);
  return s;
}
constexpr IntegrateUniforms uniforms{{1.4f, 0.1f, 0.8f}, 1.0f / 60, 1, 0.33f, 12, 2.0f, 1.0e5f, 0.5f, 0.02f, 1e-6f};
constexpr GlassFrame glass{{0.1f, -6}, {0.4f, 9}, {0.2f, 0.1f}, 0, 0, {0.1f, 0.2f, -0.1f, 0.3f}, {0, 0.2f, -0.3f, 0}};

template <class N>
std::vector<N> everything() {
  const auto d = state<N>(0.5f, 0.4f, 0.1f, -0.2f, 1.7e6f, 20.0f), other = state<N>(0.501f, 0.4f, 0.3f, -0.1f, 2.1e6f, 30.0f);
  const auto published = every::integrate_as_published<N>(uniforms, glass, d);
  const auto corrected = every::integrate_corrected<N>(uniforms, glass, d);
  const MergeUniforms merge{{1.4f, 0.1f, 0.8f}, 3.4e-5f, 1e8f, 1.0f / 60, {8, 8}};
  const auto both = every::absorb<N>(d, other);
  const auto left = every::trail<N>(merge, d);
  return {published.u, published.v, published.velocity_u, published.velocity_v, published.life, corrected.drop.u, corrected.drop.v, corrected.drop.velocity_u, corrected.drop.velocity_v,
          corrected.drop.mass, corrected.drop.life, corrected.evaporated, both.u, both.v, both.velocity_u, both.mass, left.u, left.v, left.quanta, every::base_radius<N>(merge, d.mass)};
}

TEST(DropsReadings, DoubleLiesWithinTheErrorOfFloats) {
  const auto single = everything<plain::Plain<float>>();
  const auto oracle = everything<plain::Plain<double>>();
  for (std::size_t i = 0; i < single.size(); ++i) {
    // A dozen roundings of 2^-24 each; whole numbers (quanta) agree exactly here.
    EXPECT_NEAR(single[i].v, oracle[i].v, 12 * 0x1p-24 * (1 + std::abs(oracle[i].v)) * (std::abs(oracle[i].v) > 1e4 ? 0 : 1)) << i;
  }
}

TEST(DropsReadings, DeviantWithoutASlipIsThePlainReading) {
  const auto single = everything<plain::Plain<float>>();
  const auto deviant = everything<deviant::Deviant>();
  for (std::size_t i = 0; i < single.size(); ++i) EXPECT_EQ(deviant[i].v, single[i].v) << i;
}

TEST(DropsReadings, EnclosureHoldsThePlainReadingTightly) {
  const auto single = everything<plain::Plain<float>>();
  const auto enclosed = everything<enclosed::Enclosure>();
  for (std::size_t i = 0; i < single.size(); ++i) {
    EXPECT_LE(enclosed[i].lo, single[i].v) << i;
    EXPECT_GE(enclosed[i].hi, single[i].v) << i;
    EXPECT_LT(enclosed[i].hi - enclosed[i].lo, 1e-4f * (1 + std::abs(single[i].v))) << i;
  }
}

}  // namespace
}  // namespace rainref::drops
