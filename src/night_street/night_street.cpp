#include "night_street/night_street.h"

#include <limits>
#include <string>

#include <fmt/format.h>

#include "base/floating_point.h"
#include "cache/remembered.h"
#include "night_street/city.h"
#include "night_street/shade.h"

namespace rainref::night_street {
namespace {

constexpr std::size_t city_bytes = std::size_t{16} << 20;  // about, light map included

}  // namespace

Street::Street(const Options& options) : options_(options) {
  FloatingPointGuard guard;  // the street is laid out here, outside the tiles that pin the state
  static cache::Remembered<City>& remembered = *new cache::Remembered<City>;
  const std::string name = fmt::format("{} {}", options.seed, options.clear_lane);
  city_ = remembered.find(name);
  if (!city_) {
    city_ = std::make_shared<City>(options.seed, options.clear_lane);
    remembered.keep(name, city_, city_bytes);
  }
  lamps_ = city_->lamps;
}

Street::~Street() = default;
Street::Street(Street&&) noexcept = default;
Street& Street::operator=(Street&&) noexcept = default;

std::shared_ptr<const scene::Scenery> Street::make(const Options& options) { return std::make_shared<const Street>(options); }

Street::Sight Street::look(const scene::Vector3& origin, const scene::Vector3& direction) const {
  const Seen seen = night_street::look(*city_, Ray(origin, direction));
  return {seen.radiance, seen.hit.is_surface() ? seen.hit.t : std::numeric_limits<double>::infinity()};
}

}  // namespace rainref::night_street
