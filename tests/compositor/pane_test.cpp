// Panes of glass and the water on them, against geometry and the laws of optics in closed form.
#include "compositor/embree_isas.h"
#include "compositor/pane.h"
#include "compositor/pane_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "compositor/shading_support.h"
#include "compositor/straight_path.h"
#include "image/images.h"
#include "rainref/error.h"

namespace rainref::compositor {
namespace {

using testing::pi;
using testing::radians;

constexpr double epsilon = 0x1p-52;

const parallel::Executor& executor() {
  static const parallel::Executor one(1);
  return one;
}
/// 0.4 m x 0.3 m in the plane z = 0, outward +z.
PaneShape flat(double thickness = 5e-3) { return {{-0.2, -0.15, 0}, {0.4, 0, 0}, {0, 0.3, 0}, {0, 0, 1}, thickness, 0}; }
PaneShape sheared() { return {{-0.3, -0.15, 0.1}, {0.4, 0.05, 0.1}, {0.1, 0.3, -0.05}, {0, 0, 1}, 4e-3, 0}; }
PaneShape bent() { return {{-0.6, -0.4, 0}, {1.2, 0, 0}, {0, 0.8, 0}, {0, 0, 1}, 5e-3, 1.8}; }

std::unique_ptr<Scene> scene_of(const Pane& pane, std::shared_ptr<const WaterLayer> water, WaterShape shape, const std::string& config = "",
                                const PaneMedia& media = {}) {
  auto scene = std::make_unique<Scene>(TracerOptions{config});
  add_pane(*scene, pane, std::move(water), shape, emitter({0, 0, 0}), executor(), media);
  scene->set_environment(testing::constant({0, 0, 0}));
  scene->commit();
  return scene;
}
std::unique_ptr<Scene> dry(const Pane& pane, const PaneMedia& media = {}) {
  return scene_of(pane, nullptr, WaterShape::displaced, "", media);
}
PaneMedia of_index(double n) {
  PaneMedia media;
  media.pane = glass(n);
  return media;
}
/// Heights in millimetres by a function of the texel's centre (u, v).
template <class Height>
Image heights(int width, int height, const Height& of) {
  return make_image(Format::r32f, width, height,
                    [&](int i, int j, int) { return static_cast<float>(of((i + 0.5) / width, (j + 0.5) / height)); });
}
double distance_to_line(const Vec& point, const Vec& on_line, const Vec& direction) {
  const Vec c = cross(point - on_line, direction);
  return std::sqrt(dot(c, c));
}

// Lateral shift t sin a (1 - cos a / sqrt(n^2 - sin^2 a)) (W15): 0.5125 t at 60 degrees and n = 1.5.
TEST(Pane, ShiftsARayAsAPlateDoes) {
  const Pane pane(flat(0.02));
  const auto scene = dry(pane, of_index(1.5));
  for (const double degrees : {0.0, 30.0, 60.0, 80.0}) {
    const double a = radians(degrees), s = std::sin(a);
    const Ray ray{Vec(0, 0, -0.05) - 0.01 * Vec(s, 0, std::cos(a)), {s, 0, std::cos(a)}};
    const StraightPath path = straight_path(*scene, ray);
    ASSERT_EQ(path.end, StraightPath::End::out);
    ASSERT_EQ(path.interfaces, 2);
    const double shift = distance_to_line(path.origin, ray.origin, ray.direction),
                 expected = 0.02 * s * (1 - std::cos(a) / std::sqrt(1.5 * 1.5 - s * s));
    EXPECT_NEAR(shift, expected, 32 * epsilon) << degrees;  // coordinates are below 0.3
    if (degrees == 60) {
      EXPECT_NEAR(shift / 0.02, 0.5125, 5e-5);
    }
  }
}

TEST(Pane, DryAndFlatLeavesDirections) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> in(0.2, 0.8), aside(-0.9, 0.9);
  for (const PaneShape& shape : {flat(), sheared()}) {
    const Pane pane(shape);
    const auto scene = dry(pane);
    for (int i = 0; i < 2000; ++i) {
      const Vec target = pane.point(in(random), in(random)), n = pane.normal(0);
      Vec direction = n + aside(random) * shape.e_u / 0.4 + aside(random) * shape.e_v / 0.3;
      direction /= std::sqrt(dot(direction, direction));
      const StraightPath path = straight_path(*scene, {target - 0.1 * direction, direction});
      ASSERT_EQ(path.end, StraightPath::End::out);
      ASSERT_EQ(path.interfaces, 2);
      const Vec change = path.direction - direction;
      // Each refraction adds a few roundings of components below 2.
      EXPECT_LT(std::sqrt(dot(change, change)), 16 * epsilon);
    }
  }
}

// In every shell of a concentric pane n r sin(angle to the radius) is the same, so the line that leaves passes the axis
// at the distance of the one that came, turned by (bent - incident) at each face.
TEST(Pane, BentLikeConcentricShells) {
  const Pane pane(bent());
  const auto scene = dry(pane);
  const double outer = 1.8, inner = 1.8 - 5e-3, n = 1.52;
  const Vec axis(0, 0, -std::sqrt(1.8 * 1.8 - 0.36));
  for (const double x : {-0.3, -0.05, 0.0, 0.2, 0.35}) {
    for (const double slope : {-0.4, 0.0, 0.3}) {
      const Vec d = Vec(slope, 0, 1) / std::sqrt(1 + slope * slope);
      const Ray ray{{x - 0.8 * slope, 0.1, -0.8}, d};
      const StraightPath path = straight_path(*scene, ray);
      ASSERT_EQ(path.end, StraightPath::End::out) << x << " " << slope;
      // Signed distance of the line from the axis; in the xz plane, positive where the ray turns from the radius toward +x.
      const Vec o = ray.origin - axis;
      const double b = d.x * o.z - d.z * o.x;
      const double turn = (std::asin(b / (n * inner)) - std::asin(b / inner)) + (std::asin(b / outer) - std::asin(b / (n * outer)));
      const Vec expected(d.x * std::cos(turn) + d.z * std::sin(turn), 0, d.z * std::cos(turn) - d.x * std::sin(turn));
      const Vec left = path.origin - axis;
      EXPECT_NEAR(path.direction.x, expected.x, 1e-14);  // sines of angles near 1 and normals, a few roundings each
      EXPECT_NEAR(path.direction.z, expected.z, 1e-14);
      EXPECT_NEAR(path.direction.x * left.z - path.direction.z * left.x, b, 2e-14);
    }
  }
}

TEST(Pane, CoordinatesAndPointsAgree) {
  for (const PaneShape& shape : {flat(), sheared(), bent()}) {
    const Pane pane(shape);
    for (const double u : {0.0, 0.3, 0.9}) {
      for (const double lift : {-3e-3, 0.0, 2e-3}) {
        const PaneCoordinates at = pane.coordinates(pane.point(u, 0.7, lift));
        EXPECT_NEAR(at.u, u, 1e-14);
        EXPECT_NEAR(at.v, 0.7, 1e-14);
        EXPECT_NEAR(at.lift, lift, 1e-15);
      }
    }
    EXPECT_GT(dot(pane.normal(0.5), shape.outside), 0);
  }
}

// A surface whose tangents are those of the face plus the rise along the normal has the cross product as its normal.
TEST(Pane, TiltIsThatOfTheRisenSurface) {
  for (const PaneShape& shape : {flat(), sheared(), bent()}) {
    const Pane pane(shape);
    const double u = 0.3, v = 0.6, step = 1e-6, rise_u = 0.03, rise_v = -0.02;
    const Vec n = pane.normal(u);
    const Vec along_u = (pane.point(u + step, v) - pane.point(u - step, v)) / (2 * step) + rise_u * n;
    const Vec along_v = (pane.point(u, v + step) - pane.point(u, v - step)) / (2 * step) + rise_v * n;
    Vec expected = cross(along_u, along_v);
    expected /= std::sqrt(dot(expected, expected)) * (dot(expected, n) < 0 ? -1 : 1);
    const Vec tilted = pane.tilted(u, rise_u, rise_v);
    EXPECT_LT(std::sqrt(dot(tilted - expected, tilted - expected)), 1e-9);  // of the central differences
  }
}

TEST(Pane, IsClosed) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> in(0.001, 0.999), way(-1, 1);
  for (const PaneShape& shape : {flat(), sheared(), bent()}) {
    const Pane pane(shape);
    const auto water = std::make_shared<const WaterLayer>(
        heights(64, 48, [](double u, double v) { return std::max(0.0, std::sin(20 * u) * std::sin(17 * v)); }));
    for (const WaterShape kind : {WaterShape::displaced, WaterShape::sloped}) {
      if (kind == WaterShape::displaced && !pane.is_flat()) continue;
      const auto scene = scene_of(pane, water, kind);
      for (int i = 0; i < 20000; ++i) {
        const Ray ray{pane.point(in(random), in(random), -shape.thickness * in(random)), {way(random), way(random), way(random)}};
        Hit hit;
        scene->tracer().first_hits({&ray, 1}, {&hit, 1});
        ASSERT_TRUE(hit.is_surface()) << i;
      }
    }
  }
}

