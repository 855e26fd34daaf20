// Pass falling_rain: drops that fall behind the glass, drawn as streaks of the camera's exposure. Needs wipe_texture.pass.h.
#ifndef RAINREF_FN
#ifndef RAINREF_WINDSHIELD_FALLING_RAIN_PASS_H_
#define RAINREF_WINDSHIELD_FALLING_RAIN_PASS_H_
#include <algorithm>
#include <span>
#include <vector>

#include "pass/definition.h"
#include "rainref/executor.h"
#include "scene/uniform_block.h"
#include "windshield/uniforms.h"

namespace rainref::windshield {

struct FallingRainUniforms {
  std::int32_t streak_count;
  float sharpness, padding0, padding1;
};
static_assert(sizeof(FallingRainUniforms) == 16);

/// In place, on level 0 of the pyramid: all fog is behind it, and the film before it. It runs only if the scene asks for it.
struct FallingRainPass : pass::Takes<FallingRainUniforms> {
  static constexpr pass::About about{
      "falling_rain", "Streaks of the rain behind the glass over the fogged scene, far ones first.", {1}, {1}, {"length"}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::streak_count>("1", {0, 1 << 24}, "Streaks in the list."),
                  member<&U::sharpness>("1/m", {0, 1000}, "1 over the depth in which what stands in the street hides a streak.")});
  }
  /// The number given by the uniform, or all: a port that lost some may have fewer.
  static std::span<const Streak> counted(const Uniforms& u, std::span<const Streak> all) {
    const auto said = static_cast<std::size_t>(u.streak_count);
    return u.streak_count < 0 || said > all.size() ? all : all.first(said);
  }
  /// The streaks that may cover a texel of the tile, in order. The others cover nothing there, so leaving them out changes no bit.
  static std::vector<Streak> near(const Uniforms& u, std::span<const Streak> all, bool, int, const parallel::Tile& t) {
    std::vector<Streak> some;
    for (const Streak& s : counted(u, all)) {
      const float reach = s.radius + 2;
      const auto [left, right] = std::minmax(s.opened[0], s.closed[0]);
      const auto [low, high] = std::minmax(s.opened[1], s.closed[1]);
      if (right + reach > static_cast<float>(t.x0) && left - reach < static_cast<float>(t.x1) && high + reach > static_cast<float>(t.y0) &&
          low - reach < static_cast<float>(t.y1))
        some.push_back(s);
    }
    return some;
  }
  template <class B>
  struct Io {
    typename B::template Texels<Format::rgba16f> blurred = pass::In{.name = "blurred", .from = "blur_pyramid"};
    typename B::template Texels<Format::r32f> scene_depth = pass::In{.name = "scene_depth"};
    typename B::template Records<Streak> streaks = pass::In{.name = "streaks"};
    typename B::template Result<Format::rgba16f> rainy = pass::Out{.name = "blurred"};
  };
};

}  // namespace rainref::windshield
#endif
#else

struct FallingRainPassText {
  template <class N, bool corrected, class Io>
  static RAINREF_FN void run(const FallingRainUniforms& u, const Io& io, int x, int y) {
    const N px = N::index(x) + N(0.5f), py(static_cast<float>(y) + 0.5f), depth = io.scene_depth();
    Vec3<N> colour = io.blurred.rgb();
    const Streak* streaks = io.streaks.data();
    for (int i = 0; i < io.streaks.size(); ++i) {
      const Streak& s = streaks[i];
      const N distance = segment_distance(px, py, N(s.opened[0]), N(s.opened[1]), N(s.closed[0]), N(s.closed[1]));
      const N covered = coverage_at(distance, N(s.radius), N(1.0f)), before = saturate((depth - N(s.depth)) * N(u.sharpness));
      colour = mix(colour, Vec3<N>(s.radiance), N(s.opacity) * covered * before);
    }
    io.rainy(colour, N(1.0f));
  }
};
#endif
