#include "blur_pyramid/blur_pyramid.h"

#include <algorithm>

#include "blur_pyramid/kernels.h"
#include "math/half_array.h"
#include "rainref/error.h"

namespace rainref::blur_pyramid {
namespace {

constexpr int tile_rows = 8;
constexpr const char *published = "as-published", *correct = "corrected";

}  // namespace

std::vector<scene::Parameter> blur_parameters(const std::string& prefix) {
  const auto key = [&](const char* name) { return prefix + "." + name; };
  return {
      scene::integer(key("blur_levels"), "1", 1, Texture::max_levels, 6, "Levels of the blurred scene, the sharp one included."),
      scene::real(key("fog_density"), "1/m", 0, 10, 0.01, "Extinction of light in the air in front of the scene."),
      scene::real3(key("fog_colour"), "1", 0, 1000, {0.02, 0.025, 0.03}, "Linear radiance of the fog."),
  };
}
BlurSettings blur_settings(const scene::Config& config, const std::string& prefix, Rounding rounding) {
  const auto key = [&](const char* name) { return prefix + "." + name; };
  BlurSettings s;
  s.corrected = config.variant() == correct;
  s.rounding = rounding;
  s.levels = static_cast<int>(config.integer(key("blur_levels")));
  s.fog_density = config.real(key("fog_density"));
  s.fog_colour = config.real3(key("fog_colour"));
  return s;
}

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
    // A side of one texel stays as it is.
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

void fog_level(const parallel::Executor& executor, const BlurUniforms& uniforms, Rounding rounding, const Image& colour, const Image& depth,
               Image& out) {
  const auto same = [&](const Image& i, Format format) {
    return i.format() == format && i.width() == out.width() && i.height() == out.height();
  };
  if (!same(colour, Format::rgba16f) || !same(depth, Format::r32f) || !same(out, Format::rgba16f)) {
    throw Error(ExitCode::internal, "blur_pyramid: colour, depth and level 0 do not fit");
  }
  executor.for_tiles(out.width(), out.height(), out.width(), tile_rows,
                     [&](const parallel::Tile& tile) { fog_rows(uniforms, rounding, colour, depth, out, tile); });
}
void halve_level(const parallel::Executor& executor, const BlurUniforms& uniforms, bool corrected, Rounding rounding, const Image& above,
                 Image& out) {
  const bool fits = above.width() == uniforms.source_size[0] && above.height() == uniforms.source_size[1] &&
                    level_size(above.width(), above.height(), 1) == std::array<int, 2>{out.width(), out.height()};
  if (!fits || above.format() != Format::rgba16f || out.format() != Format::rgba16f)
    throw Error(ExitCode::internal, "blur_pyramid: the levels do not fit");
  executor.for_tiles(out.width(), out.height(), out.width(), tile_rows,
                     [&](const parallel::Tile& tile) { halve_rows(uniforms, corrected, rounding, above, out, tile); });
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
  texels_.resize(4 * count + 2);
  view_.texels = texels_.data();
}
void LevelTexture::refresh(const parallel::Executor& executor, const std::vector<Image>& levels) {
  for (std::size_t l = 0; l < levels.size(); ++l) {
    const Image& level = levels[l];
    executor.for_range(level.height(), tile_rows, [&](std::int64_t begin, std::int64_t end) {
      for (std::int64_t y = begin; y < end; ++y) {
        Half* to = texels_.data() +
                   4 * (static_cast<std::size_t>(view_.offset[l]) + static_cast<std::size_t>(level.width()) * static_cast<std::size_t>(y));
        std::copy_n(level.row<Half>(static_cast<int>(y)), static_cast<std::size_t>(4) * level.width(), to);
      }
    });
  }
}

capture::PassInfo blur_info(const std::string& colour_from, const std::string& depth_from) {
  using scene::member;
  const scene::UniformBlock block = scene::uniform_block<BlurUniforms>(
      "BlurUniforms",
      {member<&BlurUniforms::fog_colour>("fog_colour", "1", scene::radiance, "Linear radiance of the fog."),
       member<&BlurUniforms::fog_density>("fog_density", "1/m", {0, 10}, "Extinction of light in the fog."),
       member<&BlurUniforms::middle>("middle", "1", scene::share,
                                     "corrected: weight of the middle one of three texels, for columns and rows."),
       member<&BlurUniforms::last>("last", "1", scene::share, "corrected: weight of the last one, over output index + 1."),
       member<&BlurUniforms::source_size>("source_size", "texel", {1, 65536}, "Columns and rows of the level above."),
       member<&BlurUniforms::level>("level", "1", {0, Texture::max_levels}, "0 fogs the scene, further ones halve the level above.")});
  return {"blur_pyramid",
          "The scene in fog, and blurred levels of it; one run a level.",
          {{published, 1, capture::Judge::envelope, "BlurUniforms"}, {correct, 1, capture::Judge::envelope, "BlurUniforms"}},
          {capture::per_texel({"scene_colour", colour_from}), capture::per_texel({"scene_depth", depth_from}), {"blurred", "blur_pyramid"}},
          {"blurred"},
          {block},
          "gather",
          {"the four texels"}};
}
std::vector<capture::BufferInfo> blur_buffers() {
  return {{"scene_colour", "rgba16f", "Opaque scene without fog: linear radiance.", "1", {0, 1}, "none", "linear Rec. 709", "unused"},
          {"scene_depth", "r32f", "Distance of the scene along the view axis.", "m", {0, 1000}},
          {"blurred", "rgba16f", "Level of the blurred scene: linear radiance, alpha 1.", "1", {0, 1}, "none", "linear Rec. 709", "1"}};
}

}  // namespace rainref::blur_pyramid
