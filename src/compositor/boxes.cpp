#include "compositor/boxes.h"

#include "compositor/flat_kernels.h"

namespace rainref::compositor {

namespace {

struct Entry {
  double t;
  int axis;  // of the face
  bool is_met;
};

/// Reciprocals stay finite, to avoid infinity times zero.
Entry enter(const Box& box, const Ray& ray) {
  double from = 0, to = 1e30;
  int axis = 0;
  for (int k = 0; k < 3; ++k) {
    const double d = ray.direction[k], inverse = d < 1e-30 && d > -1e-30 ? 1e30 : 1 / d;
    const double a = (box.low[k] - ray.origin[k]) * inverse, b = (box.high[k] - ray.origin[k]) * inverse;
    const double in = b < a ? b : a, out = a < b ? b : a;
    if (from < in) {
      from = in;
      axis = k;
    }
    to = out < to ? out : to;
  }
  return {from, axis, from <= to && from > 0};
}

}  // namespace

void Boxes::meet(std::uint32_t self, std::uint32_t primitive, const Ray& ray, Hit& first) const {
  const Entry entry = enter(boxes_[primitive], ray);
  if (!entry.is_met || !(entry.t >= ray.nearest && entry.t <= ray.farthest)) return;
  const Hit hit{entry.t, self, primitive, 0, 0};
  if (precedes(hit, first)) first = hit;
}

std::uint32_t Boxes::meet_packet(std::uint32_t self, std::uint32_t primitive, std::uint32_t lanes, Packet& packet) const {
  return meet_box(boxes_[primitive].low, boxes_[primitive].high, self, primitive, lanes, packet);
}

Vec Boxes::normal(const Ray& ray, const Hit& hit) const {
  Vec out(0, 0, 0);
  const int axis = enter(boxes_[hit.part], ray).axis;
  out[axis] = ray.direction[axis] > 0 ? -1 : 1;
  return out;
}

}  // namespace rainref::compositor
