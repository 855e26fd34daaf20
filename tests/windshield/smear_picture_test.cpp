// What is seen through the film that blades leave.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "image/images.h"
#include "math/half.h"
#include "windshield/golden_scenes.h"
#include "windshield/surface/surface.h"

namespace rainref::windshield {
namespace {

constexpr double degrees = 3.14159265358979323846 / 180;

TEST(Smear, DeflectionsShareOutTheLightToBothSidesAlike) {
  for (const double spread : {0.5, 3.5, 20.0}) {
    SmearSettings s;
    s.spread_deg = spread;
    const std::vector<Deflection> all = deflections(s);
    ASSERT_EQ(static_cast<int>(all.size()), soften_uniforms(s, {}, 640).deflection_count);
    double sum = 0, mean = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      sum += static_cast<double>(all[k].weight);
      mean += static_cast<double>(all[k].weight * all[k].tangent);
      EXPECT_EQ(all[k].tangent, -all[all.size() - 1 - k].tangent);
      EXPECT_EQ(all[k].weight, all[all.size() - 1 - k].weight);
      if (k > 0 && 2 * k < all.size()) {
        EXPECT_GT(all[k].weight, all[k - 1].weight);
      }
    }
    EXPECT_NEAR(sum, 1, 1e-6);  // each rounded once
    EXPECT_EQ(mean, 0);
    EXPECT_NEAR(all.back().tangent, std::tan(spread * degrees), 1e-6);
  }
}

// A level's texel is between 2/3 and 4/3 of what lies between two lookups, where that is 1 texel or more.
TEST(Smear, LookupsAreAsFarApartAsTheirLevelsTexels) {
  PictureSettings p;
  p.camera_position = {-0.25, 0, 1.16};
  p.camera_target = {10, 0, 1.13};
  for (const double spread : {2.0, 3.5, 7.0, 20.0}) {
    for (const int width : {320, 1280, 4096}) {
      p.width = width;
      p.height = width / 2;
      SmearSettings s;
      s.spread_deg = spread;
      const SoftenUniforms u = soften_uniforms(s, composite_uniforms(p, {{{1.0, 0.7, 0.95}, {1.0, -0.7, 0.95}, {0.3, 0.7, 1.3}}}), width);
      const std::vector<Deflection> all = deflections(s);
      const double apart = static_cast<double>((all[1].tangent - all[0].tangent) * u.scene_scale[0]) * width, texel = std::exp2(u.lod);
      EXPECT_EQ(u.lod, std::floor(u.lod));
      EXPECT_LT(apart, 1.5 * texel * (1 + 1e-5)) << spread << ' ' << width;
      if (u.lod > 0) {
        EXPECT_GE(apart, 0.75 * texel * (1 - 1e-5)) << spread << ' ' << width;
      }
    }
  }
}

Windshield after(const std::string& more, int frames, const parallel::Executor& executor) {
  Windshield w(config_of("corrected", wet_drive + ("[rain]\nrate = 120\nsmallest_drop = 0.8\n[smear]\n" + more)), small_surroundings(),
               executor);
  for (int n = 0; n < frames; ++n) w.simulate(), w.render();
  return w;
}
TEST(Smear, OfNoneThePictureIsWhatItWas) {
  const parallel::Executor executor(2);
  const Windshield without = after("on = false\n", 20, executor), none = after("on = true\nmost = 0\n", 20, executor),
                   some = after("on = true\n", 20, executor);
  EXPECT_TRUE(same(without.colour(), none.colour()));
  EXPECT_FALSE(same(without.colour(), some.colour()));
  EXPECT_TRUE(same(without.height(), some.height())) << "it is no water of the drops";
}

// A small lamp before black, behind glass that looks straight at it and that a blade has wiped from below: its light is drawn out along
// the blade as far as the deflections have variance, across it not at all.
TEST(Smear, ALampIsDrawnOutAcrossTheArcs) {
  constexpr int side = 256, lamp = 127;
  const std::string text =
      "[run]\nsize = [256, 256]\nfps = 60\n[wipers]\ncount = 1\narrangement = 'custom'\ncycles_per_minute = 60\npivot_0 = [0.5, -0.4]\n"
      "inner_radius_0 = 0.3\nouter_radius_0 = 1.5\nstart_angle_0 = 30\nsweep_0 = 120\n[rain]\nrate = 0\n[windshield]\ncorner_0 = [1, 0.5, "
      "1]\ncorner_1 = [1, -0.5, 1]\ncorner_2 = [1, 0.5, 2]\nheight_size = [256, 256]\n[vehicle]\nspeed = 0\n[scene]\nmargin = 1.5\n"
      "[camera]\nposition = [0, 0, 1.5]\ntarget = [10, 0, 1.5]\nvertical_fov_deg = 40\n[blur]\nfog_density = 0\n[composite]\n"
      "wetness = 0\ninner = 0\n[smear]\non = true\ndrying = 60\n";
  const parallel::Executor executor(2);
  Surroundings around{Image(Format::rgba16f, side, side), Image(Format::r32f, side, side)};
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const bool is_lamp = x >= lamp && x < lamp + 2 && y >= lamp && y < lamp + 2;
      for (int c = 0; c < 4; ++c) around.colour.row<Half>(y)[4 * x + c] = to_half(is_lamp || c == 3 ? 1000.0f : 0.0f);
      around.depth.row<float>(y)[x] = 100;
    }
  }
  Windshield w(config_of("corrected", text), std::move(around), executor);
  for (int n = 0; n < 30; ++n) w.simulate(), w.render();  // the whole sweep
  ASSERT_GT(to_float(w.smear().row<Half>(128)[4 * 128 + 2]), 0.05) << "smeared";
  double sum = 0, xx = 0, yy = 0, within = 0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double light = to_float(w.colour().row<Half>(y)[4 * x]), dx = x + 0.5 - side / 2.0, dy = y + 0.5 - side / 2.0;
      if (std::hypot(dx, dy) < 2.5) continue;  // the lamp itself
      sum += light;
      xx += light * dx * dx;
      yy += light * dy * dy;
      within += std::abs(dx) < 4 && std::abs(dy) < 36 ? light : 0;
    }
  }
  ASSERT_GT(sum, 0);
  EXPECT_GT(yy, 30 * xx);
  // Weights that fall as (1 - t)^2 to t = 17/16 of 21.5 pixels (below) have a tenth of its square as variance; the lamp's own pixels,
  // which are left out, and its two texels add some.
  EXPECT_NEAR(yy / sum, 0.1 * (21.5 * 17 / 16) * (21.5 * 17 / 16), 4);
  // tan 3.5 degrees of the image plane, whose half is tan 20 degrees, is 21.5 pixels; then a texel or two of the level.
  EXPECT_GT(within, 0.999 * sum);
}

}  // namespace
}  // namespace rainref::windshield
