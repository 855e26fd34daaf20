#include "truth/rainy_glass_truth.h"

#include <atomic>

#include "compositor/straight_path.h"

namespace rainref::truth {

Comparison compare(const rainy_glass::RainyGlass& rendered, const RainyGlassView& view, const PictureOptions& options,
                   const parallel::Executor& executor) {
  const int width = view.width(), height = view.height();
  const std::unique_ptr<Scene> scene = view.scene(rendered);
  const Picture traced = trace_picture(*scene, view.camera(), width, height, options, executor);
  const Image shown = view.display(traced.beauty, executor);
  const rainy_glass::ShownGlass pass(view.settings(), view.surroundings(), rendered);
  const PrimaryRays primary(view.camera(), width, height);
  const scene::Camera::Basis basis = view.camera().basis();

  Comparison truth;
  truth.differences = {{"refraction", "deg", width, height},
                       {"bend", "deg", width, height},
                       {"colour", "", width, height},
                       {"colour_dry", "", width, height},
                       {"display", "code", width, height}};
  Difference &refraction = truth.differences[0], &bend = truth.differences[1], &colour = truth.differences[2],
             &colour_dry = truth.differences[3], &codes = truth.differences[4];
  std::atomic<std::size_t> glass = 0, wet = 0, pass_only = 0, truth_only = 0, mirrored = 0;
  executor.for_tiles(width, height, width, 8, [&](const parallel::Tile& tile) {
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        const rainy_glass::Shown pixel = pass.at(x, y);
        if (!pixel.is_behind) continue;
        ++glass;
        codes.at(x, y) = pixel_difference<Unorm8>(rendered.picture(), shown, x, y);
        const Ray ray = primary.through(x + 0.5, y + 0.5);
        const StraightPath path = straight_path(*scene, ray);
        const bool is_mirrored = path.end == StraightPath::End::mirrored, is_wet = is_mirrored || path.interfaces > 2;
        pass_only += pixel.is_wet && !is_wet;
        truth_only += is_wet && !pixel.is_wet;
        if (is_wet != pixel.is_wet) continue;
        (is_wet ? colour : colour_dry).at(x, y) = pixel_difference<Half>(rendered.colour(), traced.beauty, x, y);
        if (!is_wet) continue;
        ++wet;
        mirrored += is_mirrored;
        if (path.end != StraightPath::End::out) continue;
        const Vec from_pass = basis.forward + pixel.x * basis.right + pixel.y * basis.up,
                  from_truth = view.met(path.origin, path.direction).from_eye;
        refraction.at(x, y) = degrees_between(from_pass, from_truth);
        bend.at(x, y) = degrees_between(ray.direction, from_pass) - degrees_between(ray.direction, from_truth);
      }
    }
  });
  truth.pixels = {{"pixels", static_cast<std::size_t>(width) * height},
                  {"glass_pixels", glass},
                  {"wet_pixels", wet},
                  {"wet_in_pass_only", pass_only},
                  {"wet_in_truth_only", truth_only},
                  {"mirrored_pixels", mirrored}};
  return truth;
}

}  // namespace rainref::truth
