// The sums over sources are compiled once for each SIMD target: points of a grid's row in lanes of doubles, each with the operations of a
// single point.
#include "night_street/light_map.h"

#include <algorithm>

#include "night_street/city.h"
#include "night_street/light_row.h"

#define RAINREF_KERNELS "night_street/light_map.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(night_street)

/// Light of the sources at the points of a row, divided by pi.
void Receive(const Source* const* sources, std::size_t count, const LightRow& row, Vec* out) {
  constexpr double one_over_pi = 0.31830988618379067;
  const hn::ScalableTag<double> d;
  const std::size_t lanes = hn::Lanes(d);
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0);
  for (std::size_t first = 0; first < row.count; first += lanes) {
    const auto a = hn::Add(hn::Set(d, row.first), hn::Mul(hn::Iota(d, static_cast<double>(first)), hn::Set(d, row.step)));
    auto red = zero, green = zero, blue = zero;
    for (std::size_t k = 0; k < count; ++k) {
      const Source& s = *sources[k];
      const auto x = hn::Sub(hn::Set(d, s.position.x), row.is_ground ? a : hn::Set(d, row.x));
      const auto y = hn::Sub(hn::Set(d, s.position.y), row.is_ground ? zero : a);
      const auto z = hn::Sub(hn::Set(d, s.position.z), hn::Set(d, row.z));
      const auto sum = [&](auto px, auto py, auto pz) HWY_ATTR { return hn::Add(hn::Add(hn::Mul(x, px), hn::Mul(y, py)), hn::Mul(z, pz)); };
      const auto squared = hn::Add(sum(x, y, z), hn::Set(d, 0.05));  // a source that touches the surface stays finite
      const auto distance = hn::Sqrt(squared);
      const auto facing = hn::Div(row.is_ground ? y : row.x < 0 ? x : hn::Neg(x), distance);
      const auto axis = sum(hn::Set(d, s.axis.x), hn::Set(d, s.axis.y), hn::Set(d, s.axis.z));
      auto along = hn::Min(hn::Max(hn::Div(hn::Neg(axis), distance), zero), one);
      for (int i = 0; i < s.focus; ++i) along = hn::Mul(along, along);
      const auto gain = hn::Add(one, hn::Mul(hn::Set(d, s.gain), along));
      const auto light = hn::Div(hn::Mul(hn::Mul(hn::Set(d, one_over_pi), facing), gain), squared);
      const auto weight = hn::IfThenElseZero(hn::Gt(facing, zero), light);
      red = hn::Add(red, hn::Mul(weight, hn::Set(d, s.intensity.x)));
      green = hn::Add(green, hn::Mul(weight, hn::Set(d, s.intensity.y)));
      blue = hn::Add(blue, hn::Mul(weight, hn::Set(d, s.intensity.z)));
    }
    double r[hn::MaxLanes(d)], g[hn::MaxLanes(d)], b[hn::MaxLanes(d)];
    hn::StoreU(red, d, r);
    hn::StoreU(green, d, g);
    hn::StoreU(blue, d, b);
    for (std::size_t i = 0; i < std::min(lanes, row.count - first); ++i) out[first + i] = {r[i], g[i], b[i]};
  }
}

RAINREF_TARGET_END(night_street)

#if RAINREF_ONCE
namespace rainref::night_street {

RAINREF_EXPORT(Receive);

namespace {

constexpr double reach = 45;  // metres along the street beyond which a source adds nothing visible

}  // namespace

Vec LightMap::Grid::at(double a, double z) const {
  const double u = min_of(max_of((a - first_a) / step_a, 0), count_a - 1.001);
  const double v = min_of(max_of((z - first_z) / step_z, 0), count_z - 1.001);
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const Vec* row = cells.data() + static_cast<std::ptrdiff_t>(j) * count_a + i;
  return mix(mix(row[0], row[1], u - i), mix(row[count_a], row[count_a + 1], u - i), v - j);
}

LightMap::LightMap(const std::vector<Source>& sources, const Rows& rows) {
  const auto fill = [&](Grid& grid, LightRow row) {
    grid.cells.assign(static_cast<std::size_t>(grid.count_a) * grid.count_z, Vec{});
    row.first = grid.first_a;
    row.step = grid.step_a;
    row.count = static_cast<std::size_t>(grid.count_a);
    rows(grid.count_z, [&](int begin, int end) {
      LightRow one = row;
      std::vector<const Source*> near;
      for (int j = begin; j < end; ++j) {
        one.z = grid.first_z + j * grid.step_z;
        near.clear();
        for (const Source& source : sources) {
          if (magnitude(source.position.z - one.z) < reach) near.push_back(&source);
        }
        RAINREF_DISPATCH(Receive)(near.data(), near.size(), one, grid.cells.data() + static_cast<std::size_t>(j) * row.count);
      }
    });
  };
  ground_ = {-8, 0.5, -300, 0.75, 33, 801, {}};
  fill(ground_, {.is_ground = true});
  for (int side = 0; side < 2; ++side) {
    facade_[side] = {0, 1, -300, 1, 36, 601, {}};
    fill(facade_[side], {.is_ground = false, .x = side == 0 ? -plan::facade : plan::facade});
  }
}

Vec LightMap::ground(double x, double z) const { return ground_.at(x, z); }
Vec LightMap::facade(int side, double y, double z) const { return facade_[side].at(y, z); }

}  // namespace rainref::night_street
#endif
