// Known noise, cells and water, and single pixels of the window for the tests of this room.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/error_of.h"
#include "image/texture.h"
#include "rainref/executor.h"
#include "rainref/screen_drops.h"
#include "screen_drops/cells.h"
#include "screen_drops/flow_support.h"
#include "screen_drops/host.h"
#include "screen_drops/background.pass.h"
#include "screen_drops/drops.pass.h"
#include "screen_drops/scalar.h"
#include "settings.h"

namespace rainref::screen_drops::test {

using Single = scalar::Scalar<float>;
using Double = scalar::Scalar<double>;

inline const parallel::Executor& executor() {
  static const parallel::Executor one(1);
  return one;
}

inline Settings settings(Variant variant, int width, int height) {
  Settings s = rainref::test::screen_drops_settings();
  s.variant = variant;
  s.width = width;
  s.height = height;
  s.seed = 3;
  s.grid = 0.06;
  s.keep = 0.15;
  s.noise_size = 16;
  s.pane_height = 0.02;
  s.shortest_cycle = 0.2;
  s.longest_cycle = 3;
  s.scene_margin = 1.7;
  return s;
}

/// A scene that tells every texel from its neighbours.
inline Inputs inputs(const Settings& s) {
  Inputs in;
  in.colour = Image(Format::rgba32f, s.width, s.height);
  for (int y = 0; y < s.height; ++y) {
    for (int i = 0; i < 4 * s.width; ++i) in.colour.row<float>(y)[i] = 0.05f * static_cast<float>(1 + (7 * i + 13 * y) % 17);
  }
  return in;
}

/// Red is u, green is v; one level, or as many as it has.
inline TextureData ramp(int side) {
  std::vector<float> texels;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x)
      texels.insert(texels.end(), {(static_cast<float>(x) + 0.5f) / static_cast<float>(side),
                                   (static_cast<float>(y) + 0.5f) / static_cast<float>(side), 0, 1});
  }
  return {texels, 4, side, side, Address::clamp, Address::clamp};
}

/// The published drops of a picture over noise of one value everywhere: r, g, b.
class Published {
 public:
  PublishedDropsUniforms u{};
  TextureData noise;
  Published(int width, int height, double grid, std::array<float, 3> rgb)
      : noise(std::vector<float>{rgb[0], rgb[1], rgb[2], 1}, 4, 1, 1, Address::repeat, Address::repeat) {
    Settings s = settings(Variant::as_published, width, height);
    s.grid = grid;
    s.keep = 0.13;  // noise of .5 keeps layer 1 alone
    u = published_drops_uniforms(s, 0);
  }
  scalar::PublishedDrop<Double> at(int x, int y) const { return scalar::published_drop<Double>(u, noise.view(), x, y); }
  bool wet(int x, int y) const { return at(x, y).layer.v > 0; }
};

/// All of the buffer of cells, drawn afresh.
inline void fill_cells(const CellsUniforms& u, Image& cells) {
  std::vector<DrawnCell> drawn(static_cast<std::size_t>(cells.width()) * static_cast<std::size_t>(cells.height()));
  cells_rows(u, drawn, cells, 0, cells.height());
}

/// One pixel of the corrected window, in double: a picture of odd size whose middle pixel looks straight ahead, before a ramp.
struct Pixel {
  static constexpr int side = 2001, middle = side / 2;
  Settings s = rainref::test::screen_drops_settings();
  DropsUniforms u{};
  TextureData scene = ramp(64), cells, height{std::vector<float>{0}, 1, 1, 1, Address::clamp, Address::clamp};
  scalar::Vec3<Double> background{Double(0.25f), Double(0.5f), Double(0.75f)};

  /// A pane of 1 mm a pixel, without drops.
  Pixel() : s(settings(Variant::corrected, side, side)) {
    s.pane_height = side * 1e-3;
    s.largest_radius = 400;  // cells of 1000 mm
    const auto grids = make_layers(s);
    u = drops_uniforms(s, grids, {0, 0});
    for (int l = 0; l < layers; ++l) {
      u.level[l] = 0;
      u.offset_x[l] = u.offset_y[l] = 0.5f;  // the middle pixel near the middle of a cell
    }
    const auto size = cells_size(grids);
    cells = TextureData(std::vector<float>(static_cast<std::size_t>(size[0] * size[1]) * 4), 4, size[0], size[1], Address::clamp,
                        Address::clamp);
  }
  /// A drop of this base radius [mm] whose centre lies dx, dy to the right of and above the middle pixel.
  void put_drop(double radius, double dx, double dy, int layer = 0) {
    const double per = 1.0 / 1000 * (1 << layer);
    const double qx = (middle + 0.5 + dx) * per + u.offset_x[layer], qy = (middle + 0.5 + dy) * per + u.offset_y[layer];
    float* texel = cells.texels() + 4 * ((static_cast<int>(qy) + u.first_row[layer]) * cells.view().width[0] + static_cast<int>(qx));
    texel[0] = static_cast<float>(qx - std::floor(qx));
    texel[1] = static_cast<float>(qy - std::floor(qy));
    texel[2] = static_cast<float>(radius * per);
  }
  scalar::Window<Double> at(int x, int y) const {
    return scalar::drops_corrected<Double>(u, scene.view(), cells.view(), height.view(), background, x, y);
  }
  /// Angle by which the ray of the middle pixel is bent to the right [rad]. The scene has no blue: what there is, the surface mirrors.
  double bent() const {
    const auto c = at(middle, middle).colour;
    const double mirrored = c.z.v / (u.inner * 0.75), red = (c.x.v - u.inner * 0.25 * mirrored) / (1 - mirrored);
    return std::atan((red - 0.5) / u.scene_scale[0]);
  }
};

}  // namespace rainref::screen_drops::test
