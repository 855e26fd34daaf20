// Rays that floats cannot be sure of: whatever the walk in floats says, the answer is that of doubles.
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "compositor/heightfield.h"
#include "compositor/packets.h"
#include "compositor/world.h"
#include "math/every_target.h"

namespace rainref::compositor {
namespace {

double number(std::uint32_t a, std::uint32_t b) { return test::random_number(a, b); }

/// A sheet, and what a test needs to aim at it.
struct Sheet {
  std::string name;
  HeightfieldFrame frame;
  int columns, rows, tile;
  std::vector<float> heights;
  std::shared_ptr<Heightfield> field;

  Vec at(double x, double y, double h) const {
    return frame.origin + x / columns * frame.edge_u + y / rows * frame.edge_v + h * frame.axis;
  }
  double height(int x, int y) const {
    return static_cast<double>(heights[static_cast<std::size_t>(y) * static_cast<std::size_t>(columns + 1) + static_cast<std::size_t>(x)]);
  }
};

Sheet sheet(const std::string& name, const HeightfieldFrame& frame, int columns, int rows, int tile, const auto& height) {
  Sheet out{name, frame, columns, rows, tile, {}, std::make_shared<Heightfield>(frame, columns, rows, tile)};
  for (int y = 0; y <= rows; ++y) {
    for (int x = 0; x <= columns; ++x) out.heights.push_back(static_cast<float>(height(x, y)));
  }
  out.field->assign(out.heights, parallel::Executor(1));
  return out;
}

std::vector<Sheet> sheets() {
  const HeightfieldFrame level{{0, 0, 0}, {40, 0, 0}, {0, 0, 40}, {0, 1, 0}}, sheared{{1, 2, 3}, {30, 0, 5}, {-4, 25, 2}, {0.25, -0.5, 2}};
  const auto noise = [](int x, int y) { return number(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y) + 100); };
  const auto waves = [](int x, int y) { return 0.3 * std::sin(0.4 * x + 0.1 * y) + 0.1 * std::cos(0.7 * y); };
  std::vector<Sheet> out;
  out.push_back(sheet("waves", level, 40, 40, 40, waves));
  out.push_back(sheet("waves in tiles", level, 40, 40, 13, waves));
  out.push_back(sheet("noise", level, 37, 41, 16, noise));
  out.push_back(sheet("noise in a sheared frame", sheared, 33, 29, 8, noise));
  out.push_back(sheet("spikes", level, 40, 40, 20, [&](int x, int y) { return x % 5 == 2 && y % 7 == 3 ? 12.0 : 0.01 * noise(x, y); }));
  out.push_back(sheet("far spikes", {{0, 0, 0}, {300, 0, 0}, {0, 0, 200}, {0, 1, 0}}, 300, 200, 300,
                      [&](int x, int y) { return x % 23 == 2 && y % 29 == 3 ? 12.0 : 0.01 * noise(x, y); }));
  out.push_back(sheet("level", level, 40, 40, 40, [](int, int) { return 0.25; }));
  out.push_back(sheet("ripples high up", level, 40, 40, 40, [&](int x, int y) { return 1000 + 0.001 * waves(x, y); }));
  out.push_back(sheet("planes", level, 40, 40, 10, [](int x, int y) { return 0.125 * x - 0.0625 * y; }));
  return out;
}

/// Rays at vertices, edges, diagonals and facets, and beside them by what floats and doubles can just tell apart or not; along lines,
/// diagonals and the facets themselves; from near and far, from on the sheet, from below.
std::vector<Ray> rays_at(const Sheet& s, std::uint32_t count) {
  std::vector<Ray> rays;
  for (std::uint32_t k = 0; k < count; ++k) {
    const auto n = [k](std::uint32_t i) { return number(k, 20 + i); };
    int x = static_cast<int>(n(0) * s.columns), y = static_cast<int>(n(1) * s.rows);
    const bool enters_on_the_sheet = k % 6 == 5;
    if (k % 23 == 0 || enters_on_the_sheet) x -= x % s.tile;  // where tiles begin
    if (k % 29 == 0) y -= y % s.tile;
    if (k % 2 == 0 && s.name == "far spikes") {
      x = std::min(x - x % 23 + 1 + static_cast<int>(k / 2 % 2), s.columns - 1);
      y = std::min(y - y % 29 + 2 + static_cast<int>(k / 4 % 2), s.rows - 1);
    }
    const double h00 = s.height(x, y), h10 = s.height(x + 1, y), h01 = s.height(x, y + 1), h11 = s.height(x + 1, y + 1);
    const double f = k % 3 == 0 ? 0.5 : n(2), g = n(3);
    double u = 0, v = 0;
    switch (k % 5) {
      case 1:
        u = f;
        break;
      case 2:
        v = f;
        break;
      case 3:
        u = f, v = 1 - f;
        break;
      case 4:
        u = f, v = g;
        break;
      default:
        break;
    }
    if (enters_on_the_sheet) u = 0, v = f;
    const double h = u + v <= 1 ? h00 + u * (h10 - h00) + v * (h01 - h00) : h11 + (1 - u) * (h01 - h11) + (1 - v) * (h10 - h11);
    constexpr double apart[]{0, 1e-12, 1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3};
    const double off = enters_on_the_sheet ? 0 : apart[k / 5 % 8], sign = k % 2 ? 1 : -1;
    const Vec target = s.at(x + u + off * (n(4) - 0.5), y + v + off * (n(5) - 0.5), h + sign * off);
    // In cells along u and v and in heights.
    double du = n(6) - 0.5, dv = n(7) - 0.5, dh = -n(8);
    switch (enters_on_the_sheet ? 4 : k / 7 % 9) {
      case 0:
        du = 0;
        break;
      case 1:
        dv = 0;
        break;
      case 2:
        dv = k % 4 < 2 ? du : -du;
        break;
      case 3:
        du = dv = 0;
        break;
      case 4:  // within the facet, or almost
        dh = (u + v <= 1 ? du * (h10 - h00) + dv * (h01 - h00) : du * (h11 - h01) + dv * (h11 - h10)) - off;
        break;
      case 5:
        dh = -dh;
        break;
      case 6:
        dh = -1e-3 * n(8);
        break;
      case 7:
        du *= 1e-7;
        break;
      default:
        break;
    }
    const Vec direction = s.at(du, dv, dh) - s.at(0, 0, 0);
    if (direction == Vec(0, 0, 0)) continue;
    constexpr double away[]{0, 0.5, 3, 20, 100, 3000, 1e6, 1e9, 1e13};
    const double back = away[k / 3 % 9];
    Ray ray{target - back * direction, direction};
    if (k % 11 == 0) ray.nearest = back * n(9);
    if (k % 13 == 0) ray.farthest = back + n(9) - 0.5;
    if (k % 17 == 0) ray = {target, s.at(n(10) - 0.5, n(11) - 0.5, n(12) - 0.2) - s.at(0, 0, 0), 1e-3 * n(9)};
    rays.push_back(ray);
  }
  rays.resize(rays.size() / 16 * 16);
  return rays;
}

TEST(HeightfieldFloats, WhateverTheySayTheAnswerIsThatOfDoubles) {
  for (const Sheet& s : sheets()) {
    const std::vector<Ray> rays = rays_at(s, 60'000);
    int met = 0;
    test::for_every_target([&] {
      met = test::expect_packets_to_meet_as_rays(*s.field, rays, [](std::size_t i) { return i % 19 == 0 ? Hit{2.5, 5, 0, 0, 0} : Hit(); });
    });
    EXPECT_GT(met, 15'000) << s.name;
    if (testing::Test::HasFailure()) FAIL() << s.name;
  }
}

// A hit of another surface at the same distance: the lower number and then the lower part is first, also where floats found the hit.
TEST(HeightfieldFloats, TiesGoByNumber) {
  const Sheet s = sheets().front();
  std::vector<Ray> rays;
  std::vector<Hit> found;
  for (const Ray& ray : rays_at(s, 4000)) {
    Hit hit;
    for (std::uint32_t i = 0; i < s.field->primitives(); ++i) s.field->meet(0, i, ray, hit);
    if (hit.is_surface()) rays.push_back(ray), found.push_back(hit);
  }
  for (const std::uint32_t other : {5u, 0u}) {
    test::expect_packets_to_meet_as_rays(*s.field, rays, [&](std::size_t i) {
      return Hit{found[i].t, other, other == 0 ? found[i].part + (i % 2 ? 1 : 0) : 0, 0.5, 0.5};
    });
  }
}

TEST(HeightfieldFloats, NumbersThatAreNoneOrTooLargeAreLeftToDoubles) {
  const Sheet s = sheets().front();
  std::vector<Ray> rays;
  for (const double big : {1e-320, 1e-40, 1e-3, 1e15, 1e25, 1e40, 1e200}) {
    for (int k = 0; k < 64; ++k) {
      const Vec towards = s.at(20.3 + 0.1 * k, 17.1, 0) - s.at(3.7, 4.2, 5);
      rays.push_back({s.at(3.7, 4.2, 5), big * towards});
      rays.push_back({s.at(20.3 + 0.1 * k, 17.1, 0) - big * towards, towards});
      rays.push_back({s.at(20.3 + 0.1 * k, 17.1, 5), {k % 3 == 0 ? big : 0, -1, k % 3 == 1 ? -big : 0.0}});
      rays.push_back({s.at(20.3 + 0.1 * k, 17.1, 5), {0, -1, 0}, k % 2 ? big : 0, k % 2 ? std::numeric_limits<double>::infinity() : big});
    }
  }
  test::for_every_target([&] { test::expect_packets_to_meet_as_rays(*s.field, rays, [](std::size_t) { return Hit(); }); });
  auto heights = s.heights;
  for (const float huge : {1e30f, 3e38f, -3e38f}) {
    heights[500] = huge;
    s.field->assign(heights, parallel::Executor(1));
    test::for_every_target([&] { test::expect_packets_to_meet_as_rays(*s.field, rays, [](std::size_t) { return Hit(); }); });
  }
}

}  // namespace
}  // namespace rainref::compositor
