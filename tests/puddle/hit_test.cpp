// surface_hit: the published sphere tracing and the corrected march against closed forms and a dense search (P8).
#include <algorithm>

#include <gmock/gmock.h>

#include "puddle/scene_support.h"
#include "random/counter.h"

namespace rainref::puddle::test {
namespace {

// ---- as published --------------------------------------------------------------------------------------------------

// ceil(ln(epsilon / h) / ln(1 - fall)): a plane at distance h shrinks by 1 - fall at each step.
struct FlatCase {
  double fall;
  int steps;
};
constexpr FlatCase flat_cases[] = {{.05, 186}, {.1, 91}, {.2, 43}, {.5, 14}, {.6416, 10}, {.9, 5}};
constexpr double eye_above_water = 13.5, rest_height = 4.5;

double steps_exact(double fall, double epsilon) { return std::log(epsilon / eye_above_water) / std::log(1 - fall); }

// The article's uniforms for a box so wide that its sides do not matter.
SurfaceHitUniforms wide_box(double fall) {
  SurfaceHitUniforms u = surface_hit_uniforms(as_published(1, 1));
  u.camera = single_ray({0, rest_height + eye_above_water, 0}, falling(fall));
  u.half_size[0] = u.half_size[2] = 1e6f;
  return u;
}

template <class N>
class PuddleMarch : public testing::Test {};
using Evaluations = testing::Types<Single, Double>;
TYPED_TEST_SUITE(PuddleMarch, Evaluations);

TYPED_TEST(PuddleMarch, OfAFlatPlaneTakesTheTabulatedNumberOfSteps) {
  const TextureData level = wave_texture({0.5f}, 1, 1, Address::clamp);
  for (const FlatCase& c : flat_cases) {
    ASSERT_EQ(std::ceil(steps_exact(c.fall, 1e-3)), c.steps) << "the table itself";
    const auto hit = scalar::surface_hit_as_published<TypeParam>(wide_box(c.fall), level.view(), 0, 0);
    EXPECT_EQ(hit.iterations.v, c.steps) << c.fall;
    EXPECT_EQ(hit.flag.v, 1);
    // The march stops above the surface, nearer than epsilon; half an ulp of 4.5 and of the product come on top.
    EXPECT_GE(hit.position.y.v, rest_height - 1e-6);
    EXPECT_LT(hit.position.y.v, rest_height + 1e-3 + 1e-6);
  }
}

TEST(PuddleHit, MarchOfAFlatPlaneFollowsItsFormulaAtEveryAngle) {
  const TextureData level = wave_texture({0.5f}, 1, 1, Address::clamp);
  int compared = 0;
  for (double fall = 0.04; fall < 0.99; fall += 0.003) {
    const SurfaceHitUniforms u = wide_box(fall);
    const double fx = u.camera.forward[0], fy = u.camera.forward[1];  // rounded to float once
    const double exact = steps_exact(-fy / std::sqrt(fx * fx + fy * fy), u.epsilon);
    // Where the quotient is nearly whole the last step is decided by rounding: 200 steps lose at most 200 * 2^-52 * 18
    // of a distance of 1e-3, which moves the quotient by less than 1e-8.
    if (std::abs(exact - std::round(exact)) < 1e-6) continue;
    EXPECT_EQ(scalar::surface_hit_as_published<Double>(u, level.view(), 0, 0).iterations.v, std::ceil(exact)) << fall;
    ++compared;
  }
  EXPECT_GT(compared, 300);
}

TEST(PuddleHit, LevelWaterTakesTheTabulatedNumberOfSteps) {
  // Through the public entry: rays that start over one side of the box and come down before the other.
  for (const FlatCase& c : flat_cases) {
    if (c.fall < 0.17) continue;  // 13.5 / tan > 82: leaves the box of 84
    Settings s = as_published(1, 1);
    s.camera_position = {-41, rest_height + eye_above_water, 3};
    const auto d = falling(c.fall);
    s.camera_target = {-41 + d[0], rest_height + eye_above_water + d[1], 3};
    Puddle p(s, uniform_surroundings(1, 0.5f), executor());
    p.render();
    const auto h = hit_of(p, 0, 0);
    EXPECT_EQ(h[3], c.steps) << c.fall;
    EXPECT_THAT(h[1], testing::AllOf(testing::Ge(rest_height - 1e-6), testing::Lt(rest_height + 1e-3 + 1e-6)));
    EXPECT_EQ(h[7], 1);
  }
}

TEST(PuddleHit, PublishedCameraNeedsTenStepsInTheMiddleOfThePicture) {
  Puddle p(as_published(1, 1), uniform_surroundings(1, 0.5f), executor());
  p.render();
  EXPECT_EQ(hit_of(p, 0, 0)[3], 10);
}

// ---- corrected -----------------------------------------------------------------------------------------------------

// Eye, ray and length along the ray of a pixel of a rendered puddle, in double.
struct Seen {
  std::array<double, 3> eye, ray;
  double t;
};
Seen seen(const Settings& s, const Puddle& p, int x, int y) {
  const CameraUniforms c = camera_uniforms(s);
  const auto d = scalar::camera_ray<Double>(c, Double::index(x), Double(static_cast<float>(y)));
  const auto h = hit_of(p, x, y);
  Seen out{{c.position[0], c.position[1], c.position[2]}, {d.x.v, d.y.v, d.z.v}, 0};
  for (int k = 0; k < 3; ++k) out.t += (h[k] - out.eye[k]) * out.ray[k];
  return out;
}

// Float rounding of the march: positions up to 4 m have an ulp of 4.8e-7, a few of which add up.
constexpr double noise = 3e-6;
constexpr double epsilon = 1e-4;  // surface_hit's own, in metres

TEST(PuddleHit, CorrectedFlatSheetIsHitAtTheAnalyticPoint) {
  Settings s = corrected(33, 31);
  s.camera_position = {0.1, 0.5, 1.2};
  s.camera_target = {0, 0.35, 0};  // the horizon lies inside the picture
  s.vertical_fov_deg = 60;
  Puddle p(s, uniform_surroundings(1, 0.5f), executor());
  p.render();
  int inside = 0, outside = 0, above = 0;
  for (int y = 0; y < s.height; ++y) {
    for (int x = 0; x < s.width; ++x) {
      const auto h = hit_of(p, x, y);
      const Seen r = seen(s, p, x, y);
      if (r.ray[1] > -1e-4) {
        ++above;
        EXPECT_EQ(h[7], 0);
        EXPECT_THAT((std::array<double, 3>{h[4], h[5], h[6]}), testing::ElementsAre(0, 1, 0));
        for (int k = 0; k < 3; ++k) EXPECT_EQ(h[k], r.eye[k]) << "a ray that meets nothing stays at the eye";
        continue;
      }
      EXPECT_EQ(h[7], 1);
      EXPECT_EQ(h[5], 1);
      const double fall = -r.ray[1], plane = r.eye[1] / fall;
      const bool over_water = std::abs(h[0]) < 0.4 && std::abs(h[2]) < 0.3;
      ++(over_water ? inside : outside);
      // Over the water the march may stop epsilon above it; the sheet around it is met by one division. Relative: 1.5e-6
      // is a dozen roundings of float (a ray near the horizon multiplies that of its own slope by the distance).
      const double slack = (over_water ? epsilon / fall : 0) + 1.5e-6 * plane / fall;
      EXPECT_NEAR(r.t, plane, slack) << x << " " << y;
      EXPECT_NEAR(h[0], r.eye[0] + plane * r.ray[0], slack);
      EXPECT_NEAR(h[2], r.eye[2] + plane * r.ray[2], slack);
      EXPECT_LE(h[3], 4) << "a flat sheet takes no more than a step or two";
    }
  }
  EXPECT_GT(inside, 50);
  EXPECT_GT(outside, 50);
  EXPECT_GT(above, 50);
}

TEST(PuddleHit, CorrectedRaysOutsideTheRectangleMeetTheSheetWhateverTheWaterDoes) {
  // The water stands 1 cm high; rays that come down in front of the rectangle must not be carried to its side.
  Settings s = corrected(64, 48);
  s.camera_position = {0, 0.3, 1.0};
  s.camera_target = {0, 0, 0.35};
  Puddle p(s, uniform_surroundings(1, 0.5f), executor());
  p.set_water(std::vector<float>(1200, 0.01f), std::vector<float>(1200, 0.01f));
  p.render();
  int in_front = 0;
  for (int y = 0; y < s.height; ++y) {
    for (int x = 0; x < s.width; ++x) {
      const Seen r = seen(s, p, x, y);
      if (r.ray[1] > -1e-3) continue;
      const double plane = -r.eye[1] / r.ray[1], z = r.eye[2] + plane * r.ray[2];
      if (z < 0.3 + 1e-4) continue;
      ++in_front;
      EXPECT_NEAR(r.t, plane, noise / -r.ray[1]) << x << " " << y;
      EXPECT_NEAR(hit_of(p, x, y)[1], 0, noise);
    }
  }
  EXPECT_GT(in_front, 500);
}

// The exact surface of a corrected puddle, sampled in double.
struct Surface {
  SurfaceHitUniforms uniforms;
  TextureData wave;
  double above(const Seen& r, double t) const {
    return r.eye[1] + t * r.ray[1] -
           scalar::water_height<Double>(uniforms, wave.view(), coordinate(0, r.eye[0] + t * r.ray[0]),
                                        coordinate(1, r.eye[2] + t * r.ray[2]))
               .v;
  }
  // Texture coordinate of a place in the world, along x (0) or z (1).
  Double coordinate(int axis, double place) const {
    const double extent = 2.0 * uniforms.half_size[axis == 0 ? 0 : 2];
    return Double(place / extent + 0.5);
  }
};

// Every ray that meets the water inside the rectangle: its end lies on the surface (at most epsilon above it), and a
// search in steps of a 64th of a cell finds no crossing before it. Returns how many rays were judged.
int expect_no_crossing_is_missed(const Settings& s, const std::vector<float>& heights) {
  Puddle p(s, uniform_surroundings(1, 0.5f), executor());
  p.set_water(heights, heights);
  p.render();
  const Surface surface{surface_hit_uniforms(s), wave_texture(heights, s.grid[0], s.grid[1], Address::clamp)};
  const double half_x = 0.5 * s.grid[0] * s.cell_size, half_z = 0.5 * s.grid[1] * s.cell_size;
  int judged = 0;
  for (int y = 0; y < s.height; ++y) {
    for (int x = 0; x < s.width; ++x) {
      const Seen r = seen(s, p, x, y);
      if (r.ray[1] > -1e-4) continue;
      // The stretch over the rectangle.
      double begin = 0, end = 1e4;
      for (const auto& [k, half] : {std::pair{0, half_x}, std::pair{2, half_z}}) {
        const double a = (-half - r.eye[k]) / r.ray[k], b = (half - r.eye[k]) / r.ray[k];
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
      }
      if (begin >= end || -r.eye[1] / r.ray[1] < begin) continue;
      const double first = first_where(begin, end, s.cell_size / 64, [&](double t) { return surface.above(r, t) < 0; });
      if (first == end) continue;  // flies over all of the water
      if (first == begin) {        // comes in through the side, under the water's level
        EXPECT_NEAR(r.t, begin, noise / -r.ray[1]) << x << " " << y;
        continue;
      }
      ++judged;
      // The last step, Newton's, starts at most epsilon above the water and is at most two safe strides long; a safe stride brings the
      // ray no more than epsilon closer. It takes the slope of central differences: at a crease between two cells it may end under
      // the water by epsilon, or on a slope that falls away three epsilon above it.
      EXPECT_LE(r.t, first + (2 * epsilon + noise) / -r.ray[1]) << "crossed at " << x << " " << y;
      const double left = surface.above(r, r.t);
      EXPECT_LE(left, 3 * epsilon + noise) << x << " " << y;
      EXPECT_GE(left, -epsilon - noise) << x << " " << y;
      EXPECT_LT(hit_of(p, x, y)[3], s.max_steps - 1) << "the march ran out of steps at " << x << " " << y;
    }
  }
  return judged;
}

// Crossing waves, and at each texel up to 2 mm of noise on top, which make slopes of up to 0.5.
std::vector<float> rough(const Settings& s) {
  std::vector<float> heights;
  for (int y = 0; y < s.grid[1]; ++y) {
    for (int x = 0; x < s.grid[0]; ++x) {
      const auto b = random::block(1, random::Purpose::puddle_bed, static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
      heights.push_back(static_cast<float>(0.006 * std::sin(0.8 * x + 0.3 * y) + 0.004 * std::cos(0.5 * x - 0.9 * y) +
                                           0.004 * (random::uniform(b[0]) - 0.5)));
    }
  }
  return heights;
}

TEST(PuddleHit, CorrectedMarchNeverCrossesACrest) {
  for (const double eye : {0.03, 0.1, 0.5}) {  // the lowest grazes the crests
    Settings s = corrected(48, 32);
    s.max_steps = 4096;
    s.camera_position = {0.05, eye, 0.7};
    s.camera_target = {0, 0, 0};
    EXPECT_GT(expect_no_crossing_is_missed(s, rough(s)), 100) << eye;
  }
}

TEST(PuddleHit, CorrectedMarchNeverCrossesARoughPatchInCalmWater) {
  // Steep waves in the middle of level water: rays start with the bounds of calm blocks and run into the patch.
  for (const double eye : {0.05, 0.2}) {
    Settings s = corrected(40, 24);
    s.grid = {150, 110};
    s.max_steps = 4096;
    s.camera_position = {0.1, eye, 1.3};
    s.camera_target = {0, 0, 0};
    s.vertical_fov_deg = 25;
    std::vector<float> heights = rough(s);
    for (int y = 0; y < 110; ++y) {
      for (int x = 0; x < 150; ++x) {
        if (std::abs(x - 75) > 20 || std::abs(y - 55) > 20) heights[static_cast<std::size_t>(y) * 150 + x] *= 0.01f;
      }
    }
    EXPECT_GT(expect_no_crossing_is_missed(s, heights), 100) << eye;
  }
}

TEST(PuddleHit, CorrectedMarchNeverCrossesTheFlankAtTheEdge) {
  // Level water 1 cm up ends at the rectangle's edge in a wall.
  Settings s = corrected(48, 32);
  s.max_steps = 4096;
  s.camera_position = {0.05, 0.03, 0.7};
  s.camera_target = {0, 0, 0.1};
  EXPECT_GT(expect_no_crossing_is_missed(s, std::vector<float>(1200, 0.01f)), 40);
}

TEST(PuddleHit, NormalsAreCentralDifferencesOfTheHeight) {
  // h = a x + b z has the normal (-a, 1, -b) / sqrt(1 + a^2 + b^2) exactly, away from the edge.
  Settings s = looking_down(corrected(16, 12), 0.5);
  const double a = 0.05, b = -0.03;
  std::vector<float> heights;
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) heights.push_back(static_cast<float>(a * 0.02 * (x - 19.5) + b * 0.02 * (y - 14.5)));
  }
  Puddle p(s, uniform_surroundings(1, 0.5f), executor());
  p.set_water(heights, heights);
  p.render();
  const double scale = 1 / std::sqrt(1 + a * a + b * b);
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 16; ++x) {
      const auto h = hit_of(p, x, y);
      // Half storage; the difference of two float heights of 2 cm over two cells adds 1e-7.
      EXPECT_NEAR(h[4], -a * scale, a * half_error + 1e-7);
      EXPECT_NEAR(h[5], scale, half_error);
      EXPECT_NEAR(h[6], -b * scale, -b * half_error + 1e-7);
    }
  }
}

}  // namespace
}  // namespace rainref::puddle::test
