// Crowns in place of the scrolling noise: where they stand, when, and that a picture follows them.

#include "edge_splash/support.h"
#include "image/flipped.h"

namespace rainref::edge_splash {
namespace {

TEST(EdgeSplashCrowns, AreSharesThatLeaveMostOfTheTileFree) {
  for (const double time : {0.0, 0.1, 3600.0}) {
    const Image map = make_crowns(5, time);
    int covered = 0;
    float most = 0;
    for (int y = 0; y < crown_side; ++y)
      for (int x = 0; x < crown_side; ++x) {
        const float v = map.row<float>(y)[x];
        ASSERT_TRUE(v >= 0 && v <= 1) << v;
        covered += v > 0.05f;
        most = std::max(most, v);
      }
    EXPECT_GT(most, 0.7f);
    // 1200 crowns, at most 2.5 radii wide and as high, of radii of at most 1/64: no more than 1200 * 2.5^2 / 64^2 of the tile even if none
    // overlapped another; and a tenth of that at least.
    const double bound = 1200 * 6.25 / 4096, found = static_cast<double>(covered) / (crown_side * crown_side);
    EXPECT_LT(found, std::min(bound, 0.5));
    EXPECT_GT(found, bound / 20);
  }
}

TEST(EdgeSplashCrowns, TheTileJoinsAtItsEdges) {
  Image map = make_crowns(5, 0.37);
  EXPECT_EQ(seam_warning(map), "");
}

TEST(EdgeSplashCrowns, TheSameMomentGivesTheSameBitsAndAnotherOneOthers) {
  const Image map = make_crowns(5, 0.5);
  EXPECT_TRUE(same(map, make_crowns(5, 0.5)));
  EXPECT_FALSE(same(map, make_crowns(6, 0.5)));
  EXPECT_FALSE(same(map, make_crowns(5, 0.5 + 1.0 / 60)));
  // After the life of a crown each slot has its next drop, elsewhere.
  EXPECT_FALSE(same(map, make_crowns(5, 0.75)));
}

Settings crowned(double fps) {
  Settings s = rainref::test::edge_splash_settings();
  s.has_crowns = true;
  s.fps = fps;
  s.rain_drop_scale = 0.1;
  return s;
}
Inputs shelf() {
  return inputs_of_distance(160, 90, [](int, int y) { return y < 45 ? 2.0 : 20.0; });
}
Image noise_at(const Settings& s, int frame, const Inputs& in) {
  static const parallel::Executor executor(2);
  EdgeSplash splash(s, in, executor);
  for (int k = 0; k <= frame; ++k) splash.simulate();
  splash.render();
  return copy_of(splash.noise());
}

TEST(EdgeSplashCrowns, MoveWithTimeAtAnyFrameRateAndDoNotScroll) {
  const Inputs in = shelf();
  const Image at_half = noise_at(crowned(60), 30, in);
  EXPECT_TRUE(same(at_half, noise_at(crowned(30), 15, in)));
  EXPECT_FALSE(same(at_half, noise_at(crowned(60), 31, in)));
  Settings scrolling = crowned(60);
  scrolling.drop_velocity = {3, -2};
  EXPECT_TRUE(same(at_half, noise_at(scrolling, 30, in)));
}

TEST(EdgeSplashCrowns, AMapOfOnesOwnIsUsedAsItIs) {
  Inputs in = shelf();
  in.noise = uniform_noise(64);
  Settings plain = crowned(60);
  plain.has_crowns = false;
  EXPECT_TRUE(same(noise_at(crowned(60), 7, in), noise_at(plain, 7, in)));
}

}  // namespace
}  // namespace rainref::edge_splash
