// How far floats are from doubles. Their bits: determinism_test.cpp.
#include <gtest/gtest.h>

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

TEST(SurfacePrecision, FloatsAreWithinRoundingOfDoubles) {
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
