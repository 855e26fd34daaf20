#include "compositor/environments.h"

#include <algorithm>
#include <vector>

#include "compositor/shading_kernels.h"
#include "math/real64.h"

namespace rainref::compositor {

Rotation::Rotation(double angle) : cosine(cos_real(Real64(angle)).v), sine(sin_real(Real64(angle)).v) {}

PictureEnvironment::PictureEnvironment(const Texture& texture, bool is_cube, const Rotation& rotation)
    : texture_(&texture), is_cube_(is_cube), rotation_(rotation) {}

void PictureEnvironment::radiance(const EscapedRays& escaped_rays, std::span<Vec> out) const {
  look_up(*texture_, is_cube_, rotation_, escaped_rays, out);
}

StreetEnvironment::StreetEnvironment(const scene::Scenery& street, const Vec& offset, const Texture& panorama, const Rotation& rotation)
    : street_(&street), offset_(offset), panorama_(panorama, false, Rotation()), rotation_(rotation) {}

namespace {

// A scene's hollow below the street's road would be hidden by the road, so its points are raised above it.
Vec above_road(const Vec& p) { return {p.x, p.y < 0.001 ? 0.001 : p.y, p.z}; }

}  // namespace

void StreetEnvironment::radiance(const EscapedRays& escaped_rays, std::span<Vec> out) const {
  // Memory for the blurred rays, kept by each thread for its next call.
  static thread_local Columns<7> blurred;
  static thread_local std::vector<std::size_t> which;
  static thread_local std::vector<Vec> seen;
  which.clear();
  for (std::size_t i = 0; i < escaped_rays.size(); ++i) {
    const EscapedRay escaped_ray = escaped_rays[i];
    if (escaped_ray.blur > 0) {
      which.push_back(i);
      continue;
    }
    const Vec direction = rotation_.apply(escaped_ray.direction);
    out[i] = street_->look(above_road(rotation_.apply(escaped_ray.origin) + offset_), (1 / length(direction)) * direction).radiance;
  }
  if (which.empty()) return;
  const std::size_t count = which.size(), whole = whole_lanes(count);
  blurred.make_room(whole);
  for (std::size_t k = 0; k < whole; ++k) {
    const EscapedRay escaped_ray = escaped_rays[which[std::min(k, count - 1)]];
    blurred.vectors(0).put(k, escaped_ray.origin);
    blurred.vectors(3).put(k, rotation_.apply(escaped_ray.direction));
    blurred[6][k] = escaped_ray.blur;
  }
  seen.resize(count);
  panorama_.radiance({count, blurred.vectors(0), blurred.vectors(3), blurred[6]}, seen);
  for (std::size_t k = 0; k < count; ++k) out[which[k]] = seen[k];
}

}  // namespace rainref::compositor
