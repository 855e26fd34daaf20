// The local bounds of the march: brute force over the texels they must hold for.
#include "puddle/bounds.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "puddle/host.h"
#include "math/simd_target.h"
#include "puddle/kernels.h"
#include "random/counter.h"
#include "rainref/executor.h"
#include "settings.h"

namespace rainref::puddle::test {
namespace {

// Every width of a last block, every SIMD target.
TEST(PuddleBounds, HoldForEveryTexelOfTheNineBlocks) {
  for (const std::string& target : simd_targets()) {
    select_simd_target(target);
    const parallel::Executor executor(2);
    for (int width = 32; width <= 97; width += 13) {
      Settings s = rainref::test::puddle_settings();
      s.camera_position = {0, 1, 1};
      s.grid = {width, 70};
      std::vector<float> water;
      for (int i = 0; i < width * 70; ++i) {
        const auto b = random::block(3, random::Purpose::puddle_bed, static_cast<std::uint32_t>(i), 0);
        // Heights differ by orders of magnitude, so that one block's bound cannot serve another's.
        water.push_back(static_cast<float>((random::uniform(b[0]) - 0.5) * std::exp2(-12.0 * random::uniform(b[1]) - (i % width) / 16)));
      }
      SurfaceHitUniforms u = surface_hit_uniforms(s);
      const TextureData bounds = surface_bounds(s, water.data(), executor, u);
      const Texture& t = bounds.view();
      ASSERT_EQ(t.width[0], (width + 31) / 32);
      ASSERT_EQ(t.height[0], 3);
      const auto at = [&](int x, int y) -> double {
        return x < 0 || y < 0 || x >= width || y >= 70 ? 0 : water[static_cast<std::size_t>(y) * width + x];
      };
      double all_top = 0, all_slope = 0;
      for (int by = 0; by < 3; ++by) {
        for (int bx = 0; bx < t.width[0]; ++bx) {
          double top = 0, difference = 0;
          for (int y = std::max(0, 32 * (by - 1)); y < std::min(70, 32 * (by + 2)); ++y) {
            for (int x = std::max(0, 32 * (bx - 1)); x < std::min(width, 32 * (bx + 2)); ++x) {
              top = std::max(top, std::abs(at(x, y)));
              difference = std::max({difference, std::abs(at(x + 1, y) - at(x, y)), std::abs(at(x, y + 1) - at(x, y))});
              if (x == 0) difference = std::max(difference, std::abs(at(x, y)));
              if (y == 0) difference = std::max(difference, std::abs(at(x, y)));
            }
          }
          const double slope = std::sqrt(2.0) * difference / s.cell_size;
          const float* texel = t.texels + 2 * (by * t.width[0] + bx);
          // One rounding to float on top of the margins that bounds.cpp adds.
          EXPECT_NEAR(texel[0], top + 1e-4, 1e-7 * (top + 1)) << target << " " << width << " block " << bx << " " << by;
          EXPECT_NEAR(texel[1], slope + 1e-3, 1e-6 * (slope + 1)) << target << " " << width << " block " << bx << " " << by;
          all_top = std::max(all_top, static_cast<double>(texel[0]));
          all_slope = std::max(all_slope, static_cast<double>(texel[1]));
        }
      }
      EXPECT_EQ(u.surface_top, static_cast<float>(all_top));
      EXPECT_EQ(u.surface_slope, static_cast<float>(all_slope));
    }
  }
  select_simd_target("");
}

}  // namespace
}  // namespace rainref::puddle::test
