// The scene behind wet glass: fogged, then blurred level by level.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "blur_pyramid/blur_pyramid.pass.h"
#include "capture/pass_info.h"
#include "capture/pass_model.h"
#include "image/texture.h"
#include "pass/run.h"
#include "rainref/image.h"

namespace rainref::blur_pyramid {

struct BlurSettings {
  bool corrected = false;
  Rounding rounding = Rounding::rne;
  int levels = 6;                                       ///< requested number, including the fogged scene; at most level_count
  double fog_density = 0.01;                            ///< extinction [1/m]
  std::array<double, 3> fog_colour{0.02, 0.025, 0.03};  ///< linear radiance
};

/// Columns and rows of a level: halves, rounded down, at least 1.
std::array<int, 2> level_size(int width, int height, int level);
/// Levels down to 1 x 1, level 0 included.
int level_count(int width, int height);

/// For one level of a scene of this size. In double, each rounded once.
BlurUniforms blur_uniforms(const BlurSettings& settings, int width, int height, int level);

/// Levels of rgba16f, zero.
std::vector<Image> make_levels(const BlurSettings& settings, int width, int height);
/// Rows of a tile in a level of this height, few enough for many threads. The tiles of a further level must span its width.
constexpr int tile_rows(int height) { return std::clamp(height / 64, 1, 8); }
/// The pass for level 0. colour: rgba16f, linear radiance; depth: r32f, distance along the view axis [m]; out: rgba16f, alpha 1.
pass::Run<FogPass> fog_run(const BlurUniforms& uniforms, Rounding rounding, const Image& colour, const Image& depth, Image& out);
/// The pass for a further level, from the one above. Throws Error(internal) if the levels do not fit.
pass::Run<HalvePass> halve_run(const BlurUniforms& uniforms, bool corrected, Rounding rounding, const Image& above, Image& out);

/// The levels as one texture with mips, for passes that sample them (clamped).
class LevelTexture {
 public:
  /// With the sizes of these levels; refresh fills it.
  explicit LevelTexture(const std::vector<Image>& levels);
  void refresh(const parallel::Executor& executor, const std::vector<Image>& levels);
  const StoredTexture<Half>& view() const { return view_; }
  LevelTexture(const LevelTexture&) = delete;
  LevelTexture& operator=(const LevelTexture&) = delete;

 private:
  std::vector<Half> texels_;
  StoredTexture<Half> view_;
};

/// The pass, one run per level, and the buffers that it reads and writes.
capture::PassInfo blur_info(const std::string& colour_from, const std::string& depth_from);
std::vector<capture::BufferInfo> blur_buffers();
std::unique_ptr<capture::PassModel> bind_blur(const capture::PassCase& c);

}  // namespace rainref::blur_pyramid
