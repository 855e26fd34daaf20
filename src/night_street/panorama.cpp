#include <utility>
#include <vector>

#include "cache/kept_images.h"
#include "math/constants.h"
#include "math/real64.h"
#include "night_street/antialias.h"
#include "night_street/city.h"
#include "parallel/rows.h"

namespace rainref::night_street {

namespace {

/// Sine and cosine of `count` angles: the centres of equal parts of [first, first + span].
struct Angles {
  std::vector<double> sine, cosine;
  Angles(int count, double first, double span) {
    for (int i = 0; i < count; ++i) {
      const Real64 angle{first + span * (i + 0.5) / count};
      sine.push_back(sin_real(angle).v);
      cosine.push_back(cos_real(angle).v);
    }
  }
};

}  // namespace

Image Street::panorama(int width, int height, const scene::Vector3& eye, const parallel::Executor& executor) const {
  struct Work {
    const Street& street;
    const parallel::Executor& executor;
  };
  constexpr auto make = [](const Work& by, const std::string&, const int& columns, const int& rows, const scene::Vector3& from) {
    return by.street.traced(columns, rows, from, by.executor);
  };
  return cache::kept("night_street panorama", cache::Shape{Format::rgba32f, width, height}, parallel::rows_of(executor),
                     Work{*this, executor}, +make, identity(), width, height, eye);
}

Image Street::traced(int width, int height, const scene::Vector3& eye, const parallel::Executor& executor) const {
  city_->light_up(parallel::rows_of(executor));
  const Vec origin = from(eye);
  const Angles azimuth(3 * width, -pi, 2 * pi), elevation(3 * height, -0.5 * pi, pi);
  const auto ray_of = [&](int i, int j) {
    const auto a = static_cast<std::size_t>(i), e = static_cast<std::size_t>(j);
    const Vec direction{elevation.cosine[e] * azimuth.cosine[a], elevation.sine[e], elevation.cosine[e] * azimuth.sine[a]};
    return Ray(origin, unit(direction));
  };
  return antialiased(
      *city_, width, height, Edge::wrap, Parts::nine, ray_of, [](int, int, const Ray&, const Seen&) {}, executor);
}

}  // namespace rainref::night_street
