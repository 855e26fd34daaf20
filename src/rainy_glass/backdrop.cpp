#include "rainy_glass/backdrop.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "cache/kept_images.h"
#include "image/flipped.h"
#include "parallel/rows.h"
#include "rainy_glass/host.h"
#include "scene/panorama_view.h"

namespace rainref::rainy_glass {
namespace {

using scene::Vector3;

/// Glazing bars before a pane: dark round profiles, lit a little from the left, at the pane's u = k spacing + spacing / 2.
void add_bars(const Settings& s, const BackdropOptions& o, Surroundings& around, const Rows& rows) {
  if (s.shape != Shape::pane || !(o.bar_spacing > 0)) return;
  Image surface, orientation;
  make_surface(s, {}, surface, orientation, rows);
  const auto place = [&](float u) {
    const double cell = u / o.bar_spacing;
    return (cell - std::floor(cell) - 0.5) * o.bar_spacing / o.bar_width;  // a bar from -1/2 to 1/2
  };
  rows(s.height, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const float* glass = surface.row<float>(y);
      for (int x = 0; x < s.width; ++x, glass += 4) {
        if (!(glass[2] > 0)) continue;
        const double pixel = std::abs(static_cast<double>(surface.row<float>(y)[4 * std::min(x + 1, s.width - 1)]) -
                                      surface.row<float>(y)[4 * std::max(x - 1, 0)]) /
                             2 / o.bar_width;
        const double at = place(glass[0]);
        const double cover = std::clamp((0.5 - std::abs(at)) / std::max(pixel, 1e-9) + 0.5, 0.0, 1.0);
        if (cover <= 0) continue;
        const double round = std::clamp(2 * at, -1.0, 1.0), lit = 0.012 + 0.03 * std::max(0.0, 0.6 * round + 0.5 * (1 - round * round));
        float* c = around.colour.row<float>(y) + 4 * x;
        const double tint[3] = {1, 0.95, 0.85};
        for (int k = 0; k < 3; ++k) c[k] = static_cast<float>(c[k] * (1 - cover) + tint[k] * lit * cover);
        if (cover >= 0.5) around.depth.row<float>(y)[x] = 0.98f * glass[2];
      }
    }
  });
}

}  // namespace

Image defocused(const Image& image, double radius, const parallel::Executor& executor) {
  const int width = image.width(), height = image.height(), reach = static_cast<int>(radius);
  // Half the width of the disc in each of its rows.
  std::vector<int> half(static_cast<std::size_t>(reach) + 1);
  double texels = 0;
  for (int j = 0; j <= reach; ++j) {
    int i = 0;
    while ((i + 1.0) * (i + 1.0) + static_cast<double>(j) * j <= radius * radius) ++i;
    half[static_cast<std::size_t>(j)] = i;
    texels += (j == 0 ? 1.0 : 2.0) * (2 * i + 1);
  }
  Image out(Format::rgba32f, width, height);
  executor.for_tiles(width, height, width, 8, [&](const parallel::Tile& tile) {
    std::vector<double> sum(static_cast<std::size_t>(width) * 3), before(static_cast<std::size_t>(width + 2 * reach + 1) * 3);
    for (int y = tile.y0; y < tile.y1; ++y) {
      std::fill(sum.begin(), sum.end(), 0.0);
      for (int j = -reach; j <= reach; ++j) {
        const float* row = image.row<float>(std::clamp(y + j, 0, height - 1));
        for (int i = 0; i < width + 2 * reach; ++i) {
          const float* texel = row + 4 * std::clamp(i - reach, 0, width - 1);
          for (int k = 0; k < 3; ++k)
            before[static_cast<std::size_t>(3 * (i + 1) + k)] = before[static_cast<std::size_t>(3 * i + k)] + texel[k];
        }
        const int w = half[static_cast<std::size_t>(std::abs(j))];
        for (int x = 0; x < width; ++x) {
          for (int k = 0; k < 3; ++k)
            sum[static_cast<std::size_t>(3 * x + k)] +=
                before[static_cast<std::size_t>(3 * (x + reach + w + 1) + k)] - before[static_cast<std::size_t>(3 * (x + reach - w) + k)];
        }
      }
      float* to = out.row<float>(y);
      for (int x = 0; x < width; ++x) {
        for (int k = 0; k < 3; ++k) to[4 * x + k] = static_cast<float>(std::max(sum[static_cast<std::size_t>(3 * x + k)] / texels, 0.0));
        to[4 * x + 3] = 1;
      }
    }
  });
  return out;
}

Surroundings make_backdrop(const Settings& s, const BackdropOptions& options, const scene::Scenery& street,
                           const parallel::Executor& executor) {
  const double radius = options.defocus * s.height;
  const scene::Camera eye = camera(s);
  cache::Recipe recipe(fmt::format("rainy_glass {}", street.name()));
  recipe.add(s.seed).add(static_cast<std::uint64_t>(s.width)).add(static_cast<std::uint64_t>(s.height));
  for (const Vector3& v : {eye.position, eye.target, eye.up}) recipe.add({v.x, v.y, v.z});
  recipe.add({eye.vertical_fov_deg, radius});
  // Both at once: in focus the street is needed no more.
  std::vector<Image> kept = cache::images(recipe, {{Format::rgba32f, s.width, s.height}, {Format::r32f, s.width, s.height}}, [&] {
    scene::Scenery::View view = street.view(eye, s.width, s.height, backdrop_far, executor);
    std::vector<Image> both;
    both.push_back(defocused(view.colour, radius, executor));
    both.push_back(std::move(view.depth));
    return both;
  });
  Surroundings around;
  around.colour = std::move(kept[0]);
  around.depth = std::move(kept[1]);
  if (s.use_probe) around.probe = street.panorama(1024, 512, eye.position, executor);
  add_bars(s, options, around, parallel::rows_of(executor));
  return around;
}

Surroundings make_backdrop(const Settings& s, const BackdropOptions& options, const Image& panorama, const parallel::Executor& executor) {
  const double radius = options.defocus * s.height;
  Surroundings around;
  around.colour = scene::panorama_view(panorama, camera(s), s.width, s.height, executor);
  around.depth = Image(Format::r32f, s.width, s.height);
  for (int y = 0; y < s.height; ++y) std::fill_n(around.depth.row<float>(y), s.width, static_cast<float>(backdrop_far));
  if (s.use_probe) around.probe = copy_of(panorama);
  around.colour = cache::image(cache::Recipe("rainy_glass defocused").add({radius}).add(around.colour),
                               {Format::rgba32f, around.colour.width(), around.colour.height()},
                               [&] { return defocused(around.colour, radius, executor); });
  add_bars(s, options, around, parallel::rows_of(executor));
  return around;
}

}  // namespace rainref::rainy_glass
