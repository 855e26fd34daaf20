#include "rainy_glass/backdrop.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "cache/kept_images.h"
#include "cache/prepared.h"
#include "image/flipped.h"
#include "parallel/rows.h"
#include "rainy_glass/host.h"
#include "scene/panorama_view.h"

namespace rainref::rainy_glass {
namespace {

using scene::Vector3;

struct Seen {
  Image colour, depth;
  std::size_t bytes() const { return cache::bytes_of(colour) + cache::bytes_of(depth); }
};

/// Glazing bars before a pane: dark round profiles, lit a little from the left, at the pane's u = k spacing + spacing / 2.
using BarReads = cache::Only<&BackdropOptions::bar_spacing, &BackdropOptions::bar_width>;
Seen with_bars(const Rows& rows, const Image& colour, const Image& depth, const GlassReads& glass_reads, const BarReads& bars) {
  const Settings& s = glass_reads.of;
  const BackdropOptions& o = bars.of;
  Seen around{copy_of(colour), copy_of(depth)};
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
  for (Image* image : {&around.colour, &around.depth}) image->share();
  return around;
}
void add_bars(const Settings& s, const BackdropOptions& o, Surroundings& around, const Rows& rows) {
  if (s.shape != Shape::pane || !(o.bar_spacing > 0)) return;
  const auto seen = cache::prepared("rainy_glass bars", rows, with_bars, around.colour, around.depth, s, o);
  around.colour = seen->colour.shared();
  around.depth = seen->depth.shared();
}

struct Work {
  const scene::Scenery* street;
  const parallel::Executor& executor;
};
/// The street out of focus, and its depth; the sharp picture is not kept.
std::vector<Image> out_of_focus(const Work& by, const std::string&, const scene::Camera& eye, const int& width, const int& height,
                                const double& radius) {
  scene::Scenery::View view = by.street->view(eye, width, height, backdrop_far, by.executor);
  std::vector<Image> both;
  both.push_back(defocused(view.colour, radius, by.executor));
  both.push_back(std::move(view.depth));
  return both;
}
Image panorama_out_of_focus(const Work& by, const Image& panorama, const scene::Camera& eye, const int& width, const int& height,
                            const double& radius) {
  return defocused(scene::panorama_view(panorama, eye, width, height, by.executor), radius, by.executor);
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
  const std::vector<cache::Shape> shapes{{Format::rgba32f, s.width, s.height}, {Format::r32f, s.width, s.height}};
  const Rows rows = parallel::rows_of(executor);
  std::vector<Image> kept = cache::kept("rainy_glass street", shapes, rows, Work{&street, executor}, out_of_focus, street.identity(), eye,
                                        s.width, s.height, radius);
  Surroundings around;
  around.colour = std::move(kept[0]);
  around.depth = std::move(kept[1]);
  if (s.use_probe) around.probe = street.panorama(1024, 512, eye.position, executor);
  add_bars(s, options, around, rows);
  return around;
}

Surroundings make_backdrop(const Settings& s, const BackdropOptions& options, const Image& panorama, const parallel::Executor& executor) {
  const double radius = options.defocus * s.height;
  Surroundings around;
  const Rows rows = parallel::rows_of(executor);
  around.colour = cache::kept("rainy_glass panorama", cache::Shape{Format::rgba32f, s.width, s.height}, rows, Work{nullptr, executor},
                              panorama_out_of_focus, panorama, camera(s), s.width, s.height, radius);
  around.depth = Image(Format::r32f, s.width, s.height);
  for (int y = 0; y < s.height; ++y) std::fill_n(around.depth.row<float>(y), s.width, static_cast<float>(backdrop_far));
  if (s.use_probe) around.probe = panorama.shared();
  add_bars(s, options, around, rows);
  return around;
}

}  // namespace rainref::rainy_glass
