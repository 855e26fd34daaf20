#include "compositor/environments.h"

#include "compositor/shading_kernels.h"
#include "math/real64.h"

namespace rainref::compositor {

Rotation::Rotation(double angle) : cosine(cos_real(Real64(angle)).v), sine(sin_real(Real64(angle)).v) {}

PictureEnvironment::PictureEnvironment(const Texture& texture, bool is_cube, const Rotation& rotation)
    : texture_(&texture), is_cube_(is_cube), rotation_(rotation) {}

void PictureEnvironment::radiance(std::span<const Sight> sights, std::span<Vec> out) const { look_up(*texture_, is_cube_, rotation_, sights, out); }

StreetEnvironment::StreetEnvironment(const night_street::Street& street, const Vec& offset, const Texture& panorama, const Rotation& rotation)
    : street_(&street), offset_(offset), panorama_(panorama, false, Rotation()), rotation_(rotation) {}

namespace {

// A hollow of the scene lies under the street's road, which would hide everything from there.
Vec above_road(const Vec& p) { return {p.x, p.y < 0.001 ? 0.001 : p.y, p.z}; }

}  // namespace

void StreetEnvironment::radiance(std::span<const Sight> sights, std::span<Vec> out) const {
  for (std::size_t i = 0; i < sights.size(); ++i) {
    Sight turned = sights[i];
    turned.direction = rotation_.apply(turned.direction);
    if (turned.blur > 0) panorama_.radiance({&turned, 1}, {&out[i], 1});
    else out[i] = street_->radiance(above_road(rotation_.apply(turned.origin) + offset_), turned.direction);
  }
}

}  // namespace rainref::compositor
