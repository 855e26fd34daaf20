// composite: geometry of the view through the glass, refraction in the water, glints.
#include <gtest/gtest.h>

#include <cmath>

#include "windshield/picture/picture.h"
#include "windshield/scalar.h"

namespace rainref::windshield {
namespace {

using Real = scalar::Scalar<double>;
using Real3 = scalar::Vec3<Real>;
using glm::dvec3;

const Corners raked{{{1.0, 0.7, 0.95}, {1.0, -0.7, 0.95}, {0.2872, 0.7, 1.3132}}};
const Corners sheared{{{1.0, 0.6, 0.9}, {1.1, -0.7, 1.0}, {0.3, 0.8, 1.4}}};

// The homography against the ray that it stands for.
TEST(GlassPoint, IsWhereTheRayMeetsTheGlass) {
  PictureSettings s;
  s.camera_position = {-0.25, 0, 1.16};
  s.camera_target = {10, 0, 1.13};
  s.vertical_fov_deg = 30;
  s.width = 320;
  s.height = 180;
  for (const Corners& corners : {raked, sheared}) {
    const CompositeUniforms u = composite_uniforms(s, corners);
    const scene::Camera eye = camera(s);
    const auto basis = eye.basis();
    const dvec3 p0(corners[0][0], corners[0][1], corners[0][2]), eu = dvec3(corners[1][0], corners[1][1], corners[1][2]) - p0,
                                                                 ev = dvec3(corners[2][0], corners[2][1], corners[2][2]) - p0,
                                                                 n = glm::cross(eu, ev);
    for (int row = 0; row < s.height; row += 7) {
      for (int column = 0; column < s.width; column += 11) {
        const double h = eye.half_height(), w = h * s.width / s.height;
        const dvec3 d =
            basis.forward + ((2 * column + 1.0) / s.width - 1) * w * basis.right + ((2 * row + 1.0) / s.height - 1) * h * basis.up;
        const double t = glm::dot(p0 - eye.position, n) / glm::dot(d, n);
        const dvec3 at = eye.position + t * d - p0;
        const double area = glm::dot(n, n), a = glm::dot(glm::cross(at, ev), n) / area, b = glm::dot(glm::cross(eu, at), n) / area;
        const auto g = scalar::glass_point<Real>(u, column, row);
        // The uniforms are floats.
        EXPECT_NEAR(g.distance.v, t, 2e-6 * t);
        EXPECT_EQ(g.on_glass.v, a >= 0 && a <= 1 && b >= 0 && b <= 1 ? 1 : 0);
        if (g.on_glass.v == 1) {
          EXPECT_NEAR(g.u.v, a, 2e-6);
          EXPECT_NEAR(g.v.v, b, 2e-6);
        }
      }
    }
  }
}

/// The direction of a ray along the axis of a spherical cap of radius 1 that passes at distance r from its axis.
Real3 through_cap(double r, float ior) {
  const Real zero(0.0f), one(1.0f);
  Real x, z;
  x.v = -r;  // the normal leans outward; the cap is thicker towards the axis
  z.v = std::sqrt(1 - r * r);
  Real side;
  side.v = r;
  return scalar::through_water(Real3(zero, zero, one), Real3(zero, zero, one), Real3(side, zero, z), ior);
}

// W15: deviation asin(n r) - asin(r), toward the axis; zero at the apex and odd; total reflection beyond r = 1 / n.
TEST(Refraction, OfASphericalCapFollowsSnell) {
  const float ior = 1.333f;
  for (const double r : {0.0, 0.1, 0.3, 0.5, 0.7}) {
    const Real3 out = through_cap(r, ior);
    const double deviation = std::asin(static_cast<double>(ior) * r) - std::asin(r);
    EXPECT_NEAR(std::atan2(-out.x.v, out.z.v), deviation, 1e-7) << r;  // 1 / ior is a float
    EXPECT_EQ(through_cap(-r, ior).x.v, -out.x.v);
  }
  EXPECT_NEAR(std::atan2(-through_cap(0.3, ior).x.v, through_cap(0.3, ior).z.v) * 180 / M_PI, 6.11, 0.01);
  EXPECT_NEAR(std::atan2(-through_cap(0.5, ior).x.v, through_cap(0.5, ior).z.v) * 180 / M_PI, 11.80, 0.01);
  EXPECT_GT(through_cap(0.749, ior).z.v, 0);
  EXPECT_EQ(through_cap(0.752, ior).z.v, 0);  // 1 / 1.333 = .7502
}
// Water of constant thickness turns no ray, at any angle of incidence.
TEST(Refraction, OfAPlaneSheetIsNone) {
  for (const double angle : {0.0, 0.4, 0.8, 1.1}) {
    Real3 ray;
    ray.x.v = std::sin(angle);
    ray.y.v = 0;
    ray.z.v = std::cos(angle);
    const Real3 axis(Real(0.0f), Real(0.0f), Real(1.0f));
    const Real3 out = scalar::through_water(ray, axis, axis, 1.333f);
    EXPECT_NEAR(out.x.v, ray.x.v, 1e-7);
    EXPECT_NEAR(out.z.v, ray.z.v, 1e-7);
  }
}

// W16: the highlight of a cap lies where its normal is the half vector, r = rho |h_xy|; two lights give two.
TEST(Glint, LiesAtTheHalfVector) {
  const Real3 to_eye(Real(0.0f), Real(0.0f), Real(1.0f));
  for (const double angle : {-0.6, 0.8}) {
    Real3 light;
    light.x.v = std::sin(angle);
    light.y.v = 0;
    light.z.v = std::cos(angle);
    double best = -1, where = 0;
    for (int k = -900; k <= 900; ++k) {
      const double r = k / 1000.0;
      Real3 n;
      n.x.v = r;
      n.y.v = 0;
      n.z.v = std::sqrt(1 - r * r);
      const double shine = scalar::highlight(n, light, to_eye, 80.0f).v;
      if (shine > best) {
        best = shine;
        where = r;
      }
    }
    EXPECT_NEAR(where, std::sin(angle / 2), 0.0011);
    EXPECT_NEAR(best, 1, 1e-4);
  }
}

}  // namespace
}  // namespace rainref::windshield