TEST(Pane, RefusesWhatCannotBe) {
  const auto refused = [](PaneShape shape) { EXPECT_THROW(Pane{shape}, Error); };
  PaneShape s = flat();
  s.e_v = 2.0 * s.e_u;
  refused(s);
  s = flat();
  s.outside = {1, 1, 0};
  refused(s);
  s = flat(0);
  refused(s);
  s = flat();
  s.radius = 0.19;  // half the chord is 0.2
  refused(s);
  s = sheared();
  s.radius = 3;
  refused(s);
  const Pane pane(bent());
  const auto water = std::make_shared<const WaterLayer>(heights(8, 8, [](double, double) { return 1; }));
  EXPECT_THROW(DisplacedWater(pane, water, executor()), Error);
}

// Sphere cap on plane-parallel glass, ray along the axis (W15): asin(n r / rho) - asin(r / rho), total reflection from
// r / rho = 1 / n on.
class Cap : public ::testing::TestWithParam<WaterShape> {};
TEST_P(Cap, DeviatesAsTheTableSays) {
  const double side = 0.01, rho = 5e-3, n = 1.333, ground = 0.55 * rho;  // the cap reaches to r / rho = 0.835
  const PaneShape shape{{0, 0, 0}, {side, 0, 0}, {0, side, 0}, {0, 0, 1}, 5e-3, 0};
  constexpr int texels = 2001;  // 5 um each
  const auto water = std::make_shared<const WaterLayer>(heights(texels, texels, [&](double u, double v) {
    const double x = side * (u - 0.5), y = side * (v - 0.5), q = rho * rho - x * x - y * y;
    return q > 0 ? 1e3 * (std::sqrt(q) - ground) : 0;
  }));
  const Pane pane(shape);
  const auto scene = scene_of(pane, water, GetParam());
  for (const double share : {0.0, 0.1, 0.3, 0.5, 0.7}) {
    for (const double turn : {0.3, 2.1, 4.0}) {
      const Vec at(side / 2 + share * rho * std::cos(turn), side / 2 + share * rho * std::sin(turn), -0.02);
      const StraightPath path = straight_path(*scene, {at, {0, 0, 1}});
      ASSERT_EQ(path.end, StraightPath::End::out) << share;
      ASSERT_EQ(path.interfaces, 3);
      const double sine = std::sqrt(path.direction.x * path.direction.x + path.direction.y * path.direction.y);
      const double expected = std::asin(n * share) - std::asin(share);
      // Slopes err by the heights' rounding to float, 2^-25 of 2.3 mm over 10 um, and by D^2 h_xxx / 6; near the critical
      // angle the exit multiplies that by n / cos.
      EXPECT_NEAR(std::asin(sine), expected, 5e-5) << share;
      // Toward the axis: a lens.
      if (share > 0) {
        EXPECT_LT(path.direction.x * std::cos(turn) + path.direction.y * std::sin(turn), 0);
      }
      if (share == 0.3) {
        EXPECT_NEAR(std::asin(sine) * 180 / pi, 6.114, 4e-3);
      }
      if (share == 0.5) {
        EXPECT_NEAR(std::asin(sine) * 180 / pi, 11.80, 5e-3);
      }
    }
  }
  for (const double share : {0.76, 0.8}) {
    const StraightPath path = straight_path(*scene, {{side / 2 + share * rho, side / 2, -0.02}, {0, 0, 1}});
    EXPECT_EQ(path.end, StraightPath::End::mirrored) << share;
  }
}
INSTANTIATE_TEST_SUITE_P(Shapes, Cap, ::testing::Values(WaterShape::displaced, WaterShape::sloped),
                         [](const auto& shape) { return shape.param == WaterShape::displaced ? "displaced" : "sloped"; });

