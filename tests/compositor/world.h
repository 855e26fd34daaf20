// What tests and benchmarks trace: wavy water of 512 x 512 cells among boxes, over a ground, beside a pane; and rays.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "compositor/boxes.h"
#include "compositor/heightfield.h"
#include "compositor/plates.h"
#include "compositor/tracer.h"
#include "random/counter.h"

namespace rainref::test {}
namespace rainref::compositor::test {

using namespace rainref::test;  // what the tests of all rooms share

inline constexpr int water_cells = 512;
inline constexpr double water_half_side = 42;
inline constexpr double water_cell = 2 * water_half_side / water_cells;

/// Two ring waves and a slanted one, at most 0.44 high; `phase` moves them.
inline std::vector<float> water_heights(double phase) {
  std::vector<float> out;
  out.reserve((water_cells + 1) * (water_cells + 1));
  for (int j = 0; j <= water_cells; ++j) {
    for (int i = 0; i <= water_cells; ++i) {
      const double x = i * water_cell - water_half_side, z = j * water_cell - water_half_side;
      const double near = std::hypot(x - 5, z - 8), far = std::hypot(x + 12, z);
      out.push_back(static_cast<float>(0.35 * std::sin(1.9 * near - phase) / (1 + 0.08 * near) +
                                       0.25 * std::sin(2.7 * far - 1.3 * phase) / (1 + 0.1 * far) +
                                       0.04 * std::sin(3.1 * x + 2.3 * z + phase)));
    }
  }
  return out;
}

/// A number in [0, 1) from a number.
inline double random_number(std::uint32_t a, std::uint32_t b) {
  return static_cast<double>(random::uniform(random::pcg4d({a, b, 77, 5})[0]));
}

struct World {
  std::shared_ptr<Heightfield> water;
  std::vector<Box> boxes;  ///< the first is the ground
  Plate pane;
  std::vector<std::shared_ptr<const Surface>> surfaces;  ///< water, boxes, pane

  explicit World(int tile_cells = 128, double phase = 1) {
    const parallel::Executor executor(1);
    const double s = water_half_side;
    water = std::make_shared<Heightfield>(HeightfieldFrame{{-s, 0, -s}, {2 * s, 0, 0}, {0, 0, 2 * s}, {0, 1, 0}}, water_cells, water_cells,
                                          tile_cells);
    water->assign(water_heights(phase), executor);
    boxes.push_back({{-100, -3, -100}, {100, -2, 100}});
    for (std::uint32_t k = 0; k < 12; ++k) {
      const double x = 70 * random_number(k, 0) - 35, z = 70 * random_number(k, 1) - 35, w = 0.5 + 2 * random_number(k, 2);
      boxes.push_back({{x - w, -2, z - w}, {x + w, 0.5 + 3 * random_number(k, 3), z + w}});
    }
    pane = {Plate::parallelogram, {14, 14, 16}, {3, 0, -3}, {-0.5, 2.5, -0.5}};
    surfaces = {water, std::make_shared<Boxes>(boxes), std::make_shared<Plates>(std::vector<Plate>{pane})};
  }
  void add_to(Tracer& tracer) const {
    for (const auto& surface : surfaces) tracer.add(surface);
    tracer.commit();
  }
};

/// Rounded to floats, so that Embree's own triangles see the same ray.
inline Ray float_exact(const Vec& origin, const Vec& direction) { return {Vec(glm::vec3(origin)), Vec(glm::vec3(direction))}; }

/// A pinhole's rays in blocks of 4 x 4 pixels, 60 degrees high; both sizes are multiples of 4.
inline std::vector<Ray> pinhole(const Vec& eye, const Vec& target, int width, int height) {
  const Vec forward = glm::normalize(target - eye), right = glm::normalize(cross(forward, Vec(0, 1, 0))), up = cross(right, forward);
  const double tangent = std::sqrt(1.0 / 3);
  std::vector<Ray> rays;
  for (int by = 0; by < height; by += 4) {
    for (int bx = 0; bx < width; bx += 4) {
      for (int k = 0; k < 16; ++k) {
        const double u = ((bx + k % 4 + 0.5) / width * 2 - 1) * tangent * width / height,
                     v = (1 - (by + k / 4 + 0.5) / height * 2) * tangent;
        rays.push_back(float_exact(eye, glm::normalize(forward + u * right + v * up)));
      }
    }
  }
  return rays;
}
inline std::vector<Ray> camera_rays(int width, int height) { return pinhole({20, 18, 14}, {-6, -4, 10}, width, height); }
inline std::vector<Ray> grazing_rays(int width, int height) { return pinhole({38, 1.6, 36}, {-30, 0, -28}, width, height); }

/// The reflections of the rays that meet the water, from just above it.
inline std::vector<Ray> reflection_rays(const World& world, const std::vector<Ray>& rays, const std::vector<Hit>& hits) {
  std::vector<Ray> out;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].surface != 0) continue;
    const Vec n = world.water->smooth_normal(hits[i]), d = rays[i].direction;
    out.push_back(float_exact(rays[i].at(hits[i].t) + 1e-3 * n, d - 2 * dot(d, n) * n));
  }
  out.resize(out.size() / 16 * 16);
  return out;
}

/// Vertex (i, j) of the water.
inline Vec vertex(const World& world, int i, int j) {
  return {i * water_cell - water_half_side,
          static_cast<double>(world.water->heights()[static_cast<std::size_t>(j) * (water_cells + 1) + i]),
          j * water_cell - water_half_side};
}

/// Rays meant for vertices, edges and diagonals: straight down, from the camera's eye, along lines and diagonals.
inline std::vector<Ray> aimed_rays(const World& world, std::uint32_t count) {
  std::vector<Ray> rays;
  for (std::uint32_t k = 0; k < count; ++k) {
    const int i = static_cast<int>(random_number(k, 1) * water_cells), j = static_cast<int>(random_number(k, 2) * water_cells);
    const Vec a = vertex(world, i, j), x = vertex(world, i + 1, j), z = vertex(world, i, j + 1);
    switch (k % 6) {
      case 0:
        rays.push_back(float_exact({a.x, 10, a.z}, {0, -1, 0}));
        break;
      case 1:
        rays.push_back(float_exact({a.x, 10, (a.z + z.z) / 2}, {0, -1, 0}));
        break;
      case 2:
        rays.push_back(float_exact({20, 18, 14}, a - Vec(20, 18, 14)));
        break;
      case 3:
        rays.push_back(float_exact({20, 18, 14}, (x + z) / 2.0 - Vec(20, 18, 14)));
        break;
      case 4:
        rays.push_back(float_exact({a.x, a.y + 2, a.z - 5}, {0, -2, 5}));
        break;
      default:
        rays.push_back(float_exact({a.x - 5, a.y + 1, a.z - 5}, {5, -1, 5}));
        break;
    }
  }
  return rays;
}

inline std::vector<Hit> first_hits(const Tracer& tracer, const std::vector<Ray>& rays) {
  std::vector<Hit> hits(rays.size());
  tracer.first_hits(rays, hits);
  return hits;
}

}  // namespace rainref::compositor::test
