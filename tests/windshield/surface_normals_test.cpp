// Normals of known water (physics: W14).
#include <gtest/gtest.h>

#include <functional>

#include "image/images.h"
#include "windshield/surface_support.h"

namespace rainref::windshield {
namespace {

using D = scalar::Scalar<double>;

struct Slope {
  double x, y;
};
/// A texel and those around it, by the double evaluation, from heights [mm] and one mask for all.
struct Around {
  const std::function<double(int, int)>& heights;
  double wiped;
  D height(int dx, int dy) const { return D(heights(dx, dy)); }
  D mask(int, int) const { return D(wiped); }
};
Slope slope_of(const SurfaceSettings& s, const std::function<double(int, int)>& height, double mask = 0) {
  const Around around{height, mask};
  const NormalsUniforms u = normals_uniforms(s);
  const auto n = s.corrected ? scalar::normal_of<D, true>(u, around) : scalar::normal_of<D, false>(u, around);
  EXPECT_NEAR(n.x.v * n.x.v + n.y.v * n.y.v + n.z.v * n.z.v, 1, 1e-14);
  return {-n.x.v / n.z.v, -n.y.v / n.z.v};
}

TEST(SurfaceNormals, ParaboloidsAndPlanesAreExactOnEveryGlass) {
  for (const double phi : {pi / 2, 70 * pi / 180}) {
    const SurfaceSettings s = settings_on(true, 640, 480, phi);
    // h = (1 - (x^2 + y^2) / R^2) h0 around some place, in plane metres: slopes -2 h0 x / R^2. The uniforms are floats.
    const double h0 = 0.8, radius = 0.02, x0 = 0.004, y0 = -0.007;
    const auto height = [&](int i, int j) {
      const double x = x0 + s.frame[0] / s.width * i + s.frame[1] / s.height * j, y = y0 + s.frame[2] / s.height * j;
      return h0 * (1 - (x * x + y * y) / (radius * radius));
    };
    const Slope got = slope_of(s, height);
    EXPECT_NEAR(got.x, -2 * h0 * 1e-3 * x0 / (radius * radius), 1e-8) << phi;
    EXPECT_NEAR(got.y, -2 * h0 * 1e-3 * y0 / (radius * radius), 1e-8) << phi;
  }
  // As published sees slopes along u and v, each by its own length: on sheared glass that is not the normal.
  const SurfaceSettings s = settings_on(false, 640, 480);
  const Slope got = slope_of(s, [&](int i, int) { return 10.0 * i; });
  EXPECT_NEAR(got.x, 10e-3 / (1.4 / 640), 1e-6);
  EXPECT_EQ(got.y, 0);
}

TEST(SurfaceNormals, SphereCapHasTheErrorOfCentralDifferences) {
  // D^2 / 6 h_xxx with h_xxx = -3 rho^2 x / (rho^2 - x^2)^(5/2).
  const SurfaceSettings s = settings_on(true, 2800, 1600);
  const double rho = 0.01, x0 = 0.004, texel = 1.4 / 2800;
  const Slope got = slope_of(s, [&](int i, int) {
    const double x = x0 + texel * i;
    return 1e3 * std::sqrt(rho * rho - x * x);
  });
  const double left = rho * rho - x0 * x0, error = texel * texel / 6 * 3 * rho * rho * x0 / std::pow(left, 2.5);
  EXPECT_NEAR(got.x + x0 / std::sqrt(left), -error, 0.02 * error) << "the next term is D^2 / x^2 smaller";
}

// ---- the mask ----------------------------------------------------------------------------------------------------------
Image any_height(int width, int height, unsigned seed) {
  std::mt19937 words(seed);
  return make_image(Format::r16f, width, height, [&](int, int, int) { return to_half(static_cast<float>(words() * 0x1p-31)); });
}
Image normals_of(const SurfaceSettings& s, const Image& height, const Image& mask) {
  Image normal(Format::rgba16f, s.width, s.height);
  run_normals(two_threads(), s, height, mask, normal);
  return normal;
}
double channel(const Image& normal, int x, int y, int c) { return to_float(normal.row<Half>(y)[4 * x + c]); }

TEST(SurfaceNormals, NoMaskChangesNothingAndAFullOneLeavesDryGlass) {
  const SurfaceSettings published = settings_on(false, 53, 31), corrected = settings_on(true, 53, 31);
  const Image height = any_height(53, 31, 1);
  const Image a = normals_of(published, height, filled(53, 31, 0)), b = normals_of(corrected, height, filled(53, 31, 0));
  const Image dry_a = normals_of(published, height, filled(53, 31, 1)), dry_b = normals_of(corrected, height, filled(53, 31, 1));
  int steep = 0;
  for (int y = 0; y < 31; ++y) {
    for (int x = 0; x < 53; ++x) {
      for (int c = 0; c < 4; ++c) {
        // On orthogonal glass the variants differ in the mask alone.
        ASSERT_EQ(a.row<Half>(y)[4 * x + c].bits, b.row<Half>(y)[4 * x + c].bits);
        ASSERT_EQ(channel(dry_a, x, y, c), c < 2 ? 0 : 1);
        ASSERT_EQ(channel(dry_b, x, y, c), c < 2 ? 0 : 1);
      }
      steep += std::abs(channel(a, x, y, 0)) > 0.01;
    }
  }
  EXPECT_GT(steep, 800);
}

TEST(SurfaceNormals, TheEdgeOfTheMaskIsNoSlopeWhenCorrected) {
  // Water of one height; the left half is wiped.
  const int width = 64, height = 8;
  Image mask = filled(width, height, 0);
  for (int y = 0; y < height; ++y) std::fill_n(mask.row<Half>(y), width / 2, to_half(1));
  const double h = 0.5, texel = 1.4 / width;
  for (const bool corrected : {false, true}) {
    const Image n = normals_of(settings_on(corrected, width, height), filled(width, height, h), mask);
    for (int x = 0; x < width; ++x) {
      const double slope = -channel(n, x, 4, 0) / channel(n, x, 4, 2);
      const bool edge = x == width / 2 - 1 || x == width / 2;
      // As published: -h grad m, h / (2 D).
      EXPECT_NEAR(slope, !corrected && edge ? h * 1e-3 / (2 * texel) : 0, 0x1p-11 * slope + 1e-9) << x;
    }
  }
}

TEST(SurfaceNormals, CorrectedReducesTheSlopeByTheMask) {
  const SurfaceSettings s = settings_on(true, 640, 480, 70 * pi / 180);
  const auto height = [](int i, int j) { return 0.3 * i - 0.2 * j + 0.01 * i * j; };
  const Slope bare = slope_of(s, height), half = slope_of(s, height, 0.5);
  EXPECT_NEAR(half.x, bare.x / 2, 1e-12);
  EXPECT_NEAR(half.y, bare.y / 2, 1e-12);
}

}  // namespace
}  // namespace rainref::windshield
