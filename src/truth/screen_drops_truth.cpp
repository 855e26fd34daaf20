#include "truth/screen_drops_truth.h"

#include <atomic>

#include "compositor/straight_path.h"
#include "screen_drops/shown.h"

namespace rainref::truth {

Comparison compare(const screen_drops::ScreenDrops& rendered, const ScreenDropsView& view, const PictureOptions& options,
                   const parallel::Executor& executor) {
  const int width = view.width(), height = view.height();
  const std::unique_ptr<Scene> scene = view.scene(rendered);
  const Picture traced = trace_picture(*scene, view.camera(), width, height, options, executor);
  const Image shown = view.display(traced.beauty, executor);
  const screen_drops::ShownDrops pass(view.settings(), rendered);
  const PrimaryRays primary(view.camera(), width, height);
  const scene::Camera::Basis basis = view.camera().basis();

  Comparison truth;
  truth.differences = {{"refraction", "deg", width, height},
                       {"colour", "", width, height},
                       {"colour_dry", "", width, height},
                       {"display", "code", width, height}};
  Difference &refraction = truth.differences[0], &colour = truth.differences[1], &colour_dry = truth.differences[2],
             &codes = truth.differences[3];
  std::atomic<std::size_t> drops = 0, wets = 0, both = 0, mirrored = 0, mirrored_in_pass = 0;
  executor.for_tiles(width, height, width, 8, [&](const parallel::Tile& tile) {
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        codes.at(x, y) = pixel_difference<Unorm8>(rendered.picture(), shown, x, y);
        const screen_drops::Shown pixel = pass.at(x, y);
        const StraightPath path = straight_path(*scene, primary.through(x + 0.5, y + 0.5));
        const bool is_drop = pixel.cover >= 0.5, is_mirrored = path.end == StraightPath::End::mirrored,
                   is_wet = is_mirrored || path.interfaces > 2;
        drops += is_drop;
        wets += is_wet;
        if (is_drop != is_wet) continue;
        (is_drop ? colour : colour_dry).at(x, y) = pixel_difference<Half>(rendered.colour(), traced.beauty, x, y);
        if (!is_drop) continue;
        ++both;
        mirrored += is_mirrored;
        mirrored_in_pass += pixel.reflected >= 1;
        if (path.end != StraightPath::End::out || pixel.reflected >= 1) continue;
        refraction.at(x, y) =
            degrees_between(pixel.bent.x * basis.right + pixel.bent.y * basis.up + pixel.bent.z * basis.forward, path.direction);
      }
    }
  });
  truth.pixels = {{"pixels", static_cast<std::size_t>(width) * height},
                  {"drop_pixels", drops},
                  {"wet_pixels", wets},
                  {"drop_not_wet", drops - both},
                  {"wet_not_drop", wets - both},
                  {"mirrored_pixels", mirrored},
                  {"mirrored_in_pass", mirrored_in_pass}};
  return truth;
}

}  // namespace rainref::truth
