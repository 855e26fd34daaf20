// The known_defects of the article that concern light and display: as-published reproduces each, corrected does not.
// Numbers are those of docs/effects/puddle.md.
#include <set>

#include <gmock/gmock.h>

#include "puddle/scene_support.h"

namespace rainref::puddle::test {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

// Red of level water at y = 0, over a bed 1 m deep, that a ray falling by `fall` meets: shade alone, in double.
double shaded(const Settings& s, double fall, float radiance, float albedo) {
  ShadeUniforms u = shade_uniforms(s);
  u.camera = single_ray({0, 10, 0}, falling(fall));
  for (float& a : u.ambient) a = radiance;
  const TextureData sky({radiance, radiance, radiance, 1}, 4, 1, 1, Address::repeat, Address::clamp);
  const TextureData ground({albedo, albedo, albedo, 1}, 4, 1, 1, Address::repeat, Address::repeat);
  const TextureData relief({0, 0}, 2, 1, 1, Address::repeat, Address::repeat), bed({1}, 1, 1, 1, Address::clamp, Address::clamp);
  const Double zero(0.0f), one(1.0f);
  const scalar::Surface<Double> surface{Vec3<Double>(zero, zero, zero), Vec3<Double>(zero, one, zero), one};
  return s.variant == Variant::corrected
             ? scalar::shade_corrected(u, sky.view(), ground.view(), relief.view(), bed.view(), surface, 0, 0).x.v
             : scalar::shade_as_published(u, sky.view(), ground.view(), surface, Double(0.5f), 0, 0).x.v;
}

// The weight of the sky is F (mix(.3, .8, r) - .3) + .3: never below .3, never above .8, and without Fresnel at r = 0.
TEST(PuddleKnownDefects, Defect15_ReflectionWeightHasAFloorAndACeiling) {
  Settings s = as_published(1, 1), c = corrected(1, 1);
  const double f0 = 0.0203732;
  s.reflectivity = 0;
  EXPECT_NEAR(shaded(s, 1, 1, 0), 0.3, 1e-6);
  EXPECT_NEAR(shaded(s, 0.01, 1, 0), 0.3, 1e-6) << "grazing";
  s.reflectivity = 1;
  EXPECT_NEAR(shaded(s, 1, 1, 0), 0.5 * f0 + 0.3, 1e-6);
  EXPECT_LE(shaded(s, 1e-4, 1, 0), 0.8 + 1e-6);
  EXPECT_GT(shaded(s, 1e-4, 1, 0), 0.799);
  // Corrected: reflectivity times Fresnel's reflectance, from 2 % at normal incidence to 1 at grazing.
  c.reflectivity = 0;
  EXPECT_EQ(shaded(c, 1, 1, 0), 0);
  c.reflectivity = 1;
  EXPECT_NEAR(shaded(c, 1, 1, 0), f0, 1e-6);
  EXPECT_NEAR(shaded(c, std::cos(60 * degree), 1, 0), .059691, 1e-6);
  EXPECT_GT(shaded(c, 1e-3, 1, 0), 0.99);
}

// Light is attenuated on one way only, and the tint enters three times.
TEST(PuddleKnownDefects, Defect16_BeerIsOneWayAndTheTintCountsThreeTimes) {
  Settings s = as_published(1, 1);
  s.puddle_depth = 5;
  s.reflectivity = 0;
  const auto at = [](Settings t, double turbidity, double tint, float radiance, float albedo) {
    t.water_turbidity = turbidity;
    t.tint = {tint, tint, tint};
    return shaded(t, 1, radiance, albedo);
  };
  // The surface of shaded() is at y = 0, so that the path is the depth.
  EXPECT_NEAR(at(s, 0.3, 0, 0, 1) / at(s, 0, 0, 0, 1), std::exp(-0.3 * 5), 1e-6);
  // Opaque water under a black sky: the body's colour, the filter of 0.7 (1 - tint / 2), and 0.15 (1 - F) tint on top.
  const double f0 = 0.0203732, t = 0.4;
  EXPECT_NEAR(at(s, 100, t, 0, 0), 0.7 * (0.7 * (1 - 0.5 * t) * t) + 0.15 * (1 - f0) * t, 1e-6);
  // Corrected: down and up again, and the tint once, lit by the surroundings.
  Settings c = corrected(1, 1);
  c.reflectivity = 0;
  EXPECT_NEAR(at(c, 0.3, 0, 1, 1) / at(c, 0, 0, 1, 1), std::exp(-0.3 * 2), 1e-6) << "the bed of shaded() is 1 m deep";
  EXPECT_NEAR(at(c, 100, t, 1, 0), t, 1e-6);
  EXPECT_NEAR(at(c, 100, 2 * t, 1, 0), 2 * t, 1e-6);
  EXPECT_EQ(at(c, 100, t, 0, 0), 0) << "no light, no colour";
}

// Above sqrt(2) the vignette is negative in the corners, and the power of a negative number is a NaN on a GPU.
TEST(PuddleKnownDefects, Defect18_VignetteBeyondRootTwoIsRefused) {
  Settings s = as_published(1000, 1000);
  s.vignette = 1.5;
  EXPECT_LT(scalar::vignette<Double>(display_uniforms(s), 0, 0).v, 0);
  for (const char* variant : {"as-published", "corrected"}) {
    EXPECT_THAT(error_of([&] { config_of(variant, {"puddle.vignette=1.42"}); }), HasSubstr("puddle.vignette")) << variant;
  }
  s.vignette = config_of("as-published", {"puddle.vignette=1.414213"}).real("puddle.vignette");
  EXPECT_GE(scalar::vignette<Double>(display_uniforms(s), 0, 0).v, 0);
  // Corrected holds it at black besides.
  Settings c = corrected(1000, 1000);
  c.vignette = 3;
  const Vec3<Double> white(Double(1.0f), Double(1.0f), Double(1.0f));
  EXPECT_EQ(scalar::display_corrected(display_uniforms(c), white, 0, 0).x.v, 0);
}

// fract(sin(dot) * 43758.5453): a ground point that moves by a rounding error gets another number.
TEST(PuddleKnownDefects, Defect21_CheckerNoiseIsChaotic) {
  GroundNoiseUniforms u = ground_noise_uniforms(as_published(1, 1));
  u.camera = single_ray({0, 18, 0}, {0, -1, 0});
  const auto noise = [&](auto x) {
    using N = scalar::Scalar<decltype(x)>;
    const N zero(0.0f), one(1.0f);
    return static_cast<double>(
        scalar::ground_noise_as_published<N>(u, scalar::Surface<N>{Vec3<N>(N(x), N(4.5f), zero), Vec3<N>(zero, one, zero), one}, 0, 0).v);
  };
  int differ = 0;
  for (int i = 1; i <= 200; ++i) {
    const float x = static_cast<float>(0.1713 * i);
    differ += std::abs(noise(static_cast<double>(x)) - noise(x)) > 0.01;  // the same point, another precision
  }
  EXPECT_GT(differ, 100);
  // So as-published records it as a pass of its own, which is given to shade as data; corrected has none.
  class Names : public Recorder {
   public:
    void pass(const PassCall& call) override { names.insert(std::string(call.pass)); }
    std::set<std::string> names;
  };
  const auto passes = [](const Settings& s) {
    Puddle p(s, uniform_surroundings(1, 0.5f), executor());
    Names names;
    p.simulate(&names);
    p.render(&names);
    return names.names;
  };
  EXPECT_THAT(passes(as_published(2, 2)), Contains("ground_noise"));
  EXPECT_THAT(passes(corrected(2, 2)), Not(Contains("ground_noise")));
}

}  // namespace
}  // namespace rainref::puddle::test
