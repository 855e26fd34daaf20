// How far floats are from doubles. Their bits: determinism_test.cpp.
#include <gtest/gtest.h>

#include "windshield/scalar.h"
#include "windshield/support.h"

namespace rainref::windshield {
namespace {

template <class N>
scalar::DropState<N> drop_of(const DropArrays& d, std::size_t i) {
  scalar::DropState<N> drop;
  drop.u = N(d.u[i]);
  drop.v = N(d.v[i]);
  drop.velocity_u = N(d.velocity_u[i]);
  drop.velocity_v = N(d.velocity_v[i]);
  drop.mass = N(d.mass[i]);
  drop.life = N(d.life[i]);
  return drop;
}
template <class N>
scalar::WipedDrop<N> wiped(const WipeDropsUniforms& u, bool corrected, const std::vector<Wiper>& w, const DropArrays& d, std::size_t i) {
  return corrected ? scalar::wipe_drop_corrected<N>(u, w.data(), drop_of<N>(d, i))
                   : scalar::WipedDrop<N>(scalar::wipe_drop_as_published<N>(u, w.data(), drop_of<N>(d, i)));
}

struct Step {
  std::vector<Wiper> wipers;
  WipeDropsUniforms uniforms;
};
Step step(bool corrected) {
  const Glass glass = make_glass({{{1.9, 0.7, 1.0}, {1.9, -0.7, 1.1}, {1.2, 0.8, 1.4}}});  // sheared
  WiperSettings s = default_wipers(glass);
  Step out{wipers_between(s, corrected ? glass.plane() : glass.axes(), 0.3, 0.8, corrected), {}};
  out.uniforms = wipe_drops_uniforms(glass, corrected, static_cast<int>(out.wipers.size()), {}, radius_scale, 0, 0);
  return out;
}

// Where both evaluations decide alike they differ by the rounding of a few operations on metres: 4 ULP of 1 in place, as
// much of 3 m/s over 0.8 m in velocity. They decide alike but for drops within 1e-6 m of an outline.
TEST(MotionPrecision, FloatsAreNearTheDoubleReading) {
  for (const bool corrected : {false, true}) {
    const Step s = step(corrected);
    const DropArrays drops = random_drops(20000, 11);
    int different = 0, moved = 0;
    for (std::size_t i = 0; i < drops.size(); ++i) {
      const auto f = wiped<scalar::Scalar<float>>(s.uniforms, corrected, s.wipers, drops, i);
      const auto d = wiped<scalar::Scalar<double>>(s.uniforms, corrected, s.wipers, drops, i);
      const bool alike = corrected ? f.wiper.v == d.wiper.v
                                   : (f.mass.v == drops.mass[i]) == (d.mass.v == drops.mass[i]) && std::abs(f.mass.v - d.mass.v) < 0.03;
      if (!alike) {
        ++different;
        continue;
      }
      moved += f.u.v != drops.u[i];
      EXPECT_NEAR(f.u.v, d.u.v, 5e-7);
      EXPECT_NEAR(f.v.v, d.v.v, 5e-7);
      EXPECT_NEAR(f.velocity_u.v, d.velocity_u.v, 3e-6);
      EXPECT_NEAR(f.velocity_v.v, d.velocity_v.v, 3e-6);
    }
    EXPECT_GT(moved, 1000);
    EXPECT_LE(different, 5);
  }
}

}  // namespace
}  // namespace rainref::windshield