/// What a stack of interfaces lets through, all mirror images between them added: t = t1 t2 / (1 - r1 r2), again and again.
struct Stack {
  double t = 1, forth = 0, back = 0;  // transmittance, reflectances of light that goes and that comes
  void add(double r) {
    const double loop = 1 - back * r, out = t * (1 - r) / loop;
    const double new_back = r + (1 - r) * (1 - r) * back / loop, new_forth = forth + t * t * r / loop;
    t = out;
    forth = new_forth;
    back = new_back;
  }
};

// Which medium lies on which side: a white sky before the pane, black behind it.
TEST(Pane, LetsThroughWhatItsMediaSay) {
  const Pane pane(flat());
  // Half of the pane is under a level sheet of water.
  const auto water = std::make_shared<const WaterLayer>(heights(40, 30, [](double u, double) { return u > 0.5 ? 0.5 : 0.0; }));
  ShadingOptions options;
  options.depth = 40;
  options.least_weight = 1e-13;
  for (const WaterShape kind : {WaterShape::displaced, WaterShape::sloped}) {
    const auto scene = scene_of(pane, water, kind);
    scene->set_environment(environment_of([](const EscapedRay& s) { return s.direction.z > 0 ? Vec(1, 1, 1) : Vec(0, 0, 0); }));
    for (const double degrees : {0.0, 20.0, 50.0}) {
      const double a = radians(degrees), s = std::sin(a);
      const auto at_interface = [&](double from, double to) { return testing::fresnel(std::asin(s / from), to / from); };
      Stack dry_stack, wet_stack;
      dry_stack.add(at_interface(1, 1.52));
      dry_stack.add(testing::fresnel(a, 1.52));
      wet_stack.add(at_interface(1, 1.52));
      wet_stack.add(testing::fresnel(std::asin(s / 1.333), 1.52 / 1.333));
      wet_stack.add(testing::fresnel(a, 1.333));
      for (const bool wet : {false, true}) {
        const Vec target(wet ? 0.1 : -0.1, 0, 0), direction(0, s, std::cos(a));
        const Seen seen = testing::see(*scene, {target - 0.05 * direction, direction}, options);
        EXPECT_NEAR(seen.radiance.x, wet ? wet_stack.t : dry_stack.t, 1e-11) << degrees << (wet ? " wet" : " dry");
      }
    }
  }
}

