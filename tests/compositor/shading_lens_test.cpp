// Plates and drops: closed forms of rays through two interfaces.
#include <gtest/gtest.h>

#include "compositor/interface.h"
#include "compositor/shading_support.h"

namespace rainref::compositor::testing {
namespace {

/// Black surroundings but for a screen y = height that tells where it is met; only the straight path counts, so the tests
/// take the two transmissions out of it.
Scene plate(double ior, double thickness, double screen) {
  Scene scene;
  scene.add(std::make_shared<Level>(0), Material::interface_of(air(), {ior}));
  scene.add(std::make_shared<Level>(-thickness), Material::interface_of({ior}, air()));
  scene.add(std::make_shared<Level>(screen), Material::of(tells_place()));
  scene.set_environment(constant({0, 0, 0}));
  scene.commit();
  return scene;
}
/// depth 3 ends the paths that are reflected between the faces.
constexpr ShadingOptions straight{3, 0};

TEST(Plate, ShiftsARaySideways) {
  const double ior = 1.5, thickness = 0.01, screen = -0.3;
  for (const double degrees : {0.0, 20.0, 45.0, 60.0, 85.0}) {
    const double a = radians(degrees);
    const Seen seen = see(plate(ior, thickness, screen), slanting(degrees), straight);
    const double f = fresnel(a, ior), x = seen.radiance.x / ((1 - f) * (1 - f));
    EXPECT_NEAR(seen.radiance.y / ((1 - f) * (1 - f)), screen, 1e-13);  // it reaches the screen at all
    // The screen point without the plate is -screen tan(a) from the origin; across the ray, that is times cos(a).
    const double shift = (-screen * std::tan(a) - x) * std::cos(a);
    const double law = thickness * std::sin(a) * (1 - std::cos(a) / std::sqrt(ior * ior - std::sin(a) * std::sin(a)));  // physics W15
    EXPECT_NEAR(shift, law, 1e-14 / std::cos(a)) << degrees;
    if (degrees == 60) {
      EXPECT_NEAR(shift / thickness, 0.5125, 5e-5);
    }
  }
}

// A pane changes no direction: what lies endlessly far is seen where it is.
TEST(Plate, LeavesDirectionsUnchanged) {
  Scene scene;
  scene.add(std::make_shared<Level>(0), Material::interface_of(air(), glass()));
  scene.add(std::make_shared<Level>(-0.005), Material::interface_of(glass(), air()));
  scene.set_environment(tells_direction());
  scene.commit();
  for (const double degrees : {0.0, 30.0, 70.0, 88.0}) {
    const Ray ray = slanting(degrees);
    const double f = fresnel(radians(degrees), 1.52), through = (1 - f) * (1 - f);
    ShadingOptions two{2, 0};  // beyond the second face every path looks at the surroundings
    const Vec seen = see(scene, ray, two).radiance;
    // Reflected at the front: f; through both: (1-f)^2; inside after the back's mirror: cut there, seen straight on.
    const double s = std::sin(radians(degrees)), inside = (1 - f) * f;
    EXPECT_NEAR(seen.x, f * s + through * s + inside * s / 1.52, 1e-14) << degrees;
  }
}

// The picture of a checkerboard behind a plane-parallel pane, pixel by pixel, against the board at the shifted places.
TEST(Plate, CheckerboardThroughAPane) {
  const double ior = 1.52, thickness = 0.02, board = -1, side = 0.11;
  Scene scene;
  scene.add(std::make_shared<Level>(0), Material::interface_of(air(), {ior}));
  scene.add(std::make_shared<Level>(-thickness), Material::interface_of({ior}, air()));
  const auto dark = [side](double x, double z) {
    return (static_cast<long>(std::floor(x / side)) + static_cast<long>(std::floor(z / side))) % 2 != 0;
  };
  scene.add(std::make_shared<Level>(board), Material::of(opaque_of([dark](const Place& p) {
              Finish f;
              f.radiance = Vec(1, 1, 1) * (dark(p.point.x, p.point.z) ? 0.0 : 1.0);
              return f;
            })));
  scene.set_environment(constant({0, 0, 0}));
  scene.commit();
  const Vec eye{0.3, 0.8, 1.1};
  int light = 0, moved = 0, border = 0;
  for (int y = 0; y < 90; ++y) {
    for (int x = 0; x < 120; ++x) {
      Ray ray;
      ray.origin = eye;
      ray.direction = glm::normalize(Vec{(x - 59.5) / 90, -0.9 + (y - 44.5) / 90, -0.9});
      const double cosine = -ray.direction.y, sine = std::sqrt(1 - cosine * cosine), bent = std::asin(sine / ior);
      // Closed form: the ground distance is that of the air path plus that inside the pane.
      const double across = (eye.y - board - thickness) * sine / cosine + thickness * std::tan(bent);
      const Vec heading{ray.direction.x / sine, 0, ray.direction.z / sine};
      const Vec place = eye + across * heading;
      const auto near_border = [&](double c) { return std::abs(c / side - std::round(c / side)) < 1e-9; };
      if (near_border(place.x) || near_border(place.z)) {
        ++border;
        continue;
      }
      const double f = fresnel(std::acos(cosine), ior);
      const double expected = dark(place.x, place.z) ? 0 : (1 - f) * (1 - f);
      ASSERT_NEAR(see(scene, ray, straight).radiance.x, expected, 1e-13) << x << " " << y;
      light += expected > 0;
      const Vec straight_on = eye + (eye.y - board) * sine / cosine * heading;
      moved += dark(straight_on.x, straight_on.z) != dark(place.x, place.z);
    }
  }
  EXPECT_EQ(border, 0);
  EXPECT_GT(light, 3000);
  EXPECT_GT(moved, 200);  // the pane does move the picture
}

/// A spherical cap of water on plane-parallel glass, its flat side up, its bulge down, seen along the axis from above: the
/// ray enters through the flat face unbent and leaves through the sphere.
Scene cap(double ior, double radius) {
  Scene scene;
  // The flat side lies 1e-3 above the equator, so that the whole half ball is below it.
  scene.add(std::make_shared<Level>(0.001), Material::interface_of(air(), {ior}));
  scene.add(std::make_shared<Ball>(Vec{0, 0, 0}, radius), Material::interface_of(air(), {ior}));
  scene.set_environment(tells_direction());
  scene.commit();
  return scene;
}

// physics W15: deviation asin(n r / rho) - asin(r / rho), .3: 6.114, .5: 11.80 degrees; paraxially (n - 1) r / rho.
TEST(Cap, BendsAsTabulated) {
  const double ior = 1.333, radius = 1;
  const double table[][2] = {{0.3, 6.114}, {0.5, 11.80}};
  for (const double off : {0.01, 0.1, 0.3, 0.5, 0.7}) {
    const Ray down{{off, 0.0005, 0}, {0, -1, 0}};  // inside, below the flat side
    Scene scene = cap(ior, radius);
    scene.set_eye({ior});
    // The transmitted path alone: the reflected one stays inside for one more surface, and is cut off before it.
    Vec seen = see(scene, down, {1, 0}).radiance;
    const double incidence = std::asin(off / radius), f = fresnel(std::asin(ior * off / radius), ior);
    // Less the reflected share, which looks along its mirrored direction.
    const Vec reflected{-std::sin(2 * incidence), std::cos(2 * incidence), 0};
    seen = (seen - f * reflected) / (1 - f);
    const double deviation = std::atan2(-seen.x, -seen.y);
    EXPECT_NEAR(deviation, std::asin(ior * off / radius) - incidence, 1e-14) << off;
    for (const auto& [r, degrees] : table) {
      if (r == off) {
        EXPECT_NEAR(deviation * 180 / pi, degrees, degrees > 10 ? 5e-3 : 5e-4);  // half of the last digit
      }
    }
  }
}

// Total reflection begins at r / rho = 1 / n: outside that rim no light comes through.
TEST(Cap, DarkRimBeginsAtOneOverN) {
  const double ior = 1.333;
  Scene scene = cap(ior, 1);
  scene.set_eye({ior});
  scene.set_environment(constant({1, 1, 1}));
  EXPECT_NEAR(1 / ior, 0.7502, 5e-5);
  for (const double off : {1 / ior - 1e-9, 1 / ior + 1e-9}) {
    Seen seen;
    const Ray down{{off, 0.0005, 0}, {0, -1, 0}};
    const double incidence = std::asin(off);
    const Split s = split({0, -1, 0}, {-off, std::cos(incidence), 0}, ior, 1);
    EXPECT_EQ(s.reflectance == 1, off > 1 / ior);
    shade(scene, {1, 0}, {&down, 1}, {&seen, 1});
    EXPECT_NEAR(seen.radiance.x, 1, 1e-15);
  }
}

// A closed ball, inside the same part of the same surface: the ray meets the far side, not the point where it began.
TEST(Ball, ARayCrossesAndLeaves) {
  for (const double off : {0.0, 0.3, 0.5, 0.7}) {  // further out, what the ball mirrors is the ground
    Scene scene;
    const double ior = 1.333;
    Medium dye = water(ior);
    dye.extinction = {3, 3, 3};
    scene.add(std::make_shared<Ball>(Vec{0, 0, 0}, 1), Material::interface_of(air(), dye));
    scene.add(std::make_shared<Level>(-3), Material::of(emitter({1, 1, 1})));
    scene.set_environment(constant({0, 0, 0}));
    scene.commit();
    const Seen seen = see(scene, {{off, 5, 0}, {0, -1, 0}}, straight);
    const double incidence = std::asin(off), chord = 2 * std::sqrt(1 - off * off / (ior * ior)), f = fresnel(incidence, ior);
    EXPECT_NEAR(seen.film, chord, 1e-14);
    EXPECT_NEAR(seen.radiance.x, (1 - f) * (1 - f) * std::exp(-3 * chord), 1e-14) << off;
  }
}

}  // namespace
}  // namespace rainref::compositor::testing
