#include "screen_drops/shown.h"

#include "blur_pyramid/blur_pyramid.h"
#include "parallel/rows.h"
#include "screen_drops/host.h"
#include "pass/run.h"
#include "screen_drops/background.pass.h"
#include "screen_drops/scalar.h"

namespace rainref::screen_drops {

using Number = scalar::Scalar<double>;

double glass_distance(const Settings& settings) { return 0.5 * settings.pane_height / camera(settings).half_height(); }

std::vector<Cap> caps(const Settings& settings, const Image& cells) {
  const double pixel = settings.pane_height / settings.height;
  std::vector<Cap> all;
  for (const Layer& layer : make_layers(settings)) {
    const double cell = pixel / layer.cells_per_pixel;
    for (int row = 0; row < layer.rows; ++row) {
      const float* drop = cells.row<float>(layer.first_row + row);
      for (int column = 0; column < layer.columns; ++column, drop += 4) {
        // A millionth of a cell is less than any rounding in the pass.
        if (drop[2] > 1e-6f)
          all.push_back(
              {(column + double{drop[0]} - layer.offset[0]) * cell, (row + double{drop[1]} - layer.offset[1]) * cell, drop[2] * cell});
      }
    }
  }
  return all;
}

Image defocused_scene(const Settings& settings, const Image& colour, const parallel::Executor& executor) {
  const std::vector<Image> levels = scene_levels(colour, parallel::rows_of(executor));
  blur_pyramid::LevelTexture scene(levels);
  scene.refresh(executor, levels);
  BackgroundUniforms u = background_uniforms(settings);
  u.scale[0] = static_cast<float>(1.0 / colour.width());
  u.scale[1] = static_cast<float>(1.0 / colour.height());
  u.offset[0] = u.offset[1] = 0;
  const std::vector<Tap> taps = make_taps(settings);
  Image out(Format::rgba16f, colour.width(), colour.height());
  pass::HostIo<BackgroundPass> io;
  io.scene.set(scene.view(), levels);
  io.taps = taps;
  io.background = out;
  pass::Run<BackgroundPass>(u, true, Rounding::rne, io).tiles(executor, 8);
  return out;
}

ShownDrops::ShownDrops(const Settings& settings, const ScreenDrops& rendered)
    : cells_(rendered.cells(), Address::clamp, Address::clamp), height_(rendered.height(), Address::clamp, Address::clamp) {
  const bool has_flow = rendered.height().width() > 1;
  uniforms_ = drops_uniforms(settings, make_layers(settings),
                             has_flow ? std::array{rendered.height().width(), rendered.height().height()} : std::array{0, 0});
}

Shown ShownDrops::at(int column, int row) const {
  const auto s = scalar::water_at<Number>(uniforms_, cells_.view(), height_.view(), column, row);
  const auto ray = scalar::bent_ray(
      uniforms_, scalar::view_ray(uniforms_, Number(static_cast<float>(column) + 0.5f), Number(static_cast<float>(row) + 0.5f)), s.x, s.y);
  return {s.cover.v, {ray.direction.x.v, ray.direction.y.v, ray.direction.z.v}, ray.reflected.v};
}

}  // namespace rainref::screen_drops
