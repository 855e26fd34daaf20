// Pass composite: the view of the eye through the wet glass.
#ifndef RAINREF_FN
#ifndef RAINREF_WINDSHIELD_COMPOSITE_PASS_H_
#define RAINREF_WINDSHIELD_COMPOSITE_PASS_H_
#include "pass/definition.h"
#include "scene/uniform_block.h"
#include "windshield/uniforms.h"

namespace rainref::windshield {

struct CompositePass : pass::Takes<CompositeUniforms> {
  static constexpr pass::About about{
      "composite", "The scene through film and drops, with glints: linear radiance.", {1}, {1}, {"dot", "length", "normalize"}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::u_row>("1", {-1e9, 1e9}, "u = u_row . (x, y, 1) / w_row . (x, y, 1) at pixel centre (x, y)."),
                  member<&U::glass_distance>("m", {-1e9, 1e9}, "The glass lies glass_distance / w_row . (x, y, 1) along the view axis."),
                  member<&U::v_row>("1", {-1e9, 1e9}, "v likewise."),
                  member<&U::blur_lod>("1", scene::mip_level, "Mip level of the picture behind the film."),
                  member<&U::w_row>("1", {-1e9, 1e9}, "See u_row; positive where the glass lies before the eye."),
                  member<&U::wetness>("1", scene::share, "Weight of the blurred picture where the glass was not wiped."),
                  member<&U::plane_x>("1", scene::component, "First axis of the glass's plane, camera axes: right, up, forward."),
                  member<&U::visible_from>("mm", {0, 10}, "Height at which water begins to show as a drop."),
                  member<&U::plane_y>("1", scene::component, "Second axis."),
                  member<&U::visible_to>("mm", {0, 10}, "Height from which it shows fully."),
                  member<&U::outward>("1", scene::component, "Normal of the glass, away from the car."),
                  member<&U::refraction>("1", scene::component, "as-published: offset in pictures per unit of n.xy."),
                  member<&U::pixel>("1", {0, 1e6}, "Extent of a pixel on the image plane at distance 1."),
                  member<&U::half_size>("1", {0, 1e6}, "Half the extent of the image plane at distance 1."),
                  member<&U::scene_scale>("1", {0, 1e6}, "Texture coordinates of the scene per unit of the image plane."),
                  member<&U::shininess>("1", {1, 4096}, "Power of a highlight."),
                  member<&U::glint_strength>("1", {0, 10}, "Weight of the highlights."),
                  member<&U::cabin>("1", scene::radiance, "Radiance beside the glass."),
                  member<&U::glint_count>("1", {0, 65536}, "Lights in the list.").guarded("a scene has one light"),
                  member<&U::water_ior>("1", {0, 2}, "corrected: refractive index of the water."),
                  member<&U::inner>("1", scene::share, "corrected: share of the blurred scene that the water's surface mirrors.")});
  }
  template <class B>
  struct Io {
    typename B::template Stored<Format::rgba16f> blurred =
        pass::In{.name = "blurred", .from = "blur_pyramid", .filter = Filter::linear, .mip_filter = Filter::linear};
    typename B::template Stored<Format::r32f> scene_depth =
        pass::In{.name = "scene_depth", .variant = "corrected", .filter = Filter::linear};
    typename B::template Stored<Format::r16f> height = pass::In{.name = "height", .from = "wipe_texture", .filter = Filter::linear};
    typename B::template Stored<Format::rgba16f> normal = pass::In{.name = "normal", .from = "normals", .filter = Filter::linear};
    typename B::template Stored<Format::r16f> mask = pass::In{.name = "mask", .from = "wipe_texture", .filter = Filter::linear};
    typename B::template Records<Glint> glints = pass::In{.name = "glints", .count = "glint_count"};
    typename B::template Result<Format::rgba16f> colour =
        pass::Out{.name = "colour", .sentence = "Linear radiance; alpha 1.", .colour_space = "linear Rec. 709", .alpha = "opaque"};
  };
};

}  // namespace rainref::windshield
#endif
#else