// A checkerboard 0.7 m behind a slanted pane: every image that the faces make of it, from the geometry of a plate.
TEST(Pane, ShowsACheckerboardWhereThePlateShiftsIt) {
  const double thickness = 0.03, n = 1.5, board = 0.7, tilt = radians(35);
  const Pane pane(
      {{-1, -1 * std::cos(tilt), -1 * std::sin(tilt)}, {2, 0, 0}, {0, 2 * std::cos(tilt), 2 * std::sin(tilt)}, {0, 0, 1}, thickness, 0});
  const auto checker = [](double x, double y) {
    return (static_cast<int>(std::floor(x / 0.02)) + static_cast<int>(std::floor(y / 0.02))) % 2 == 0 ? 1.0 : 0.1;
  };
  const auto on_board = [&](const Vec& from, const Vec& d) {
    const Vec p = from + ((board - from.z) / d.z) * d;
    return p;
  };
  const auto scene = dry(pane, of_index(n));
  scene->set_environment(environment_of([&](const EscapedRay& s) {
    if (!(s.direction.z > 0)) return Vec(0, 0, 0);
    const Vec p = on_board(s.origin, s.direction);
    return Vec(checker(p.x, p.y), 0, 0);
  }));
  ShadingOptions options;
  options.depth = 30;
  options.least_weight = 1e-12;
  const Vec normal = pane.normal(0), eye(0.013, 0.021, -0.4);
  int near_edges = 0, shifted = 0;
  for (int y = -12; y <= 12; ++y) {
    for (int x = -16; x <= 16; ++x) {
      Vec d(0.0131 * x, 0.0127 * y, 1);
      d /= std::sqrt(dot(d, d));
      const double cosine = dot(d, normal), sine_sq = 1 - cosine * cosine, bent = std::sqrt(1 - sine_sq / (n * n));
      const Vec tangent = d - cosine * normal, aside = (thickness / (n * bent)) * tangent;  // along the pane, once through it
      const Vec inner = eye + (dot(pane.point(0, 0, -thickness) - eye, normal) / cosine) * d;
      const double r = testing::fresnel(std::acos(cosine), n);
      double expected = 0, weight = (1 - r) * (1 - r);
      bool is_near_edge = false;
      for (int bounce = 0; bounce < 12; ++bounce, weight *= r * r) {
        const Vec p = on_board(inner + (1.0 + 2 * bounce) * aside + thickness * normal, d);
        expected += weight * checker(p.x, p.y);
        for (const double c : {p.x / 0.02, p.y / 0.02}) is_near_edge |= std::abs(c - std::round(c)) < 1e-9;
      }
      near_edges += is_near_edge;
      const Vec straight = on_board(eye, d);
      shifted += std::abs(checker(straight.x, straight.y) - expected) > 0.5;
      // Weights below 1e-12 are cut off and r^24 is left out; each term has a few roundings.
      if (!is_near_edge) {
        EXPECT_NEAR(testing::see(*scene, {eye, d}, options).radiance.x, expected, 1e-10) << x << " " << y;
      }
    }
  }
  EXPECT_EQ(near_edges, 0);
  EXPECT_GT(shifted, 50);  // the shift matters: without it these would show the other colour
}

