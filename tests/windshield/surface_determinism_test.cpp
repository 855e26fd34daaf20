// Every SIMD target, 1, 2, 3 and 8 threads, shuffled tiles and widths 1 to 33 give the bits of one plain float after another.
#include <gtest/gtest.h>

#include <bit>

#include "math/simd_target.h"
#include "windshield/surface_support.h"

namespace rainref::windshield {
namespace {

using F = scalar::Scalar<float>;
using D = scalar::Scalar<double>;

void fill(Image& image, unsigned seed, double scale) {
  std::mt19937 words(seed);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) image.row<Half>(y)[x] = to_half(static_cast<float>(scale * (words() >> 8) * 0x1p-24));
  }
}
Half stored(F x, Rounding rounding) {
  Half h;
  store(&h, x, rounding);
  return h;
}
std::vector<Wiper> wipers(const SurfaceSettings& s) {
  Blade left;
  left.pivot_x = 0.3;
  left.half_width = 0.05;
  Blade right = left;
  right.pivot_x = 0.9;
  return {wiper(s, left, 0.7, 1.2), wiper(s, right, 1.3, 0.9), wiper(s, left, 2, 2)};
}
/// The texels around (x, y) as N, the nearest one standing beyond the edge.
template <class N>
struct Around {
  const Image &heights, &masks;
  int x, y;
  static N at(const Image& image, int column, int row) {
    return N::load(image.row<Half>(std::clamp(row, 0, image.height() - 1)) + std::clamp(column, 0, image.width() - 1));
  }
  N height(int dx, int dy) const { return at(heights, x + dx, y + dy); }
  N mask(int dx, int dy) const { return at(masks, x + dx, y + dy); }
};
template <class N>
scalar::Vec3<N> normal_at(const NormalsUniforms& u, bool corrected, const Around<N>& around) {
  return corrected ? scalar::normal_of<N, true>(u, around) : scalar::normal_of<N, false>(u, around);
}

