#include "night_street/night_street.h"

#include <limits>
#include <string>

#include <fmt/format.h>

#include "base/floating_point.h"
#include "cache/prepared.h"
#include "night_street/city.h"
#include "night_street/shade.h"

namespace rainref::night_street {
namespace {

struct Laid {
  std::shared_ptr<const City> city;
  std::size_t bytes() const { return std::size_t{16} << 20; }  // approximate, including the light map
};
Laid lay_out(const int&, const std::uint64_t& seed, const bool& clear_lane) { return {std::make_shared<const City>(seed, clear_lane)}; }

}  // namespace

Street::Street(const Options& options) : options_(options) {
  FloatingPointGuard guard;  // the street is built here, outside the tiles, which set the state themselves
  city_ = cache::prepared("street", 0, lay_out, options.seed, options.clear_lane)->city;
  lamps_ = city_->lamps;
}

Street::~Street() = default;
Street::Street(Street&&) noexcept = default;
Street& Street::operator=(Street&&) noexcept = default;

std::string Street::identity() const { return fmt::format("street {} {}", options_.seed, options_.clear_lane); }

std::shared_ptr<const scene::Scenery> Street::make(const Options& options) { return std::make_shared<const Street>(options); }

Street::Sight Street::look(const scene::Vector3& origin, const scene::Vector3& direction) const {
  const Seen seen = night_street::look(*city_, Ray(origin, direction));
  return {seen.radiance, seen.hit.is_surface() ? seen.hit.t : std::numeric_limits<double>::infinity()};
}

}  // namespace rainref::night_street
