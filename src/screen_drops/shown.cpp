#include "screen_drops/shown.h"

#include <algorithm>
#include <optional>

#include "blur_pyramid/blur_pyramid.h"
#include "parallel/rows.h"
#include "screen_drops/host.h"
#include "pass/run.h"
#include "screen_drops/background.pass.h"
#include "screen_drops/scalar.h"

namespace rainref::screen_drops {

using Number = scalar::Scalar<double>;

double glass_distance(const Settings& settings) { return 0.5 * settings.pane_height / camera(settings).half_height(); }

namespace {

/// The drop of a cell of this layer. A millionth of a cell is less than any rounding in the pass: there is none.
std::optional<Cap> cap_of(const Layer& layer, double cell, const Image& cells, int column, int row) {
  const float* drop = cells.row<float>(layer.first_row + row) + 4 * column;
  if (!(drop[2] > 1e-6f)) return std::nullopt;
  return Cap{(column + double{drop[0]} - layer.offset[0]) * cell, (row + double{drop[1]} - layer.offset[1]) * cell, drop[2] * cell};
}

std::vector<Cap> caps_of(const Settings& settings, const Image& cells, bool with_hidden) {
  const double pixel = settings.pane_height / settings.height;
  const auto all = make_layers(settings);
  const auto is_hidden = [&](const Cap& cap, const Layer& coarser) {
    // A drop reaches into no other cell of its layer.
    const double cell = pixel / coarser.cells_per_pixel, x = cap.x / cell + coarser.offset[0], y = cap.y / cell + coarser.offset[1];
    if (!(x >= 0 && x < coarser.columns && y >= 0 && y < coarser.rows)) return false;
    const std::optional<Cap> over = cap_of(coarser, cell, cells, static_cast<int>(x), static_cast<int>(y));
    const double room = over ? over->radius - cap.radius : -1;
    return room >= 0 && (over->x - cap.x) * (over->x - cap.x) + (over->y - cap.y) * (over->y - cap.y) <= room * room;
  };
  std::vector<Cap> found;
  for (std::size_t l = 0; l < all.size(); ++l) {
    for (int row = 0; row < all[l].rows; ++row) {
      for (int column = 0; column < all[l].columns; ++column) {
        const std::optional<Cap> cap = cap_of(all[l], pixel / all[l].cells_per_pixel, cells, column, row);
        if (!cap) continue;
        const auto end = all.begin() + static_cast<std::ptrdiff_t>(with_hidden ? 0 : l);
        if (std::none_of(all.begin(), end, [&](const Layer& coarser) { return is_hidden(*cap, coarser); })) found.push_back(*cap);
      }
    }
  }
  return found;
}

}  // namespace

std::vector<Cap> caps(const Settings& settings, const Image& cells) { return caps_of(settings, cells, true); }
std::vector<Cap> shown_caps(const Settings& settings, const Image& cells) { return caps_of(settings, cells, false); }

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