TEST(SurfaceDeterminism, EveryTargetThreadCountOrderAndWidthGivesThePlainBits) {
  parallel::Executor executors[] = {parallel::Executor(1), parallel::Executor(2), parallel::Executor(3), parallel::Executor(8)};
  int covered = 0, uncovered = 0;
  for (int width = 1; width <= 33; ++width) {
    for (const bool corrected : {false, true}) {
      SurfaceSettings s = settings_on(corrected, width, 29, 75 * pi / 180);
      s.rounding = width % 2 ? Rounding::rtz : Rounding::rne;
      s.wipe_strength = 0.7;
      s.half_width = 0.05;
      WipeTextureUniforms u = wipe_texture_uniforms(s, 3);
      const std::vector<Wiper> blades = wipers(s);
      for (const std::string& target : simd_targets()) {
        select_simd_target(target);
        for (parallel::Executor& executor : executors) {
          executor.shuffle_tiles(static_cast<std::uint64_t>(executor.threads() + width));
          Glass glass(s, 0);
          fill(glass.height, 1, 2);
          fill(glass.mask, 2, 1);
          if (corrected) {
            for (int y = 0; y < s.height; ++y) {
              for (int x = 0; x < width; ++x) glass.wiped.row<float>(y)[x] = 0.25f * static_cast<float>((x + 3 * y) % 31);
            }
          }
          const Glass& before = glass;
          // Copies by value of what the pass is about to overwrite.
          std::vector<Half> heights, masks;
          std::vector<float> times;
          for (int y = 0; y < s.height; ++y) {
            for (int x = 0; x < width; ++x) {
              heights.push_back(before.height.row<Half>(y)[x]);
              masks.push_back(before.mask.row<Half>(y)[x]);
              times.push_back(corrected ? before.wiped.row<float>(y)[x] : 0);
            }
          }
          glass.wipe(blades, 3, executor);
          u.wiper_count = static_cast<std::int32_t>(blades.size());
          for (int y = 0; y < s.height; ++y) {
            for (int x = 0; x < width; ++x) {
              const std::size_t i = static_cast<std::size_t>(y) * width + x;
              const F h = F::load(&heights[i]), m = F::load(&masks[i]);
              const F c = corrected ? scalar::wipe_coverage_corrected<F>(u, blades.data(), x, y)
                                    : scalar::wipe_coverage_as_published<F>(u, blades.data(), x, y);
              (c.v > 0 ? covered : uncovered) += 1;
              F height(0), mask(0);
              if (corrected) {
                const F since = scalar::time_since_wipe(u, F(times[i]), c);
                ASSERT_EQ(std::bit_cast<std::uint32_t>(glass.wiped.row<float>(y)[x]), std::bit_cast<std::uint32_t>(since.v + 0.0f))
                    << target;
                height = scalar::wiped_height_corrected(h, c);
                mask = scalar::wiped_mask_corrected(u, since);
              } else {
                height = scalar::wiped_height_as_published(u, h, c);
                mask = scalar::wiped_mask_as_published(u, m, c);
              }
              ASSERT_EQ(glass.height.row<Half>(y)[x].bits, stored(height, s.rounding).bits) << target << " " << x << " " << y;
              ASSERT_EQ(glass.mask.row<Half>(y)[x].bits, stored(mask, s.rounding).bits) << target << " " << x << " " << y;
            }
          }
          Image normal(Format::rgba16f, width, s.height);
          run_normals(executor, s, glass.height, glass.mask, normal);
          for (int y = 0; y < s.height; ++y) {
            for (int x = 0; x < width; ++x) {
              const NormalsUniforms n = normals_uniforms(s);
              const auto v = normal_at(n, corrected, Around<F>{glass.height, glass.mask, x, y});
              const Half* got = normal.row<Half>(y) + 4 * x;
              ASSERT_EQ(got[0].bits, stored(v.x, s.rounding).bits) << target << " " << x << " " << y;
              ASSERT_EQ(got[1].bits, stored(v.y, s.rounding).bits);
              ASSERT_EQ(got[2].bits, stored(v.z, s.rounding).bits);
              ASSERT_EQ(got[3].bits, stored(F(1.0f), s.rounding).bits);
            }
          }
        }
      }
      select_simd_target("");
    }
  }
  EXPECT_GT(covered, 10000);
  EXPECT_GT(uncovered, 10000);
}

TEST(SurfaceDeterminism, FloatsAreWithinRoundingOfDoubles) {
  for (const bool corrected : {false, true}) {
    SurfaceSettings s = settings_on(corrected, 640, 366, 75 * pi / 180);
    WipeTextureUniforms u = wipe_texture_uniforms(s, 3);
    const std::vector<Wiper> blades = wipers(s);
    u.wiper_count = static_cast<std::int32_t>(blades.size());
    Image height = filled(640, 366, 0), mask = make_mask(s);
    fill(height, 3, 2);
    fill(mask, 4, 1);
    const NormalsUniforms n = normals_uniforms(s);
    for (int y = 0; y < s.height; y += 2) {
      for (int x = 0; x < s.width; x += 3) {
        const auto coverage = [&](auto one) {
          using N = decltype(one);
          return corrected ? scalar::wipe_coverage_corrected<N>(u, blades.data(), x, y)
                           : scalar::wipe_coverage_as_published<N>(u, blades.data(), x, y);
        };
        // Distances of up to 1.6 m after some ten roundings, over an edge of 2.2 mm.
        ASSERT_NEAR(coverage(F(0.0f)).v, coverage(D(0.0f)).v, 10 * 0x1p-23 * 1.6 / 2.1e-3);
        const auto f = normal_at(n, corrected, Around<F>{height, mask, x, y});
        const auto d = normal_at(n, corrected, Around<D>{height, mask, x, y});
        // A slope of up to 2 with six roundings, taps reduced by the mask included; normalizing adds four.
        ASSERT_NEAR(f.x.v, d.x.v, 10 * 0x1p-22);
        ASSERT_NEAR(f.y.v, d.y.v, 10 * 0x1p-22);
        ASSERT_NEAR(f.z.v, d.z.v, 10 * 0x1p-22);
      }
    }
  }
}

}  // namespace
}  // namespace rainref::windshield