TEST(Pane, HitsHaveTheSameBitsForEveryEmbree) {
  const auto water = std::make_shared<const WaterLayer>(
      heights(300, 200, [](double u, double v) { return std::max(0.0, std::sin(40 * u + 3 * v) * std::sin(37 * v)); }));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> in(-0.1, 1.1), lift(-0.05, 0.05);
  for (const PaneShape& shape : {flat(), sheared(), bent()}) {
    const Pane pane(shape);
    std::vector<Ray> rays;
    for (int i = 0; i < 3000; ++i) {
      const Vec from = pane.point(in(random), in(random), lift(random)), to = pane.point(in(random), in(random), lift(random));
      rays.push_back({from, to - from});
    }
    const auto shape_of_water = pane.is_flat() ? WaterShape::displaced : WaterShape::sloped;
    int wet = 0;
    for (const Hit& h :
         test::hits_for_every_embree(rays, [&](const std::string& config) { return scene_of(pane, water, shape_of_water, config); }))
      wet += h.surface == 3;
    EXPECT_GT(wet, 300);
  }
}

// Where the texture says there is none, there is no water's surface; where it does, the face under it borders on water.
TEST(Pane, WaterIsWhereTheTextureHasIt) {
  const Pane pane(sheared());
  const auto water = std::make_shared<const WaterLayer>(
      heights(50, 40, [](double u, double v) { return u > 0.3 && u < 0.5 && v > 0.4 && v < 0.8 ? 0.7 : 0.0; }));
  const auto scene = scene_of(pane, water, WaterShape::displaced);
  const Vec n = pane.normal(0);
  for (int j = 0; j < 199; ++j) {
    for (int i = 0; i < 199; ++i) {
      const double u = (i + 0.5) / 199, v = (j + 0.5) / 199;  // never on a cell's border
      const Ray ray{pane.point(u, v, -2e-3), n};
      Hit hit;
      scene->tracer().first_hits({&ray, 1}, {&hit, 1});
      ASSERT_EQ(hit.surface, water->is_wet(u, v) ? 2u : 1u);
      const Ray above{pane.point(u, v, 0.01), -n};
      scene->tracer().first_hits({&above, 1}, {&hit, 1});
      const bool at_edge =
          water->is_wet(u - 1e-9, v) != water->is_wet(u + 1e-9, v) || water->is_wet(u, v - 1e-9) != water->is_wet(u, v + 1e-9);
      if (!at_edge) {
        ASSERT_EQ(hit.surface, water->is_wet(u, v) ? 3u : 1u) << u << " " << v;
      }
    }
  }
  EXPECT_FALSE(water->is_wet(0.1, 0.6));
  EXPECT_TRUE(water->is_wet(0.4, 0.6));
}

// The mask shows water through the pane, at whatever angle it lets the ray out; and does not show what is only mirrored.
TEST(Pane, MaskShowsWaterThroughIt) {
  const Pane pane(flat());
  const auto water = std::make_shared<const WaterLayer>(heights(40, 30, [](double u, double) { return u < 0.5 ? 0.7 : 0.0; }));
  for (const WaterShape shape : {WaterShape::displaced, WaterShape::sloped}) {
    const auto scene = scene_of(pane, water, shape);
    for (int i = 0; i < 100; ++i) {
      const double u = (i + 0.5) / 100;
      const auto mask_toward = [&](const Vec& direction) {
        const Ray ray{pane.point(u, 0.5, -0.1) - 0.1 * direction, direction};
        Seen seen;
        shade(*scene, {}, {&ray, 1}, {&seen, 1});
        return seen.is_masked;
      };
      // Straight out: where the cell is wet. 45 degrees off along the height, of which the water does not depend: the same.
      EXPECT_EQ(mask_toward({0, 0, 1}), water->is_wet(u, 0.5)) << u;
      EXPECT_EQ(mask_toward(glm::normalize(Vec(0, 1, 1))), water->is_wet(u, 0.5)) << u;
      // 45 degrees off toward the water: where the refracted ray gets to. What is mirrored inside the glass gets further.
      const double foot = 0.095 / 0.4, bent = 5e-3 * std::tan(std::asin(std::sqrt(0.5) / 1.52)) / 0.4, out = u - foot - bent;
      if (out > 0.01) {
        EXPECT_EQ(mask_toward(glm::normalize(Vec(-1, 0, 1))), water->is_wet(out, 0.5)) << u;
      }
    }
  }
}

}  // namespace
}  // namespace rainref::compositor
