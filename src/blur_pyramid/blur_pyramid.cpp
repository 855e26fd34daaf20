#include "blur_pyramid/blur_pyramid.h"

#include <span>

#include "math/half_array.h"
#include "pass/info.h"
#include "rainref/error.h"

namespace rainref::blur_pyramid {

std::array<int, 2> level_size(int width, int height, int level) { return {std::max(1, width >> level), std::max(1, height >> level)}; }
int level_count(int width, int height) {
  int count = 1;
  while (std::max(width, height) >> count != 0) ++count;
  return count;
}

BlurUniforms blur_uniforms(const BlurSettings& s, int width, int height, int level) {
  BlurUniforms u{};
  for (int k = 0; k < 3; ++k) u.fog_colour[k] = static_cast<float>(s.fog_colour[static_cast<std::size_t>(k)]);
  u.fog_density = static_cast<float>(s.fog_density);
  u.level = level;
  const std::array<int, 2> above = level_size(width, height, std::max(0, level - 1)), here = level_size(width, height, level);
  for (std::size_t k = 0; k < 2; ++k) {
    const int n = above[k], m = here[k];
    u.source_size[k] = n;
    // A side of one texel is not halved.
    u.middle[k] = static_cast<float>(n == 1 ? 0.0 : static_cast<double>(m) / n);
    u.last[k] = static_cast<float>(n % 2 == 0 || n == 1 ? 0.0 : 1.0 / n);
  }
  return u;
}

std::vector<Image> make_levels(const BlurSettings& s, int width, int height) {
  std::vector<Image> levels;
  for (int l = 0; l < std::min(s.levels, level_count(width, height)); ++l) {
    const auto [columns, rows] = level_size(width, height, l);
    levels.emplace_back(Format::rgba16f, columns, rows);
  }
  return levels;
}

pass::Run<FogPass> fog_run(const BlurUniforms& uniforms, Rounding rounding, const Image& colour, const Image& depth, Image& out) {
  pass::HostIo<FogPass> io;
  io.scene_colour = colour;
  io.scene_depth = depth;
  io.blurred = out;
  return pass::Run<FogPass>(uniforms, true, rounding, io);
}
pass::Run<HalvePass> halve_run(const BlurUniforms& uniforms, bool corrected, Rounding rounding, const Image& above, Image& out) {
  if (above.width() != uniforms.source_size[0] || above.height() != uniforms.source_size[1] ||
      level_size(above.width(), above.height(), 1) != std::array<int, 2>{out.width(), out.height()})
    throw Error(ExitCode::internal, "blur_pyramid: the levels do not fit");
  pass::HostIo<HalvePass> io;
  io.above = above;
  if (corrected) io.above.address = Address::mirror;
  io.blurred = out;
  return pass::Run<HalvePass>(uniforms, corrected, rounding, io);
}

LevelTexture::LevelTexture(const std::vector<Image>& levels) {
  std::size_t count = 0;
  view_.channels = 4;
  view_.levels = static_cast<int>(levels.size());
  for (std::size_t l = 0; l < levels.size(); ++l) {
    view_.width[l] = view_.pitch[l] = levels[l].width();
    view_.height[l] = levels[l].height();
    view_.offset[l] = static_cast<std::int32_t>(count);
    count += static_cast<std::size_t>(levels[l].width()) * levels[l].height();
  }
  if (count > 0x7fffffffu / 8) throw Error(ExitCode::usage, "the blurred scene has more texels than a texture may have");
  texels_.resize(4 * count + 4);
  view_.texels = texels_.data();
}
void LevelTexture::refresh(const parallel::Executor& executor, const std::vector<Image>& levels) {
  struct Row {
    std::size_t level;
    int y;
  };
  std::vector<Row> rows;
  for (std::size_t l = 0; l < levels.size(); ++l)
    for (int y = 0; y < levels[l].height(); ++y) rows.push_back({l, y});
  executor.for_range(static_cast<std::int64_t>(rows.size()), 8, [&](std::int64_t begin, std::int64_t end) {
    for (const Row& row : std::span(rows).subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin))) {
      const auto width = static_cast<std::size_t>(levels[row.level].width());
      const std::size_t first = static_cast<std::size_t>(view_.offset[row.level]) + width * static_cast<std::size_t>(row.y);
      std::copy_n(levels[row.level].row<Half>(row.y), 4 * width, texels_.data() + 4 * first);
    }
  });
}

capture::PassInfo blur_info(const std::string& colour_from, const std::string& depth_from) {
  capture::PassInfo info = pass::info_of<FogPass>();
  const capture::PassInfo further = pass::info_of<HalvePass>();
  info.reads[0].from = colour_from;
  info.reads[1].from = depth_from;
  info.reads.push_back(further.reads.front());
  info.order_free_sums = further.order_free_sums;
  return info;
}
std::vector<capture::BufferInfo> blur_buffers() {
  return {
      {.name = "scene_colour",
       .format = "rgba16f",
       .sentence = "Opaque scene without fog: linear radiance.",
       .colour_space = "linear Rec. 709",
       .alpha = "unused"},
      {.name = "scene_depth", .format = "r32f", .sentence = "Distance of the scene along the view axis.", .unit = "m", .range = {0, 1000}},
      pass::buffers_of<HalvePass>().front()};
}

}  // namespace rainref::blur_pyramid
