#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cache/kept_images.h"
#include "night_street/antialias.h"
#include "night_street/city.h"
#include "parallel/rows.h"
#include "rainref/error.h"

namespace rainref::night_street {

Street::View Street::view(const scene::Camera& camera, int width, int height, double far, const parallel::Executor& executor,
                          Parts parts) const {
  if (!(far > 0 && far < 1e300)) throw Error(ExitCode::usage, fmt::format("far: expected a positive distance in metres, found {}", far));
  if (parts != Parts::nine) return rendered(camera, width, height, far, executor, parts);
  struct Work {
    const Street& street;
    const parallel::Executor& executor;
  };
  constexpr auto make = [](const Work& by, const std::string&, const scene::Camera& eye, const int& columns, const int& rows,
                           const double& most) {
    View view = by.street.rendered(eye, columns, rows, most, by.executor, Parts::nine);
    std::vector<Image> both;
    for (Image* image : {&view.colour, &view.depth}) both.push_back(std::move(*image));
    return both;
  };
  std::vector<Image> images =
      cache::kept("night_street view", {{Format::rgba32f, width, height}, {Format::r32f, width, height}}, parallel::rows_of(executor),
                  Work{*this, executor}, +make, identity(), camera, width, height, far);
  return {std::move(images[0]), std::move(images[1])};
}

Street::View Street::rendered(const scene::Camera& camera, int width, int height, double far, const parallel::Executor& executor,
                              Parts parts) const {
  city_->light_up(parallel::rows_of(executor));
  const scene::Camera::Basis basis = camera.basis();
  const Vec origin = from(camera.position), right = from(basis.right), up = from(basis.up), forward = from(basis.forward);
  const double half_height = camera.half_height(), half_width = half_height * width / height;
  const auto ray_of = [&](int i, int j) {
    const double x = half_width * ((2 * i + 1) / (3.0 * width) - 1), y = half_height * ((2 * j + 1) / (3.0 * height) - 1);
    return Ray(origin, unit(forward + x * right + y * up));
  };
  View result;
  result.depth = Image(Format::r32f, width, height);
  const auto at_centre = [&](int x, int y, const Ray& ray, const Seen& seen) {
    const double depth = seen.hit.t * dot(ray.direction, forward);
    const bool is_near = seen.hit.is_surface() && depth < far;
    result.depth.row<float>(y)[x] = static_cast<float>(is_near ? depth : far);
  };
  result.colour = antialiased(*city_, width, height, Edge::clamp, parts, ray_of, at_centre, executor);
  return result;
}

}  // namespace rainref::night_street
