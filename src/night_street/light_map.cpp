#include "night_street/light_map.h"

#include "night_street/city.h"

namespace rainref::night_street {

namespace {

constexpr double one_over_pi = 0.31830988618379067;
constexpr double reach = 45;  // metres along the street beyond which a source adds nothing visible

/// What `source` gives a surface point with this unit normal, divided by pi.
Vec received(const Source& source, const Vec& point, const Vec& normal) {
  const Vec towards = source.position - point;
  const double squared = dot(towards, towards) + 0.05;  // a source that touches the surface stays finite
  const double distance = std::sqrt(squared);
  const double facing = dot(towards, normal) / distance;
  if (facing <= 0) return {};
  double along = clamp01(-dot(towards, source.axis) / distance);
  for (int i = 0; i < source.focus; ++i) along *= along;
  return (one_over_pi * facing * (1 + source.gain * along) / squared) * source.intensity;
}

}  // namespace

Vec LightMap::Grid::at(double a, double z) const {
  const double u = min_of(max_of((a - first_a) / step_a, 0), count_a - 1.001);
  const double v = min_of(max_of((z - first_z) / step_z, 0), count_z - 1.001);
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const Vec* row = cells.data() + static_cast<std::ptrdiff_t>(j) * count_a + i;
  return mix(mix(row[0], row[1], u - i), mix(row[count_a], row[count_a + 1], u - i), v - j);
}

LightMap::LightMap(const std::vector<Source>& sources, const Rows& rows) {
  const auto fill = [&](Grid& grid, auto point_of, const Vec& normal) {
    grid.cells.assign(static_cast<std::size_t>(grid.count_a) * grid.count_z, Vec{});
    rows(grid.count_z, [&](int begin, int end) {
      std::vector<const Source*> near;
      for (int j = begin; j < end; ++j) {
        const double z = grid.first_z + j * grid.step_z;
        near.clear();
        for (const Source& source : sources) {
          if (magnitude(source.position.z - z) < reach) near.push_back(&source);
        }
        for (int i = 0; i < grid.count_a; ++i) {
          const Vec point = point_of(grid.first_a + i * grid.step_a, z);
          Vec sum;
          for (const Source* source : near) sum = sum + received(*source, point, normal);
          grid.cells[static_cast<std::size_t>(j) * grid.count_a + i] = sum;
        }
      }
    });
  };
  ground_ = {-8, 0.5, -300, 0.75, 33, 801, {}};
  fill(ground_, [](double a, double z) { return Vec{a, 0, z}; }, {0, 1, 0});
  for (int side = 0; side < 2; ++side) {
    const double x = side == 0 ? -plan::facade : plan::facade;
    facade_[side] = {0, 1, -300, 1, 36, 601, {}};
    fill(facade_[side], [x](double a, double z) { return Vec{x, a, z}; }, {side == 0 ? 1.0 : -1.0, 0, 0});
  }
}

Vec LightMap::ground(double x, double z) const { return ground_.at(x, z); }
Vec LightMap::facade(int side, double y, double z) const { return facade_[side].at(y, z); }

}  // namespace rainref::night_street
