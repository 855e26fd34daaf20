// As published rivulets are streaks down the glass, as the article's text and pictures have them.
#include "rainy_glass/parameters.h"
#include "rainy_glass/support.h"

namespace rainref::rainy_glass {
namespace {

using test::Double;

/// What a phase of the flow makes of a trail that runs down the tile. With d = strength p (B, A) the map looks up r + d(r), so a level
/// line of it has the direction t with (1 + grad d) t along v.
struct Streaks {
  double folded = 0;   ///< share of the tile where det(1 + grad d) <= 0: the map runs backwards, and trails curl
  double leaning = 0;  ///< share where a trail leans by more than 45 degrees
};
Streaks streaks(const Settings& s, double phase) {
  constexpr int side = 128;
  constexpr double step = 1e-4;
  const TextureData lattice(make_lattice(s), Address::repeat, Address::repeat);
  const BakeRivuletsUniforms u = bake_rivulets_uniforms(s, 0);
  const auto flow = [&](double x, double y) {
    const auto wrap = [](double a) { return Double(a - std::floor(a)); };
    return std::array{scalar::stored_flow<0>(u, lattice.view(), wrap(x), wrap(y)).v,
                      scalar::stored_flow<2>(u, lattice.view(), wrap(x), wrap(y)).v};
  };
  Streaks out;
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const double x = (i + 0.5) / side, y = (j + 0.5) / side, k = s.flow_strength * phase / (2 * step);
      const auto left = flow(x - step, y), right = flow(x + step, y), down = flow(x, y - step), up = flow(x, y + step);
      const double xx = 1 + k * (right[0] - left[0]), xy = k * (up[0] - down[0]), yx = k * (right[1] - left[1]),
                   yy = 1 + k * (up[1] - down[1]);
      out.folded += xx * yy - xy * yx <= 0;
      out.leaning += std::abs(xy) > std::abs(xx);  // t = (-xy, xx)
    }
  }
  out.folded /= side * side;
  out.leaning /= side * side;
  return out;
}

// At every phase: the distortion grows with p, and p stays below 1.
TEST(RainyGlassStreaks, OfThePublishedDefaultsRunDownAndDoNotCurl) {
  Settings s = default_settings(Variant::as_published);
  for (const std::uint64_t seed : {1u, 7u, 11u}) {
    s.seed = seed;
    const Streaks whole = streaks(s, 1);
    EXPECT_EQ(whole.folded, 0) << seed;
    EXPECT_LT(whole.leaning, 0.02) << seed;
    EXPECT_EQ(streaks(s, 0.5).leaning, 0) << seed;  // where a phase shows alone
  }
}
// The same flow at 8 cells and a gain of 1.2 tears every streak to curls: what the test above would see.
TEST(RainyGlassStreaks, FineFlowCurlsThem) {
  Settings s = default_settings(Variant::as_published);
  s.flow_cells = 8;
  s.flow_gain = 1.2;
  EXPECT_GT(streaks(s, 0.5).folded, 0.4);
  EXPECT_GT(streaks(s, 0.5).leaning, 0.4);
}

}  // namespace
}  // namespace rainref::rainy_glass