/// The pixel's view ray and its intersection with the glass. The ray is (x, y, 1) in camera axes: right, up, forward.
template <class N>
struct GlassPoint {
  N x, y;      ///< on the image plane at distance 1
  N distance;  ///< along the view axis to the glass [m]
  N u, v;      ///< glass coordinates
  N on_glass;  ///< 1 on the glass, 0 beside it
};
template <class N>
RAINREF_FN N row_times(const float* row, N px, N py) {
  return sum_any_order(N(row[0]) * px, N(row[1]) * py, N(row[2]));
}
template <class N, class Uniforms>
RAINREF_FN GlassPoint<N> glass_point(const Uniforms& c, int column, int row) {
  const N px = N::index(column) + N(0.5f), py = N(static_cast<float>(row) + 0.5f), zero(0.0f), one(1.0f);
  const N toward = row_times(c.w_row, px, py);
  // There is no glass beside and behind the eye, but the quotient must stay finite.
  const N inverse = one / max(toward, N(1e-6f));
  const N u = row_times(c.u_row, px, py) * inverse, v = row_times(c.v_row, px, py) * inverse;
  const auto on = (toward > N(1e-6f)) & (u >= zero) & (u <= one) & (v >= zero) & (v <= one);
  return {px * N(c.pixel[0]) - N(c.half_size[0]),
          py * N(c.pixel[1]) - N(c.half_size[1]),
          N(c.glass_distance) * inverse,
          clamp(u, zero, one),
          clamp(v, zero, one),
          select(on, one, zero)};
}

/// Values of the textures at that point.
template <class N>
struct Water {
  Vec3<N> normal;  ///< in glass axes: plane x, plane y, outward; unit
  N height;        ///< [mm]
  N mask;          ///< 1: just wiped
};
template <class N, class Colours, class Values>
RAINREF_FN Water<N> water_at(const Values& height, const Colours& normal, const Values& mask, const GlassPoint<N>& g) {
  const auto n = sample_bilinear<0, 3, N>(normal, g.u, g.v);
  const N m = guard<N>(saturate(sample_bilinear<0, 1, N>(mask, g.u, g.v)[0]), "the mask is stored between 0 and 1");
  return {Vec3<N>{n[0], n[1], max(n[2], N(0.05f))}, sample_bilinear<0, 1, N>(height, g.u, g.v)[0], m};
}
/// In camera axes.
template <class N>
RAINREF_FN Vec3<N> to_camera(const CompositeUniforms& c, const Vec3<N>& glass) {
  return glass.x * Vec3<N>(c.plane_x) + glass.y * Vec3<N>(c.plane_y) + glass.z * Vec3<N>(c.outward);
}
/// Texture coordinates of the scene point that a pixel of a drop shows, in the picture of the scene.
template <class N>
struct ScenePoint {
  N u, v;
};
template <class N, class Uniforms>
RAINREF_FN N scene_u(const Uniforms& c, N x) {
  return N(0.5f) + x * N(c.scene_scale[0]);
}
template <class N, class Uniforms>
RAINREF_FN N scene_v(const Uniforms& c, N y) {
  return N(0.5f) + y * N(c.scene_scale[1]);
}

template <class N, class Colours>
RAINREF_FN Vec3<N> sharp_at(const Colours& pyramid, N u, N v) {
  const auto s = sample_bilinear<0, 3, N>(pyramid, u, v);
  return Vec3<N>(s[0], s[1], s[2]);
}
template <class N, class Colours>
RAINREF_FN Vec3<N> blurred_at(const Colours& pyramid, N u, N v, float lod) {
  const auto s = sample_trilinear<0, 3, N>(pyramid, u, v, lod);
  return Vec3<N>(s[0], s[1], s[2]);
}
/// Blinn's highlight: (n . h)^shininess with h halfway between the light and the eye.
template <class N>
RAINREF_FN N highlight(const Vec3<N>& normal, const Vec3<N>& to_light, const Vec3<N>& to_eye, float shininess) {
  const Vec3<N> sum = to_light + to_eye;
  const N size = max(length(sum), N(1e-4f));
  const N cosine = saturate(dot(normal, sum) / size);
  return pow(max(cosine, N(1e-4f)), N(shininess));
}

