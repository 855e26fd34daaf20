// A frame of a pane as its passes render it, and as rays do.
#pragma once

#include <memory>

#include "compositor/straight_path.h"
#include "pass/display.h"
#include "rainref/executor.h"
#include "truth/pixels.h"

namespace rainref::truth {

/// The display picture of a radiance (rgba16f). rgba8.
inline Image display_of(double exposure, Rounding rounding, const Image& radiance, const parallel::Executor& executor) {
  Image picture(Format::rgba8, radiance.width(), radiance.height());
  pass::display_run(exposure, rounding, radiance, picture).tiles(executor, 8);
  return picture;
}

/// Common inputs of the comparisons of all panes. View: see PaneTracing; `running` has rendered a frame.
template <class Running, class View>
struct PaneTruth {
  const Running& running;
  const parallel::Executor& executor;
  int width, height;
  std::unique_ptr<Scene> surfaces;
  Picture traced;
  Image shown;  ///< the traced picture, displayed
  PrimaryRays primary;
  scene::Camera::Basis basis;

  PaneTruth(const Running& r, const View& view, const PictureOptions& options, const parallel::Executor& e)
      : running(r),
        executor(e),
        width(view.width()),
        height(view.height()),
        surfaces(view.scene(r)),
        traced(trace_picture(*surfaces, view.camera(), width, height, options, e)),
        shown(view.display(traced.beauty, e)),
        primary(view.camera(), width, height),
        basis(view.camera().basis()) {}

  Difference difference(const char* name, const char* unit) const { return {name, unit, width, height}; }
  /// Calls body(x, y) for every pixel, from several threads.
  template <class Body>
  void each_pixel(const Body& body) const {
    executor.for_tiles(width, height, width, 8, [&](const parallel::Tile& tile) {
      for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) body(x, y);
    });
  }
  double colour_at(int x, int y) const { return pixel_difference<Half>(running.colour(), traced.beauty, x, y); }
  double codes_at(int x, int y) const { return pixel_difference<Unorm8>(running.picture(), shown, x, y); }
  Ray ray(int x, int y) const { return primary.through(x + 0.5, y + 0.5); }
  StraightPath path(int x, int y) const { return straight_path(*surfaces, ray(x, y)); }
};

}  // namespace rainref::truth
