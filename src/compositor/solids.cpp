#include "compositor/solids.h"

#include <glm/geometric.hpp>

#include "compositor/flat_kernels.h"

namespace rainref::compositor {

namespace {

constexpr double everywhere = 1e30;

/// The street's rays have unit directions.
struct UnitRay {
  double length;
  night_street::Ray ray;
  explicit UnitRay(const Ray& from) : length(glm::length(from.direction)), ray(from.origin, from.direction / length) {}
};

/// A box needs no unit direction. Reciprocals stay finite, so that nothing is infinity times zero.
bool enter_box(const night_street::Solid& box, const Ray& ray, double& entry) {
  double from = 0, to = everywhere;
  for (int k = 0; k < 3; ++k) {
    const double d = ray.direction[k], inverse = night_street::magnitude(d) < 1e-30 ? 1e30 : 1 / d;
    const double a = (box.a[k] - ray.origin[k]) * inverse, b = (box.b[k] - ray.origin[k]) * inverse;
    from = night_street::max_of(from, night_street::min_of(a, b));
    to = night_street::min_of(to, night_street::max_of(a, b));
  }
  entry = from;
  return from <= to && from > 0;
}

}  // namespace

Solids::Solids(std::vector<night_street::Solid> solids, std::vector<night_street::Plane> planes)
    : solids_(std::move(solids)), planes_(std::move(planes)) {}

Box Solids::bounds(std::uint32_t primitive) const {
  const night_street::Box box = solids_[primitive].bounds();
  return {box.low, box.high};
}

void Solids::meet(std::uint32_t self, std::uint32_t primitive, const Ray& ray, Hit& first) const {
  double t = 0;
  if (solids_[primitive].shape == night_street::Solid::box) {
    if (!enter_box(solids_[primitive], ray, t)) return;
  } else {
    const UnitRay unit(ray);
    night_street::SolidHit met;
    if (!night_street::intersect(solids_[primitive], planes_, unit.ray, 0, everywhere, met)) return;
    t = met.t / unit.length;
  }
  if (!(t >= ray.nearest && t <= ray.farthest)) return;
  const Hit hit{t, self, primitive, 0, 0};
  if (precedes(hit, first)) first = hit;
}

std::uint32_t Solids::meet_packet(std::uint32_t self, std::uint32_t primitive, std::uint32_t lanes, Packet& packet) const {
  const night_street::Solid& solid = solids_[primitive];
  return solid.shape == night_street::Solid::box ? meet_box(solid.a, solid.b, self, primitive, lanes, packet)
                                                 : Surface::meet_packet(self, primitive, lanes, packet);
}

Vec Solids::normal(const Ray& ray, const Hit& hit) const {
  night_street::SolidHit met{0, {0, 1, 0}};
  night_street::intersect(solids_[hit.part], planes_, UnitRay(ray).ray, 0, everywhere, met);
  return met.normal;
}

}  // namespace rainref::compositor
