// Pass soften: the effect of the film that blades leave on the light through it. Needs composite.pass.h.
#ifndef RAINREF_FN
#ifndef RAINREF_WINDSHIELD_SOFTEN_PASS_H_
#define RAINREF_WINDSHIELD_SOFTEN_PASS_H_
#include <cstdint>

#include "windshield/picture/composite.pass.h"

namespace rainref::windshield {

struct SoftenUniforms {
  float u_row[3], glass_distance;
  float v_row[3], lod;
  float w_row[3], most;
  float plane_x[3];
  std::int32_t deflection_count;
  float plane_y[3], padding0;
  float pixel[2], half_size[2];
  float scene_scale[2], padding1, padding2;
};
/// Deflection of a share of the scattered light.
struct Deflection {
  float tangent, weight, padding0, padding1;
};
static_assert(sizeof(SoftenUniforms) == 112 && sizeof(Deflection) == 16);

/// It runs after composite of a pane with blades if the scene has smear.
struct SoftenPass : pass::Takes<SoftenUniforms> {
  static constexpr pass::About about{
      "soften", "What composite made of the scene, drawn out across the streaks of the film that blades left.", {}, {1}, {"dot"}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::u_row>("1", {-1e9, 1e9}, "u = u_row . (x, y, 1) / w_row . (x, y, 1) at pixel centre (x, y)."),
                  member<&U::glass_distance>("m", {-1e9, 1e9}, "As composite's."), member<&U::v_row>("1", {-1e9, 1e9}, "v likewise."),
                  member<&U::lod>("1", scene::mip_level, "Mip level of the lookups."),
                  member<&U::w_row>("1", {-1e9, 1e9}, "See u_row; positive where the glass lies before the eye."),
                  member<&U::most>("1", scene::share, "Share of the light that the thickest streak scatters."),
                  member<&U::plane_x>("1", scene::component, "First axis of the glass's plane, camera axes: right, up, forward."),
                  member<&U::deflection_count>("1", {0, 4096}, "Deflections in the list."),
                  member<&U::plane_y>("1", scene::component, "Second axis."),
                  member<&U::pixel>("1", {0, 1e6}, "Extent of a pixel on the image plane at distance 1."),
                  member<&U::half_size>("1", {0, 1e6}, "Half the extent of the image plane at distance 1."),
                  member<&U::scene_scale>("1", {0, 1e6}, "Texture coordinates of the scene per unit of the image plane.")});
  }
  template <class B>
  struct Io {
    typename B::template Stored<Format::rgba16f> blurred =
        pass::In{.name = "blurred", .from = "blur_pyramid", .variant = "corrected", .filter = Filter::linear, .mip_filter = Filter::linear};
    typename B::template Records<Deflection> deflections =
        pass::In{.name = "deflections", .variant = "corrected", .count = "deflection_count"};
    typename B::template Stored<Format::rgba16f> smear =
        pass::In{.name = "smear", .from = "smear", .variant = "corrected", .filter = Filter::linear};
    typename B::template Texels<Format::rgba16f> colour = pass::In{.name = "colour", .from = "composite", .variant = "corrected"};
    typename B::template Result<Format::rgba16f> softened = pass::Out{.name = "colour", .variant = "corrected"};
  };
};

}  // namespace rainref::windshield
#endif
#else

// Streaks are ridges along the blade's motion. Each is a narrow lens that deflects light along the blade, across the streaks, which
// elongates lamps. A deflection with tangent k turns the ray (x, y, 1) into (x, y, 1) + k A, with A the unit vector along the blade. To
// first order it meets the image plane at (x, y) + k (A.xy - (x, y) A.z).
template <class Colours>
struct SoftenTextures {
  Colours blurred, smear;
};
template <class Colours>
SoftenTextures(Colours, Colours) -> SoftenTextures<Colours>;
struct SoftenPassText {
  template <class Io>
  static RAINREF_FN auto views(const Io& io) {
    constexpr Address edge = Address::clamp;
    return SoftenTextures{io.blurred.template fixed<edge, edge, 4>(), io.smear.template fixed<edge, edge, 4>()};
  }
  template <class N, bool corrected, class Io, class Textures>
  static RAINREF_FN void run(const SoftenUniforms& u, const Io& io, const Textures& t, int column, int row) {
    const GlassPoint<N> g = glass_point<N>(u, column, row);
    const auto film = sample_bilinear<0, 3, N>(t.smear, g.u, g.v);
    const N share = (N(u.most) * film[2]) * g.on_glass, zero(0.0f);
    const Vec3<N> along = film[0] * Vec3<N>(u.plane_x) + film[1] * Vec3<N>(u.plane_y);
    const N turned_u = (along.x - g.x * along.z) * N(u.scene_scale[0]), turned_v = (along.y - g.y * along.z) * N(u.scene_scale[1]);
    const N su = scene_u(u, g.x), sv = scene_v(u, g.y);
    const auto smeared = share > zero;
    Vec3<N> sum(zero, zero, zero);
    const Deflection* all = io.deflections.data();
    for (int k = 0; k < u.deflection_count && any(smeared); ++k) {
      const N tangent(all[k].tangent);
      sum = sum + N(all[k].weight) * blurred_at<N>(t.blurred, su + tangent * turned_u, sv + tangent * turned_v, u.lod);
    }
    const Vec3<N> before = io.colour.rgb();
    io.softened(select(smeared, mix(before, sum, share), before), N(1.0f));
  }
};
#endif
