// A camera's half height and basis are exact, the same on every machine, and refused where undefined.
#include "scene/camera.h"

#include <cmath>
#include <limits>

#include "scene/example_effect.h"

namespace rainref::scene {
namespace {

using testing::DoubleNear;

TEST(Camera, HalfHeightIsTheTangentOfHalfTheFieldOfView) {
  constexpr long double pi = 3.14159265358979323846264338327950288L;
  for (int i = 1; i < 18000; ++i) {
    const double fov = i * 0.01;
    // Past 90 degrees by the complement: near the pole even long double would lose the digits wanted here.
    const long double exact = fov <= 90 ? std::tan(fov / 360.0L * pi) : 1 / std::tan((180 - fov) / 360.0L * pi);
    const double got = Camera{.vertical_fov_deg = fov}.half_height();
    ASSERT_LT(std::abs(static_cast<double>(got / exact - 1)), 1e-15) << fov;
  }
}

TEST(Camera, HalfHeightIsAccurateNextToZeroAndToThePole) {
  constexpr double pi = 3.141592653589793;
  EXPECT_NEAR(Camera{.vertical_fov_deg = 1e-9}.half_height() / (1e-9 * pi / 360), 1, 1e-15);
  const double last = std::nextafter(180.0, 0.0);
  EXPECT_NEAR(Camera{.vertical_fov_deg = last}.half_height() * ((180 - last) * pi / 360), 1, 1e-15);
}

// What this source gives, which is within the 1e-15 tested above and not always the nearest double.
TEST(Camera, HalfHeightHasTheSameBitsOnEveryMachine) {
  EXPECT_EQ(Camera{.vertical_fov_deg = 60}.half_height(), 0x1.279a74590331bp-1);
  EXPECT_EQ(Camera{.vertical_fov_deg = 90}.half_height(), 0x1.fffffffffffffp-1);
  EXPECT_EQ(Camera{.vertical_fov_deg = 170}.half_height(), 0x1.6dc2fd0bfdbe3p+3);
}

TEST(Camera, RefusesAFieldOfViewOutsideItsRange) {
  for (const double fov : {0.0, 180.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THAT(error_of([&] { Camera{.vertical_fov_deg = fov}.half_height(); }),
                testing::StartsWith("2 camera: expected a vertical field of view between 0 and 180 [deg], found "));
  }
}

TEST(Camera, BasisOfTheDefaultCameraIsTheWorlds) {
  const Camera::Basis b = Camera{}.basis();
  EXPECT_EQ(b.right, Vector3(1, 0, 0));
  EXPECT_EQ(b.up, Vector3(0, 1, 0));
  EXPECT_EQ(b.forward, Vector3(0, 0, -1));
}

TEST(Camera, BasisIsOrthonormalAndKeepsUpInThePlaneOfViewAndUp) {
  const Camera camera{.position = {3, -2, 7}, .target = {-1, 4, 0.5}, .up = {0.2, 5, 0.1}};
  const Camera::Basis b = camera.basis();
  for (const Vector3& v : {b.right, b.up, b.forward}) EXPECT_NEAR(dot(v, v), 1, 1e-15);
  EXPECT_NEAR(dot(b.right, b.up), 0, 1e-15);
  EXPECT_NEAR(dot(b.right, b.forward), 0, 1e-15);
  EXPECT_NEAR(dot(b.up, b.forward), 0, 1e-15);
  EXPECT_NEAR(dot(b.right, camera.up), 0, 1e-15);
  EXPECT_GT(dot(b.up, camera.up), 0);
  const Vector3 right = cross(b.forward, b.up);  // right-handed
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(right[i], b.right[i], 1e-15);
  EXPECT_GT(dot(b.forward, camera.target - camera.position), 0);
}

TEST(Camera, BasisDoesNotDependOnTheLengthOfUp) {
  const Camera camera{.target = {1, 2, 3}};
  Camera stretched = camera;
  stretched.up = {0, 1024, 0};
  EXPECT_EQ(camera.basis().up, stretched.basis().up);
}

TEST(Camera, RefusesAViewWithoutDirection) {
  const std::string message = "2 camera: position and target coincide or are not finite, so there is no view";
  EXPECT_EQ(error_of([] { Camera{.position = {1, 2, 3}, .target = {1, 2, 3}}.basis(); }), message);
  EXPECT_EQ(error_of([] { Camera{.target = {std::numeric_limits<double>::infinity(), 0, 0}}.basis(); }), message);
  EXPECT_EQ(error_of([] { Camera{.target = {1e200, 0, 0}}.basis(); }), message) << "its square overflows";
}

TEST(Camera, RefusesAnUpAlongTheView) {
  const std::string message = "2 camera: up is zero or parallel to the view, so there is no right";
  EXPECT_EQ(error_of([] { Camera{.up = {0, 0, 2}}.basis(); }), message);
  EXPECT_EQ(error_of([] { Camera{.up = {0, 1e-10, -1}}.basis(); }), message);
  EXPECT_EQ(error_of([] { Camera{.up = {0, 0, 0}}.basis(); }), message);
  EXPECT_EQ(error_of([] { Camera{.up = {0, 1e-6, -1}}.basis(); }), "none");
}

TEST(Camera, NormalizedDividesEachComponent) {
  // 1/5 is no double: multiplying by a rounded reciprocal would give 0.6000000000000001.
  const Vector3 unit = normalized({0, 3, 4});
  EXPECT_EQ(unit.x, 0);
  EXPECT_EQ(unit.y, 0.6);
  EXPECT_EQ(unit.z, 0.8);
}

}  // namespace
}  // namespace rainref::scene
