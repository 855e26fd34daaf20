// Two passes of an effect that does not exist: whatever a definition may say, said once.
#ifndef RAINREF_FN
#ifndef RAINREF_TESTS_FROST_PASS_H_
#define RAINREF_TESTS_FROST_PASS_H_
#include "pass/definition.h"
#include "scene/uniform_block.h"

namespace rainref::frost {

struct Seed {
  float column, strength;
};
struct GrowUniforms {
  float gain, rate;
  std::int32_t seed_count;
  float padding0;
};
struct GrowPass : pass::Takes<GrowUniforms> {
  static constexpr pass::About about{"grow", "Ice on the pane.", {3}, {4}, {"the seeds"}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::gain>("1", {0, 10}, "Of a difference of heights."),
                  member<&U::rate>("1", {0, 10}, "corrected: of the height."),
                  member<&U::seed_count>("1", {0, 100}, "Seeds in the list.")});
  }
  template <class B>
  struct Io {
    typename B::template Texels<Format::r16f, 2> height = pass::In{.name = "height"};
    typename B::template Texels<Format::r8> mask = pass::In{.name = "mask"};
    typename B::template Records<Seed> seeds = pass::In{.name = "seeds", .variant = "corrected", .count = "seed_count"};
    typename B::template Result<Format::r32f> thickness = {
        pass::Out{.name = "thickness", .sentence = "Of the ice, as printed.", .unit = "mm", .range = {-9, 9}},
        pass::Out{.name = "thickness", .sentence = "Of the ice.", .unit = "mm", .range = {-9, 9}}};
  };
};

struct ShineUniforms {
  float scale, threshold;
  std::int32_t has_tint;
  float padding0;
};
struct ShinePass : pass::Takes<ShineUniforms> {
  static constexpr pass::About about{"shine", "The ice as it is seen.", {}, {1}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::scale>("1/mm", {0, 10}, "Radiance of a millimetre."),
                  member<&U::threshold>("1", {0, 1}, "From which it is thick."),
                  member<&U::has_tint>("1", scene::flag, "1: tint counts.")});
  }
  template <class B>
  struct Io {
    typename B::template Texels<Format::r32f> thickness = pass::In{.name = "thickness", .from = "grow"};
    typename B::Sampled sky = pass::In{.name = "sky", .filter = Filter::linear};
    typename B::template Texels<Format::rgba16f> tint = pass::In{.name = "tint", .optional = true};
    typename B::template Result<Format::rgba8> picture = pass::Out{.name = "picture", .sentence = "Display code."};
    typename B::template Result<Format::r8> thick = pass::Out{.name = "thick", .sentence = "1 where the ice is thick."};
  };
};

}  // namespace rainref::frost
#endif
#else

struct GrowPassText {
  template <class N, bool corrected, class Io>
  static RAINREF_FN void run(const GrowUniforms& u, const Io& io, int column, int) {
    const N slope = N(u.gain) * (io.height(-2, -1) - io.height(1, 2));
    if constexpr (corrected) {
      N t = slope * io.mask() + N(u.rate) * io.height();
      for (int k = 0; k < u.seed_count; ++k)
        t = t + N(io.seeds.data()[k].strength) * max(N(1.0f) - abs(N::index(column) - N(io.seeds.data()[k].column)), N(0.0f));
      io.thickness(t);
    } else {
      io.thickness(slope + io.mask());
    }
  }
};
struct ShinePassText {
  template <class N, bool, class Io>
  static RAINREF_FN void run(const ShineUniforms& u, const Io& io, int column, int row) {
    const N v = N(u.scale) * io.thickness();
    const auto s =
        sample_bilinear<0, 3, N>(io.sky.template fixed<Address::clamp, Address::clamp, 4>(), N::index(column), N(static_cast<float>(row)));
    Vec3<N> c = v * Vec3<N>(s[0], s[1], s[2]);
    if (u.has_tint != 0) c = c * io.tint.rgb();
    io.picture(c, N(1.0f));
    io.thick(select(v >= N(u.threshold), N(1.0f), N(0.0f)));
  }
};
#endif
