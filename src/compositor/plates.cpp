#include "compositor/plates.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "rainref/error.h"

namespace rainref::compositor {

Plates::Plates(std::vector<Plate> plates) {
  for (const Plate& plate : plates) {
    const Vec n = cross(plate.edge_u, plate.edge_v);
    const double area = glm::length(n);
    if (!(area > 1e-12 * glm::length(plate.edge_u) * glm::length(plate.edge_v)))
      throw Error(ExitCode::usage, fmt::format("the edges of plate {} are parallel", plates_.size()));
    plates_.push_back(plate);
    flats_.push_back({plate.origin, n / area, cross(plate.edge_v, n) / (area * area), cross(n, plate.edge_u) / (area * area),
                      plate.shape == Plate::ellipse});
  }
}

Box Plates::bounds(std::uint32_t primitive) const {
  const Plate& plate = plates_[primitive];
  Box box{plate.origin, plate.origin};
  for (const double u : {plate.shape == Plate::ellipse ? -1.0 : 0.0, 1.0}) {
    for (const double v : {plate.shape == Plate::ellipse ? -1.0 : 0.0, 1.0}) {
      const Vec p = plate.origin + u * plate.edge_u + v * plate.edge_v;
      for (int k = 0; k < 3; ++k) {
        box.low[k] = std::min(box.low[k], p[k]);
        box.high[k] = std::max(box.high[k], p[k]);
      }
    }
  }
  return box;
}

void Plates::meet(std::uint32_t self, std::uint32_t primitive, const Ray& ray, Hit& first) const {
  const FlatPlate& flat = flats_[primitive];
  const double closing = dot(flat.normal, ray.direction);
  if (closing == 0) return;
  const double t = dot(flat.normal, flat.origin - ray.origin) / closing + 0.0;
  if (!(t >= ray.nearest && t <= ray.farthest)) return;
  const Vec p = ray.at(t) - flat.origin;
  const double u = dot(flat.to_u, p), v = dot(flat.to_v, p);
  if (!(flat.is_ellipse ? u * u + v * v <= 1 : u >= 0 && u <= 1 && v >= 0 && v <= 1)) return;
  const Hit hit{t, self, primitive, u, v};
  if (precedes(hit, first)) first = hit;
}

std::uint32_t Plates::meet_packet(std::uint32_t self, std::uint32_t primitive, std::uint32_t lanes, Packet& packet) const {
  return meet_plate(flats_[primitive], self, primitive, lanes, packet);
}

Vec Plates::normal(const Ray&, const Hit& hit) const { return flats_[hit.part].normal; }

}  // namespace rainref::compositor
