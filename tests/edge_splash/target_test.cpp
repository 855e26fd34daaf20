// The target of the published effect: halves, or the eight bits a channel that the article's render feature asks for.
#include "edge_splash/info.h"
#include "edge_splash/support.h"

namespace rainref::edge_splash {
namespace {

const parallel::Executor& executor() {
  static const parallel::Executor one(1);
  return one;
}
Settings eight_bits(Rounding rounding = Rounding::rne) {
  Settings s = published();
  s.storage = Format::rgba8;
  s.rounding = rounding;
  return s;
}
/// An edge under a sky, in light of this level; rows 20 to 22 are painted.
Inputs under_sky(float level) {
  return inputs_of(
      48, 40, [](int, int y) { return y < 20 ? 0.2 : 0.0; }, level);
}
int channel(const Image& image, int x, int y, int k) { return image.row<Unorm8>(y)[4 * x + k].code; }

// 255 x, to nearest or cut; beyond [0, 1] the nearest end. Painted texels hold mix(scene, drop, alpha), also in alpha.
TEST(EdgeSplashTarget, HoldsCodesOfTheLight) {
  for (const Rounding rounding : {Rounding::rne, Rounding::rtz}) {
    Settings s = eight_bits(rounding);
    s.drop_color = {0.8, 0.1, 3};
    s.drop_alpha = 0.75;
    EdgeSplash e(s, under_sky(0.25f), executor());
    e.next_frame();
    ASSERT_EQ(e.colour().format(), Format::rgba8);
    const auto expected = [&](double light) {
      const double scaled = 255 * std::clamp(light, 0.0, 1.0);
      return static_cast<int>(rounding == Rounding::rne ? std::nearbyint(scaled) : std::floor(scaled));
    };
    for (int k = 0; k < 4; ++k) EXPECT_EQ(channel(e.colour(), 24, 10, k), expected(k == 3 ? 1 : 0.25));
    ASSERT_TRUE(painted(e, 24, 21));
    const double painted_light[] = {0.25 * 0.25 + 0.75 * 0.8, 0.25 * 0.25 + 0.75 * 0.1, 0.25 * 0.25 + 0.75 * 3, 0.25 + 0.75 * 0.75};
    for (int k = 0; k < 4; ++k) EXPECT_EQ(channel(e.colour(), 24, 21, k), expected(painted_light[k])) << k;
  }
}
// The light of every code passes through: code / 255 lies nearest to its own code.
TEST(EdgeSplashTarget, KeepsEveryCode) {
  Inputs in = under_sky(0);
  for (int code = 0; code < 256; ++code)
    in.colour.row<float>(code / 48)[4 * (code % 48)] = to_float(Unorm8{static_cast<std::uint8_t>(code)});
  EdgeSplash e(eight_bits(), in, executor());
  e.next_frame();
  // The scene is kept in halves, which move light near 1 by up to 2^-12: less than half a code.
  for (int code = 0; code < 256; ++code) EXPECT_EQ(channel(e.colour(), code % 48, code / 48, 0), code);
}
// display then shows code / 255: srgb of that, and not of the light that was there before the target.
TEST(EdgeSplashTarget, IsWhatDisplayShows) {
  const auto srgb = [](double c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055; };
  for (const float level : {0.0005f, 0.003f, 0.02f, 0.3f, 7.0f}) {
    Settings s = eight_bits();
    s.exposure = 1;
    EdgeSplash e(s, under_sky(level), executor());
    e.next_frame();
    const double held = std::nearbyint(255 * std::min(static_cast<double>(level), 1.0)) / 255;
    EXPECT_EQ(channel(e.picture(), 24, 10, 0), std::nearbyint(255 * srgb(std::min(2 * held, 1.0)))) << level;
  }
}
// Masks do not depend on the target.
TEST(EdgeSplashTarget, ChangesNoMask) {
  Settings s = published();
  EdgeSplash halves(s, under_sky(0.25f), executor()), codes(eight_bits(), under_sky(0.25f), executor());
  halves.next_frame();
  codes.next_frame();
  EXPECT_TRUE(same(halves.edge(), codes.edge()) && same(halves.angle(), codes.angle()) && same(halves.noise(), codes.noise()));
  EXPECT_EQ(halves.colour().format(), Format::rgba16f);
}
TEST(EdgeSplashTarget, OtherFormatsAreRefused) {
  Settings s = published();
  s.storage = Format::rgba32f;
  EXPECT_NE(error_of([&] { EdgeSplash(s, under_sky(0.25f), executor()); }).find("edge_splash.storage: expected rgba16f or rgba8"),
            std::string::npos);
}
// Corrected keeps light above 1 (D10): its target has halves whatever the settings hold.
TEST(EdgeSplashTarget, OfCorrectedHasHalves) {
  Settings s = corrected();
  s.storage = Format::rgba8;
  EdgeSplash e(s, under_sky(3), executor());
  e.next_frame();
  EXPECT_EQ(e.colour().format(), Format::rgba16f);
}

}  // namespace
}  // namespace rainref::edge_splash
