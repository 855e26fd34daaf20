// Pass raindrops. as published: drop i of the frame (seed 003, getRaindrops; hash22 as printed, hash12 by Dave Hoskins, which the article
// calls without printing it). corrected: integers, from rainfall.h.
#ifndef RAINREF_FN
#ifndef RAINREF_PUDDLE_RAINDROPS_PASS_H_
#define RAINREF_PUDDLE_RAINDROPS_PASS_H_
#include "pass/definition.h"
#include "puddle/uniforms.h"
#include "scene/uniform_block.h"

namespace rainref::puddle {

inline constexpr float raindrop_radius = 4.0f;  ///< as published [texel]
inline constexpr std::string_view raindrops_sentence = "The drops that fall in this step.";
inline constexpr pass::Out raindrops_out{.name = "drops", .sentence = "Drop records of this step.", .record = "Drop"};

struct PublishedRaindropsPass : pass::Takes<RaindropsUniforms> {
  static constexpr pass::About about{"raindrops", raindrops_sentence, {1, capture::Judge::keyed}, {}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::time>("s", scene::frame_time, "Frame number over frame rate, rounded once."),
                  member<&U::rain_speed>("1/s", {0, 20}, "Pulses of each drop a second."),
                  member<&U::drop_intensity>("1", {0, 4}, "Strength of an impact."),
                  member<&U::width>("texel", scene::whole(1, 65536), "Columns of the wave."),
                  member<&U::height>("texel", scene::whole(1, 65536), "Rows of the wave."),
                  member<&U::drop_count>("1", {1, 10}, "Drops in the list.")});
  }
  template <class B>
  struct Io {
    typename B::template List<Drop> drops = raindrops_out;
  };
};
struct RaindropsPass : pass::Takes<RainfallUniforms> {
  static constexpr pass::About about{"raindrops", raindrops_sentence, {}, {2, capture::Judge::bits}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::seed>("1", scene::any_word, "Low and high word of the seed."),
                  member<&U::step>("1", scene::any_word, "Wave steps made before this one, modulo 2^32."),
                  member<&U::first_count>("1", {0, 16000}, "Drops where the word is below every threshold."),
                  member<&U::columns>("texel", {1, 65536}, "Columns of the wave."),
                  member<&U::rows>("texel", {1, 65536}, "Rows of the wave."),
                  member<&U::boundary>("1", {0, 2}, "0: reflecting, 1: periodic, 2: fixed."),
                  member<&U::threshold_count>("1", {0, 16000}, "Thresholds in the list."),
                  member<&U::shelter_columns>("1", {0, 8192}, "Columns of the shelter; 0: there is none."),
                  member<&U::shelter_rows>("1", {0, 8192}, "Its rows."),
                  member<&U::object_count>("1", {0, 1 << 16}, "Records of objects in the list.")});
  }
  template <class B>
  struct Io {
    typename B::template Records<Drop> craters = pass::In{.name = "craters"};
    typename B::template Records<std::uint32_t> count_thresholds = pass::In{.name = "count_thresholds", .count = "threshold_count"};
    typename B::template Records<ShelterCell> shelter = pass::In{.name = "shelter"};
    typename B::template Records<Drop> objects = pass::In{.name = "objects", .count = "object_count"};
    typename B::template List<Drop> drops = raindrops_out;
  };
};

}  // namespace rainref::puddle
#endif
#else

template <class N>
struct Pair {
  N x, y;
};
template <class N>
RAINREF_FN Pair<N> hash22(N x, N y) {
  const Vec3<N> p3{fract(x * N(0.1031f)), fract(y * N(0.1030f)), fract(x * N(0.0973f))};
  const N d = dot(p3, Vec3<N>{p3.y + N(33.33f), p3.z + N(33.33f), p3.x + N(33.33f)});
  const Vec3<N> q{p3.x + d, p3.y + d, p3.z + d};
  return {fract((q.x + q.y) * q.z), fract((q.x + q.z) * q.y)};
}
template <class N>
RAINREF_FN N hash12(N x, N y) {
  const Vec3<N> p3{fract(x * N(0.1031f)), fract(y * N(0.1031f)), fract(x * N(0.1031f))};
  const N d = dot(p3, Vec3<N>{p3.y + N(33.33f), p3.z + N(33.33f), p3.x + N(33.33f)});
  const Vec3<N> q{p3.x + d, p3.y + d, p3.z + d};
  return fract((q.x + q.y) * q.z);
}

/// x, y [texels] and the activated strength of drop i.
template <class N>
RAINREF_FN Vec3<N> raindrop_as_published(const RaindropsUniforms& u, int i) {
  const N t = N(u.time) * N(u.rain_speed), base_time = floor(t);
  const N offset = N::index(i) * N(0.3711f);
  const N seed_x = base_time + offset, seed_y = N::index(i) * N(17.3f);
  const Pair<N> place = hash22(seed_x, seed_y);
  const N strength = N(u.drop_intensity) * (N(0.5f) + N(0.5f) * hash12(seed_x + N(1.0f), seed_y + N(1.0f)));
  const N pulse = fract(t + offset * N(0.7f));
  const N activation = smoothstep(0.0f, 0.15f, pulse) * smoothstep(0.35f, 0.2f, pulse);
  return Vec3<N>{place.x * N(u.width), place.y * N(u.height), strength * activation};
}
#endif