// ---- as published --------------------------------------------------------------------------------------------------
//   bgBlur = pyramid(screen, blurLOD),  bgSharp = scene(screen + offset),  offset = refraction n.xy visibility
// then film over the scene by wetness, and drops over the film by their visibility, both cut by the wiper mask; glints from the perturbed
// normal. The article does not give the sign of the offset; here the picture moves along n.xy (E0 10).
template <class N>
RAINREF_FN ScenePoint<N> shown_as_published(const CompositeUniforms& c, const GlassPoint<N>& g, const Water<N>& w, N visibility) {
  const N strength = N(c.refraction) * visibility;
  return {scene_u(c, g.x) + strength * w.normal.x, scene_v(c, g.y) + strength * w.normal.y};
}
template <class N, class Colours, class Values>
RAINREF_FN Vec3<N> composite_as_published(const CompositeUniforms& c, const Colours& pyramid, const Values& height, const Colours& normal,
                                          const Values& mask, const Glint* glints, int column, int row) {
  const GlassPoint<N> g = glass_point<N>(c, column, row);
  const Water<N> w = water_at<N>(height, normal, mask, g);
  const N wet = N(1.0f) - w.mask;
  const N visibility = smoothstep(c.visible_from, c.visible_to, w.height) * wet;
  const N su = scene_u(c, g.x), sv = scene_v(c, g.y);
  const ScenePoint<N> shown = shown_as_published(c, g, w, visibility);
  const Vec3<N> behind = sharp_at<N>(pyramid, su, sv), blur = blurred_at<N>(pyramid, su, sv, c.blur_lod);
  const Vec3<N> sharp = sharp_at<N>(pyramid, shown.u, shown.v);
  Vec3<N> colour = mix(mix(behind, blur, N(c.wetness) * wet), sharp, visibility);
  const N eye_inverse = N(1.0f) / length(Vec3<N>{g.x, g.y, N(1.0f)});
  const Vec3<N> to_eye = (-eye_inverse) * Vec3<N>{g.x, g.y, N(1.0f)};
  // Seen from inside, the normal of the glass and its water points to the eye.
  const Vec3<N> facing = N(-1.0f) * to_camera(c, w.normal);
  const auto shows = visibility > N(0.0f);
  for (int k = 0; k < c.glint_count && any(shows); ++k) {
    const N shine = highlight(facing, Vec3<N>(glints[k].direction), to_eye, c.shininess) * (N(c.glint_strength) * visibility);
    colour = guard<N>(select(shows, colour + shine * Vec3<N>(glints[k].radiance), colour), for_lanes);
  }
  return mix(Vec3<N>(c.cabin), colour, g.on_glass);
}

