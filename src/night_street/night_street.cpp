#include "night_street/night_street.h"

#include <limits>

#include "base/floating_point.h"
#include "night_street/city.h"
#include "night_street/shade.h"

namespace rainref::night_street {

Street::Street(const Options& options) : options_(options) {
  FloatingPointGuard guard;  // the light map is computed here, outside the tiles that pin the state
  auto city = std::make_unique<City>(options.seed, options.clear_lane);
  lamps_ = city->lamps;
  city_ = std::move(city);
}

Street::~Street() = default;
Street::Street(Street&&) noexcept = default;
Street& Street::operator=(Street&&) noexcept = default;

const std::vector<Lamp>& Street::lamps() const { return lamps_; }

scene::Vector3 Street::radiance(const scene::Vector3& origin, const scene::Vector3& direction) const {
  return night_street::look(*city_, Ray(from(origin), unit(direction))).radiance;
}

Street::Sight Street::look(const scene::Vector3& origin, const scene::Vector3& direction) const {
  const Seen seen = night_street::look(*city_, Ray(origin, direction));
  return {seen.radiance, seen.hit.is_surface() ? seen.hit.t : std::numeric_limits<double>::infinity()};
}

}  // namespace rainref::night_street
