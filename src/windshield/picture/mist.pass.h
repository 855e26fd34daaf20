// Pass mist: the effect of condensed water on the glass on the light through it. Needs composite.pass.h.
#ifndef RAINREF_FN
#ifndef RAINREF_WINDSHIELD_MIST_PASS_H_
#define RAINREF_WINDSHIELD_MIST_PASS_H_
#include <cstdint>

#include "windshield/picture/composite.pass.h"

namespace rainref::windshield {

struct MistUniforms {
  float u_row[3], glass_distance;
  float v_row[3], lod;
  float w_row[3], veil;
  float pixel[2], half_size[2];
  float scene_scale[2], weight;
  std::int32_t tap_count;
};
/// A position, relative to the pixel, that the blurred picture behind the mist averages.
struct Tap {
  float x, y, padding0, padding1;
};
static_assert(sizeof(MistUniforms) == 80 && sizeof(Tap) == 16);

/// It runs after composite of a pane if the scene has condensation.
struct MistPass : pass::Takes<MistUniforms> {
  static constexpr pass::About about{
      "mist", "What composite made of the scene, and through the mist on the glass a blurred and veiled one.", {}, {2}, {"dot"}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::u_row>("1", {-1e9, 1e9}, "u = u_row . (x, y, 1) / w_row . (x, y, 1) at pixel centre (x, y)."),
                  member<&U::glass_distance>("m", {-1e9, 1e9}, "As composite's."), member<&U::v_row>("1", {-1e9, 1e9}, "v likewise."),
                  member<&U::lod>("1", scene::mip_level, "Mip level of the lookups at the taps."),
                  member<&U::w_row>("1", {-1e9, 1e9}, "See u_row; positive where the glass lies before the eye."),
                  member<&U::veil>("1", scene::share, "Share of the light in the mist that comes from all the scene."),
                  member<&U::pixel>("1", {0, 1e6}, "Extent of a pixel on the image plane at distance 1."),
                  member<&U::half_size>("1", {0, 1e6}, "Half the extent of the image plane at distance 1."),
                  member<&U::scene_scale>("1", {0, 1e6}, "Texture coordinates of the scene per unit of the image plane."),
                  member<&U::weight>("1", scene::share, "Of a tap."), member<&U::tap_count>("1", {0, 4096}, "Taps in the list.")});
  }
  template <class B>
  struct Io {
    typename B::template Stored<Format::rgba16f> blurred =
        pass::In{.name = "blurred", .from = "blur_pyramid", .variant = "corrected", .filter = Filter::linear, .mip_filter = Filter::linear};
    typename B::template Records<Tap> taps = pass::In{.name = "taps", .variant = "corrected", .count = "tap_count"};
    typename B::template Stored<Format::r16f> condensation =
        pass::In{.name = "condensation", .from = "condense", .variant = "corrected", .filter = Filter::linear};
    typename B::template Texels<Format::rgba16f> colour = pass::In{.name = "colour", .from = "composite", .variant = "corrected"};
    typename B::template Result<Format::rgba16f> misted = pass::Out{.name = "colour", .variant = "corrected"};
  };
};

}  // namespace rainref::windshield
#endif
#else

// Droplets scatter most light by a few degrees, which blurs the view straight through them. The blur is the mean over a disc, so that lamps
// become discs; a level of the pyramid alone would make them bells. The rest is scattered by large angles, which adds light of the whole
// scene: its coarsest level, which every level from the last one on returns.
constexpr float coarsest_level = 15;
template <class Colours, class Values>
struct MistTextures {
  Colours blurred;
  Values condensation;
};
template <class Colours, class Values>
MistTextures(Colours, Values) -> MistTextures<Colours, Values>;
struct MistPassText {
  template <class Io>
  static RAINREF_FN auto views(const Io& io) {
    constexpr Address edge = Address::clamp;
    return MistTextures{io.blurred.template fixed<edge, edge, 4>(), io.condensation.template fixed<edge, edge, 1>()};
  }
  template <class N, bool corrected, class Io, class Textures>
  static RAINREF_FN void run(const MistUniforms& u, const Io& io, const Textures& t, int column, int row) {
    const GlassPoint<N> g = glass_point<N>(u, column, row);
    const N share = sample_bilinear<0, 1, N>(t.condensation, g.u, g.v)[0] * g.on_glass;
    const N su = scene_u(u, g.x), sv = scene_v(u, g.y);
    const N zero(0.0f);
    Vec3<N> sum(zero, zero, zero);
    const Tap* taps = io.taps.data();
    for (int k = 0; k < u.tap_count; ++k) sum = sum + blurred_at<N>(t.blurred, su + N(taps[k].x), sv + N(taps[k].y), u.lod);
    const Vec3<N> veil = blurred_at<N>(t.blurred, su, sv, coarsest_level);
    io.misted(mix(io.colour.rgb(), mix(N(u.weight) * sum, veil, N(u.veil)), share), N(1.0f));
  }
};
#endif