// ---- corrected -----------------------------------------------------------------------------------------------------
// The view ray is refracted at the plane of the glass and at the water's surface, by Snell's law (a pane with parallel faces deflects no
// ray). The scene is looked up at the depth found there:
//   P = G + D2 max(depth - G.z, 0) / D2.z,  scene at P.xy / P.z = mix(D2.xy / D2.z, G.xy / G.z, G.z / P.z)
// By Fresnel's reflectance of the water's surface, 1 beyond the critical angle, it mirrors the dimmed blurred scene: the dark rim.
template <class N>
RAINREF_FN Vec3<N> through_water(const Vec3<N>& ray, const Vec3<N>& outward, const Vec3<N>& surface, float ior) {
  const Vec3<N> inside = guard<N>(refract(ray, N(-1.0f) * outward, 1.0f / ior), "the ray enters the denser medium");
  return refract(inside, N(-1.0f) * surface, ior);
}
template <class N, class Depths>
RAINREF_FN ScenePoint<N> shown_corrected(const CompositeUniforms& c, const Depths& depth, const GlassPoint<N>& g, const Vec3<N>& bent) {
  const N far = max(sample_bilinear<0, 1, N>(depth, scene_u(c, g.x), scene_v(c, g.y))[0] - g.distance, N(0.0f));
  const N ahead = max(bent.z, N(0.05f)), share = g.distance / max(g.distance + far, N(1e-3f));
  const N x = mix(bent.x / ahead, g.x, share), y = mix(bent.y / ahead, g.y, share);
  return {scene_u(c, x), scene_v(c, y)};
}
template <class N, class Colours, class Depths, class Values>
RAINREF_FN Vec3<N> composite_corrected(const CompositeUniforms& c, const Colours& pyramid, const Depths& depth, const Values& height,
                                       const Colours& normal, const Values& mask, const Glint* glints, int column, int row) {
  const N one(1.0f), zero(0.0f);
  const GlassPoint<N> g = glass_point<N>(c, column, row);
  const Water<N> w = water_at<N>(height, normal, mask, g);
  const N wet = one - w.mask;
  const N visibility = smoothstep(c.visible_from, c.visible_to, w.height);

  const Vec3<N> ray = normalize(Vec3<N>(g.x, g.y, one)), outward(c.outward);
  const Vec3<N> surface = to_camera(c, w.normal);
  const Vec3<N> bent = through_water(ray, outward, surface, c.water_ior);
  const N cosine =
      guard_below<N>(saturate(dot(bent, surface)), "a refracted ray leaves on the side of the normal; one that is reflected is 0");
  const N reflected = fresnel_dielectric(cosine, c.water_ior);

  const ScenePoint<N> shown = shown_corrected(c, depth, g, bent);
  const N su = shown.u, sv = shown.v;

  const Vec3<N> sharp = sharp_at<N>(pyramid, su, sv), blur = blurred_at<N>(pyramid, su, sv, c.blur_lod);
  Vec3<N> colour = mix(sharp, blur, N(c.wetness) * wet * (one - visibility));
  colour = mix(colour, N(c.inner) * blur, reflected);
  const Vec3<N> to_eye = N(-1.0f) * ray, facing = N(-1.0f) * surface;
  const N film = visibility * (one - square(w.mask));
  const auto shows = film > zero;
  for (int k = 0; k < c.glint_count && any(shows); ++k) {
    const N shine = highlight(facing, Vec3<N>(glints[k].direction), to_eye, c.shininess) * (N(c.glint_strength) * film);
    colour = guard<N>(select(shows, colour + shine * Vec3<N>(glints[k].radiance), colour), for_lanes);
  }
  return mix(Vec3<N>(c.cabin), colour, g.on_glass);
}

template <class Colours, class Depths, class Values>
struct CompositeTextures {
  Colours blurred, normal;
  Depths depth;
  Values height, mask;
};
// clang before 17 does not deduce aggregates.
template <class Colours, class Depths, class Values>
CompositeTextures(Colours, Colours, Depths, Values, Values) -> CompositeTextures<Colours, Depths, Values>;
struct CompositePassText {
  template <class Io>
  static RAINREF_FN auto views(const Io& io) {
    constexpr Address edge = Address::clamp;
    return CompositeTextures{io.blurred.template fixed<edge, edge, 4>(), io.normal.template fixed<edge, edge, 4>(),
                             io.scene_depth.template fixed<edge, edge, 1>(), io.height.template fixed<edge, edge, 1>(),
                             io.mask.template fixed<edge, edge, 1>()};
  }
  template <class N, bool corrected, class Io, class Textures>
  static RAINREF_FN void run(const CompositeUniforms& u, const Io& io, const Textures& t, int column, int row) {
    if constexpr (corrected)
      io.colour(composite_corrected<N>(u, t.blurred, t.depth, t.height, t.normal, t.mask, io.glints.data(), column, row), N(1.0f));
    else
      io.colour(composite_as_published<N>(u, t.blurred, t.height, t.normal, t.mask, io.glints.data(), column, row), N(1.0f));
  }
};
#endif
