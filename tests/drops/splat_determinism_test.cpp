// Every SIMD target, 1, 2, 3 and 8 threads, shuffled work and widths 1 to 33 give the bits of one plain float after another.
#include <gtest/gtest.h>

#include "drops/splat_support.h"
#include "image/images.h"
#include "math/simd_target.h"

namespace rainref::drops {
namespace {

using F = scalar::Scalar<float>;
using D = scalar::Scalar<double>;

struct Case {
  SplatSettings settings;
  double mass;
  bool film;
  Pull pull = {};
  bool necks = false;
  std::vector<Neck> necks_of(const std::vector<Drop>& drops) const { return necks ? any_necks(drops, 3) : std::vector<Neck>(); }
};
std::vector<Case> cases(int width, int height) {
  std::vector<Case> all;
  for (int k = 0; k < 5; ++k) {
    for (const bool corrected : {false, true}) {
      for (const SplatBlend blend : {SplatBlend::add, SplatBlend::max}) {
        for (const double radius : {0.02, 0.3}) {  // less than a vector, and more
          SplatSettings s = settings_on(sheared_glass, corrected, width, height, static_cast<SplatKernel>(k));
          s.keys.blend = blend;
          s.keys.rounding = k % 2 ? Rounding::rtz : Rounding::rne;
          s.keys.drop_radius = radius;
          const double mass = corrected ? std::pow(radius / splat_uniforms(s).radius_scale, 3) : 1;
          all.push_back({s, mass, corrected});
          if (corrected) {
            // The largest of any_drops slide.
            SplatSettings leaning = s;
            leaning.keys.lean = 1;
            const double root = std::cbrt(mass);
            const Pull pull{{0.3 / (root * root), -1.2 / (root * root)}, {0.4 / root, 0.5 / root}, {0.9, 0.3}};
            all.push_back({leaning, mass, true, pull});
            all.push_back({k % 2 ? leaning : s, mass, true, k % 2 ? pull : Pull(), true});
          }
          if (!corrected) {
            s.keys.half_accumulation = false;
            all.push_back({s, mass, false});
          }
        }
      }
    }
  }
  return all;
}
Image plain_image(const SplatSettings& s, const std::vector<Drop>& drops, const Image* film, const Pull& pull,
                  const std::vector<Neck>& necks) {
  const SplatUniforms u = splat_uniforms(s, pull);
  const auto stamps = stamps_of<F>(u, drops, necks);
  Image image(Format::r16f, s.keys.width, s.keys.height);
  for (int y = 0; y < s.keys.height; ++y) {
    for (int x = 0; x < s.keys.width; ++x) {
      store(image.row<Half>(y) + x, plain_texel<F>(u, s.keys.half_accumulation, s.keys.rounding, stamps, film, x, y), s.keys.rounding);
    }
  }
  return image;
}

class SplatDeterminism : public testing::Test {
 protected:
  ~SplatDeterminism() override { select_simd_target(""); }
};

TEST_F(SplatDeterminism, EveryTargetThreadCountOrderAndWidthGivesThePlainBits) {
  parallel::Executor executors[] = {parallel::Executor(1), parallel::Executor(2), parallel::Executor(3), parallel::Executor(8)};
  for (int width = 1; width <= 33; ++width) {
    const int height = 53;  // several bands
    const Image film = any_film(width, height, 5);
    int number = 0;
    for (const Case& c : cases(width, height)) {
      if (number++ % 5 != width % 5) continue;
      const std::vector<Drop> drops = any_drops(75, static_cast<unsigned>(width), c.mass);
      const Image* under = c.film ? &film : nullptr;
      const Image expected = plain_image(c.settings, drops, under, c.pull, c.necks_of(drops));
      for (const std::string& target : simd_targets()) {
        select_simd_target(target);
        for (parallel::Executor& executor : executors) {
          const int threads = executor.threads();
          executor.shuffle_tiles(static_cast<std::uint64_t>(threads + width));
          ASSERT_TRUE(same(splatted(executor, c.settings, drops, under, c.pull, c.necks_of(drops)), expected))
              << target << ", " << threads << " threads, width " << width << ", case " << number;
        }
      }
    }
  }
}

TEST_F(SplatDeterminism, EveryCaseOnALargeTexture) {
  const int width = 211, height = 187;
  const Image film = any_film(width, height, 5);
  for (const Case& c : cases(width, height)) {
    const std::vector<Drop> drops = any_drops(60, 11, c.mass);
    const Image* under = c.film ? &film : nullptr;
    const Image expected = plain_image(c.settings, drops, under, c.pull, c.necks_of(drops));
    double sum = 0;
    for (int x = 0; x < width; ++x) sum += at(expected, x, 90);
    EXPECT_GT(sum, 0) << "something is there";
    for (const std::string& target : simd_targets()) {
      select_simd_target(target);
      ASSERT_TRUE(same(splatted(two_threads(), c.settings, drops, under, c.pull, c.necks_of(drops)), expected)) << target;
    }
  }
}

TEST_F(SplatDeterminism, MoreDropsThanAChunk) {
  const SplatSettings s = settings_on(sheared_glass, false, 128, 128);
  const std::vector<Drop> drops = any_drops(20000, 4, 1);
  const Image expected = splatted(parallel::Executor(1), s, drops);
  for (const std::string& target : simd_targets()) {
    select_simd_target(target);
    parallel::Executor executor(8);
    executor.shuffle_tiles(9);
    EXPECT_TRUE(same(splatted(executor, s, drops), expected)) << target;
  }
  // The sums above would also agree if drops came in any order.
  std::vector<Drop> reversed(drops.rbegin(), drops.rend());
  EXPECT_FALSE(same(splatted(two_threads(), s, reversed), expected));
}

TEST_F(SplatDeterminism, FloatsAreWithinRoundingOfDoubles) {
  const int width = 211, height = 187;
  for (const Case& c : cases(width, height)) {
    if (c.settings.keys.kernel == SplatKernel::disc) continue;  // its edge is a decision
    const std::vector<Drop> drops = any_drops(60, 12, c.mass);
    const SplatUniforms u = splat_uniforms(c.settings, c.pull);
    const auto floats = stamps_of<F>(u, drops, c.necks_of(drops));
    const auto doubles = stamps_of<D>(u, drops, c.necks_of(drops));
    double worst = 0, top = 0;
    for (int y = 0; y < height; y += 3) {
      for (int x = 0; x < width; x += 3) {
        const double exact = plain_texel(u, false, Rounding::rne, doubles, nullptr, x, y).v;
        worst = std::max(worst, std::abs(plain_texel(u, false, Rounding::rne, floats, nullptr, x, y).v - exact));
        top = std::max(top, exact);
      }
    }
    // The centre is known to 2^-17 texels here and q^2 changes by 2 / R a texel, in texels: 2^-14 at the least radius of
    // 1.5 texels. A hemisphere turns an error e of q^2 at its rim into sqrt(e). Sixty drops at most.
    const double slope = 0x1p-15;
    EXPECT_LE(worst, top * (c.settings.keys.kernel == SplatKernel::hemisphere ? std::sqrt(slope) : slope))
        << static_cast<int>(c.settings.keys.kernel);
  }
}

}  // namespace
}  // namespace rainref::drops
