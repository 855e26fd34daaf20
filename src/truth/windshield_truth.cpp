#include "truth/windshield_truth.h"

#include <atomic>
#include <cmath>

#include "compositor/straight_path.h"
#include "truth/pixels.h"
#include "pass/display.h"
#include "windshield/shown.h"
#include "windshield/scene/street.h"

namespace rainref::truth {
Image display(const windshield::Settings& settings, const Image& radiance, const parallel::Executor& executor) {
  Image picture(Format::rgba8, radiance.width(), radiance.height());
  pass::display_run(settings.picture.exposure, settings.surface.rounding, radiance, picture).tiles(executor, 8);
  return picture;
}

WindshieldTruth compare(const windshield::Windshield& rendered, const WindshieldView& view, const PictureOptions& options,
                        const parallel::Executor& executor) {
  const windshield::Settings& settings = view.settings();
  const int width = settings.picture.width, height = settings.picture.height;
  const std::unique_ptr<Scene> scene = view.scene(rendered);
  const scene::Camera camera = view.camera();
  const Picture traced = trace_picture(*scene, camera, width, height, options, executor);
  const Image shown = display(settings, traced.beauty, executor);
  const windshield::ShownScene composite(settings, rendered);
  const PrimaryRays primary(camera, width, height);
  const scene::Camera::Basis basis = camera.basis();
  const double distance = view.distance(rendered);

  WindshieldTruth truth;
  truth.differences = {{"refraction", "deg", width, height},
                       {"refraction_film", "deg", width, height},
                       {"colour", "", width, height},
                       {"colour_film", "", width, height},
                       {"display", "code", width, height}};
  Difference &refraction = truth.differences[0], &refraction_film = truth.differences[1], &colour = truth.differences[2],
             &colour_film = truth.differences[3], &codes = truth.differences[4];
  std::atomic<std::size_t> glass = 0, drops = 0, mirrored = 0;
  executor.for_tiles(width, height, width, 8, [&](const parallel::Tile& tile) {
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        const windshield::Shown pixel = composite.at(x, y);
        if (!pixel.is_on_glass) continue;
        const bool is_drop = pixel.visibility >= 0.5;
        ++glass;
        drops += is_drop;
        double trick[3], real[3];
        read(rendered.colour().row<Half>(y) + 4 * x, trick);
        read(traced.beauty.row<Half>(y) + 4 * x, real);
        (is_drop ? colour : colour_film).at(x, y) = largest_difference(trick, real);
        read(rendered.picture().row<Unorm8>(y) + 4 * x, trick);
        read(shown.row<Unorm8>(y) + 4 * x, real);
        codes.at(x, y) = largest_difference(trick, real);

        const StraightPath path = straight_path(*scene, primary.through(x + 0.5, y + 0.5));
        const bool is_wet = path.interfaces > 2;
        if (is_drop && path.end == StraightPath::End::mirrored) ++mirrored;
        if (path.end != StraightPath::End::out || is_drop != is_wet || (!is_drop && pixel.visibility > 0)) continue;
        const scene::Scenery::Sight seen = view.look(distance, path.origin, path.direction);
        const bool is_sky = std::isinf(seen.distance);
        const Vec from_eye = is_sky ? path.direction : path.origin + seen.distance * path.direction - camera.position;
        const Vec from_trick = basis.forward + pixel.x * basis.right + pixel.y * basis.up;
        (is_drop ? refraction : refraction_film).at(x, y) = degrees_between(from_trick, from_eye);
      }
    }
  });
  truth.glass = glass;
  truth.drops = drops;
  truth.mirrored = mirrored;
  return truth;
}

}  // namespace rainref::truth
