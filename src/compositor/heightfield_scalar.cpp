// The walk through a heightfield for one ray.
#include "compositor/heightfield_view.h"
#include "math/real64.h"

namespace rainref::compositor {

namespace {

using R = Real64;
R minimum(R a, R b) { return select(b < a, b, a); }
R maximum(R a, R b) { return select(a < b, b, a); }
bool without(bool a, bool b) { return a && !b; }
R whole(R a) {
  const double cut = static_cast<double>(static_cast<std::int64_t>(a.v));
  return cut > a.v ? cut - 1 : cut;
}
R gather(const float* p, R index) { return static_cast<double>(p[static_cast<std::int64_t>(index.v)]); }
void corners(const float* pairs, R index, R& h00, R& h10, R& h01, R& h11) {
  const float* const p = pairs + 2 * static_cast<std::int64_t>(index.v);
  h00 = static_cast<double>(p[0]), h01 = static_cast<double>(p[1]), h10 = static_cast<double>(p[2]), h11 = static_cast<double>(p[3]);
}

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "compositor/heightfield_walk-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace

void meet_tile(const HeightfieldView& field, const HeightfieldTile& tile, std::uint32_t self, const Ray& ray, Hit& first) {
  const R origin[3] = {ray.origin.x, ray.origin.y, ray.origin.z}, direction[3] = {ray.direction.x, ray.direction.y, ray.direction.z};
  R t(0.0), part(0.0), u(0.0), v(0.0);
  if (!meet_cells(field, tile, to_grid<false>(field, origin, direction, R(ray.nearest), R(ray.farthest)), R(first.t), true, t, part, u, v))
    return;
  const Hit found{t.v, self, static_cast<std::uint32_t>(part.v), u.v, v.v};
  if (precedes(found, first)) first = found;
}

}  // namespace rainref::compositor
