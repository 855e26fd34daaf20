// Pass rain_on_glass: the scene behind wet glass.
#ifndef RAINREF_FN
#ifndef RAINREF_RAINY_GLASS_RAIN_ON_GLASS_PASS_H_
#define RAINREF_RAINY_GLASS_RAIN_ON_GLASS_PASS_H_
#include "pass/definition.h"
#include "rainy_glass/uniforms.h"
#include "scene/uniform_block.h"

namespace rainref::rainy_glass {

/// Its lanes are written by hand, because a scene key selects the storage format of the maps: see kernels_picture.cpp.
struct RainOnGlassPass : pass::Takes<RainOnGlassUniforms> {
  static constexpr pass::About about{
      "rain_on_glass", "The scene seen through the wet glass: linear radiance.", {1}, {1}, {"dot", "1 - normal squared"}};
  static scene::UniformBlock uniforms() {
    return block(
        {member<&U::pixel>("1", scene::share, "1 over the picture's columns and rows."),
         member<&U::time>("s", scene::frame_time, "as-published: frame number over frame rate, rounded once."),
         member<&U::rain_amount>("1", scene::share, "1: every droplet shows."),
         member<&U::drop_tiles>("1/m", {0, 1000}, "Tiles of the raindrop map in a metre."),
         member<&U::rivulet_tiles>("1/m", {0, 1000}, "Tiles of the rivulet map in a metre."),
         member<&U::drop_rate>("1/s", {0, 1000}, "as-published: cycles of a droplet in a second."),
         member<&U::flow_rate>("1/s", {0, 1000}, "as-published: cycles of the flow in a second."),
         member<&U::flow_strength>("1", {0, 10}, "Tiles by which full flow moves a rivulet in a cycle; corrected: across."),
         member<&U::distortion>("1", scene::component, "as-published: pictures per unit of the summed channels."),
         member<&U::use_probe>("1", scene::flag, "1: the reflection probe, 0: the scene's picture."),
         member<&U::probe_level>("1", {0, 16}, "Mip level of the probe."),
         member<&U::drop_phase>("1", scene::share, "corrected: fraction of the droplets' cycle."),
         member<&U::flow_phase>("1", scene::share, "corrected: fraction of the flow's cycle."),
         member<&U::scroll>("1", scene::share, "Way of the rivulets down the glass, fraction of a tile."),
         member<&U::run_strength>("1", {0, 1e11}, "corrected: tiles by which full flow moves a rivulet along the glass in a cycle."),
         member<&U::drop_neutral>("1", scene::share, "corrected: stored value of 0 in the raindrop map."),
         member<&U::drop_scale>("1", {1, 3}, "corrected: normal over stored value less neutral."),
         member<&U::rivulet_neutral>("1", scene::share, "corrected: stored value of 0 in the rivulet map."),
         member<&U::rivulet_scale>("1", {1, 3}, "corrected: as drop_scale."),
         member<&U::sharpness>("1", {0, 1e4}, "corrected: 1 over the height in which a rim turns visible."),
         member<&U::impact>("1", scene::share, "corrected: share of the cycle in which a droplet spreads."),
         member<&U::bend>("1", scene::share, "corrected: refractive index of water less 1."),
         member<&U::rivulet_amount>("1", {0, 4}, "Weight of the rivulets."),
         member<&U::rain_to>("1", {-300, 300}, "corrected: its product with the normal is the share of the rain that the glass meets."),
         member<&U::right>("1", scene::component, "Unit vector to the right of the picture, world."),
         member<&U::half_width>("1", {0, 1e6}, "Half the width of the image plane at distance 1."),
         member<&U::up>("1", scene::component, "Unit vector to the top of the picture."),
         member<&U::half_height>("1", {0, 12}, "Half the height of the image plane at distance 1."),
         member<&U::forward>("1", scene::component, "Unit vector into the picture."),
         member<&U::turn>("1", scene::component, "as-published: cosine and sine of the turn of the raindrop map."),
         member<&U::rivulet_turn>("1", scene::component, "as-published: the same of the rivulet map."),
         member<&U::flow_from>("1", {-10, 10}, "as-published: flow across and along that the stored value 0 stands for."),
         member<&U::flow_span>("1", {-20, 20}, "as-published: flow that 1 stands for, less flow_from."),
         member<&U::tint>("1", scene::share, "as-published: factor of the radiance behind the glass."),
         member<&U::fade_rate>("1", {1, 101}, "as-published: 1 over the range of |n.y| in which rivulets fade."),
         member<&U::remap_first>("1", scene::flag, "as-published: 1: channels are remapped to [-1, 1] before the mask, 0: their sum is."),
         member<&U::signed_offset>("1", scene::flag, "as-published: 1: the timer takes 2 B - 1, 0: B."),
         member<&U::squared_weight>("1", scene::flag, "as-published: 1: the second phase weighs the square of |1 - 2 p|, 0: that.")});
  }
  template <class B>
  struct Io {
    typename B::template Texels<Format::rgba32f> surface = pass::In{.name = "surface"};
    typename B::template Texels<Format::rgba16f> orientation = pass::In{.name = "orientation"};
    typename B::Sampled raindrops = pass::In{.name = "raindrops", .from = "bake_raindrops", .filter = Filter::linear};
    typename B::Sampled rivulets = pass::In{.name = "rivulets", .from = "bake_rivulets", .filter = Filter::linear};
    typename B::template Stored<Format::rgba16f> scene = pass::In{.name = "scene", .same_size = true, .filter = Filter::linear};
    typename B::template Texels<Format::r32f> scene_depth = pass::In{.name = "scene_depth", .variant = "corrected"};
    typename B::template Stored<Format::r32f> near_depth =
        pass::In{.name = "near_depth", .variant = "corrected", .same_size = true, .filter = Filter::linear};
    typename B::Sampled probe = pass::In{.name = "probe", .optional = true, .filter = Filter::linear, .mip_filter = Filter::linear};
    typename B::template Result<Format::rgba16f> colour =
        pass::Out{.name = "colour", .sentence = "Linear radiance, alpha 1.", .colour_space = "linear Rec. 709", .alpha = "1"};
  };
};

}  // namespace rainref::rainy_glass
#endif
#else

/// The glass and the scene at a pixel, as stored.
template <class N>
struct GlassPixel {
  N u, v;          ///< position on the glass [m]
  N distance;      ///< along the view axis [m]
  N covered;       ///< 1 on the glass, 0 beside it
  Vec3<N> normal;  ///< world, toward the rain
  Vec3<N> own;     ///< radiance of the scene at this pixel
  N own_depth;     ///< corrected: depth of the scene there, along the view axis [m]
};
/// As Textures, or for lanes in their storage type.
template <class Map, class Scene, class Depth>
struct GlassMaps {
  const Map *raindrops, *rivulets;
  const Scene* scene;
  const Depth* near_depth;
  const Texture* probe;
};

template <class N, class Maps>
RAINREF_FN Vec3<N> scene_at(const Maps& m, N u, N v) {
  const auto s = sample_bilinear<0, 3, N>(fixed_texture<Address::clamp, Address::clamp, 4>(*m.scene), u, v);
  return Vec3<N>(s[0], s[1], s[2]);
}
/// The reflection probe along the view ray, offset on the image plane at distance 1.
template <class N, class Maps>
RAINREF_FN Vec3<N> probe_at(const RainOnGlassUniforms& u, const Maps& m, N x, N y) {
  const Vec3<N> ray = Vec3<N>(u.forward) + x * Vec3<N>(u.right) + y * Vec3<N>(u.up);
  return sample_latlong(fixed_texture<Address::repeat, Address::clamp, 4>(*m.probe), ray, N(u.probe_level));
}

/// The two staggered phases of a flow whose cycle is at `phase`, and the weight of the second.
template <class N>
struct FlowPhases {
  N first, second, weight;
};
template <class N>
RAINREF_FN FlowPhases<N> flow_phases(N phase) {
  const N first = fract(phase);
  return {first, fract(phase + N(0.5f)), abs(N(1.0f) - N(2.0f) * first)};
}

// ---- as published --------------------------------------------------------------------------------------------------
//   timer = fract(time + B),  mask = ceil(A - timer),  d = mask RG + (1 - |n . up|) rivulets,  grab(screen + distortion (2 d - 1))
// rivulets: the map at uv + BA phase for both phases, mixed by the weight. The article does not define rain_amount; here it dims the map by
// 1 - rain_amount. Where the shader that the author ships reads otherwise, a uniform says so. A neutral one is skipped: it would change no
// bit, and what is searched in the article's text for causes stays that text.

/// A place on a map that is turned by this cosine and sine.
template <class N>
RAINREF_FN Two<N> turned(const float (&turn)[2], N u, N v) {
  if (turn[1] == 0) return {u, v};
  const N c(turn[0]), s(turn[1]);
  return {u * c - v * s, u * s + v * c};
}
/// Flow that a stored value of the rivulet map stands for.
template <class N>
RAINREF_FN N flow_of(float from, float span, N stored) {
  return from == 0 && span == 1 ? stored : N(from) + N(span) * stored;
}
/// Weight of the rivulets on glass with this |n . up|.
template <class N>
RAINREF_FN N upright_weight(const RainOnGlassUniforms& u, N level) {
  N weight = N(1.0f) - level;
  if (u.fade_rate != 1) weight = min(weight * N(u.fade_rate), N(1.0f));
  return u.rivulet_amount == 1 ? weight : N(u.rivulet_amount) * weight;
}
/// Sum of the masked droplets and the weighted rivulets of a channel, remapped from [0, 1] to [-1, 1] as a sum or each by itself.
template <class N>
RAINREF_FN N remapped_sum(bool is_before_mask, N mask, N drop, N upright, N streak) {
  const N one(1.0f), two(2.0f);
  if (is_before_mask) return mask * (two * drop - one) + upright * (two * streak - one);
  return two * (mask * drop + upright * streak) - one;
}
template <class N, class Maps>
RAINREF_FN Vec3<N> rain_on_glass_as_published(const RainOnGlassUniforms& u, const Maps& m, const GlassPixel<N>& p, int column, int row) {
  const N zero(0.0f), one(1.0f);
  const auto raindrops = fixed_texture<Address::repeat, Address::repeat, 4>(*m.raindrops),
             rivulets = fixed_texture<Address::repeat, Address::repeat, 4>(*m.rivulets);
  const Two<N> at = turned(u.turn, p.u, p.v);
  const auto drop = sample_bilinear<0, 4, N>(raindrops, at.a * N(u.drop_tiles), at.b * N(u.drop_tiles));
  const N offset = u.signed_offset != 0 ? N(2.0f) * drop[2] - one : drop[2];
  const N timer = fract(N(u.time) * N(u.drop_rate) + offset);
  const N mask = select(drop[3] - N(1.0f - u.rain_amount) - timer > zero, one, zero);

  const Two<N> run = turned(u.rivulet_turn, p.u, p.v);
  const N ru = run.a * N(u.rivulet_tiles), resting = run.b * N(u.rivulet_tiles), rv = u.scroll == 0 ? resting : resting + N(u.scroll);
  const auto stored = sample_bilinear<2, 2, N>(rivulets, ru, rv);
  const N fu = flow_of(u.flow_from[0], u.flow_span[0], stored[0]), fv = flow_of(u.flow_from[1], u.flow_span[1], stored[1]);
  const FlowPhases<N> f = flow_phases(N(u.time) * N(u.flow_rate));
  const N weight = u.squared_weight != 0 ? square(f.weight) : f.weight;
  const N strength(u.flow_strength), first = strength * f.first, second = strength * f.second;
  const auto a = sample_bilinear<0, 2, N>(rivulets, ru + fu * first, rv + fv * first);
  const auto b = sample_bilinear<0, 2, N>(rivulets, ru + fu * second, rv + fv * second);
  const N upright = upright_weight(u, abs(p.normal.y));
  const bool is_before_mask = u.remap_first != 0;
  const N ox = N(u.distortion) * remapped_sum(is_before_mask, mask, drop[0], upright, mix(a[0], b[0], weight)),
          oy = N(u.distortion) * remapped_sum(is_before_mask, mask, drop[1], upright, mix(a[1], b[1], weight));

  const N su = (N::index(column) + N(0.5f)) * N(u.pixel[0]) + ox, sv = N(static_cast<float>(row) + 0.5f) * N(u.pixel[1]) + oy;
  const N two(2.0f);
  const Vec3<N> behind =
      u.use_probe != 0 ? probe_at(u, m, (two * su - one) * N(u.half_width), (two * sv - one) * N(u.half_height)) : scene_at(m, su, sv);
  const bool is_clear = u.tint[0] == 1 && u.tint[1] == 1 && u.tint[2] == 1;
  return select(p.covered > N(0.5f), is_clear ? behind : Vec3<N>(u.tint) * behind, p.own);
}

// ---- corrected -----------------------------------------------------------------------------------------------------
/// Slope of the water, up along (x, y), from its stored normal.
template <class N>
RAINREF_FN Two<N> slope_of(N stored_x, N stored_y, float neutral, float scale) {
  const N x = (stored_x - N(neutral)) * N(scale), y = (stored_y - N(neutral)) * N(scale);
  const N inverse = N(-1.0f) / sqrt(max(sum_any_order(N(1.0f), -square(x), -square(y)), N(0.04f)));
  return Two<N>{x * inverse, y * inverse};
}
/// Current strength of the droplet, from 0 to 1. The threshold falls from 1 to 0 at the impact and then rises to 1 again: the droplet
/// spreads, then dries from its rim.
template <class N>
RAINREF_FN N droplet_shown(const RainOnGlassUniforms& u, N height, N offset, N amount) {
  const N one(1.0f), timer = fract(N(u.drop_phase) + offset);
  const N threshold =
      max(one - timer * uniform_quotient(1.0f, u.impact, N()), (timer - N(u.impact)) * uniform_quotient(1.0f, 1.0f - u.impact, N()));
  return saturate((height - (one - amount) - threshold) * N(u.sharpness));
}
/// Steepness of glass with this normal: the sine of its slope.
template <class N>
RAINREF_FN N steepness(const Vec3<N>& normal) {
  return sqrt(square(normal.x) + square(normal.z));
}
/// Slope of the water at position (pu, pv) [m] on glass with this normal, up along (u, v). Slopes are decoded before they are masked, so
/// that dry glass bends nothing.
template <class N, class Maps>
RAINREF_FN Two<N> water_slope(const RainOnGlassUniforms& u, const Maps& m, N pu, N pv, const Vec3<N>& normal, N steep) {
  const auto raindrops = fixed_texture<Address::repeat, Address::repeat, 4>(*m.raindrops),
             rivulets = fixed_texture<Address::repeat, Address::repeat, 4>(*m.rivulets);
  const N amount = N(u.rain_amount) * saturate(dot(normal, Vec3<N>(u.rain_to)));
  const N du = pu * N(u.drop_tiles), dv = pv * N(u.drop_tiles);
  const auto drop = sample_bilinear<0, 4, N>(raindrops, du, dv);
  const Two<N> bulge = slope_of(drop[0], drop[1], u.drop_neutral, u.drop_scale);
  const N shown = droplet_shown(u, drop[3], drop[2], amount);

  const N ru = pu * N(u.rivulet_tiles), rv = pv * N(u.rivulet_tiles), half(0.5f);
  const auto flow = sample_bilinear<2, 2, N>(rivulets, ru, rv);
  const N neutral(u.rivulet_neutral), scale(u.rivulet_scale);
  const N fu = (flow[0] - neutral) * scale * N(u.flow_strength), fv = (flow[1] - neutral) * scale * N(u.run_strength);
  const FlowPhases<N> f = flow_phases(N(u.flow_phase));
  const N first = f.first - half, second = f.second - half, scrolled = rv + N(u.scroll);
  const auto a = sample_bilinear<0, 2, N>(rivulets, ru + fu * first, scrolled + fv * first);
  const auto b = sample_bilinear<0, 2, N>(rivulets, ru + fu * second, scrolled + fv * second);
  const Two<N> streak = slope_of(mix(a[0], b[0], f.weight), mix(a[1], b[1], f.weight), u.rivulet_neutral, u.rivulet_scale);
  const N running = N(u.rivulet_amount) * steep;
  return Two<N>{shown * bulge.a + running * streak.a, shown * bulge.b + running * streak.b};
}
/// Dry glass shows the scene's texel itself.
template <class N>
RAINREF_FN typename N::Mask is_wet(const Two<N>& slope) {
  return square(slope.a) + square(slope.b) > N(1e-8f);
}
/// Displacement, on the image plane, of a scene point far behind the glass, for a sheet of water of this slope. A thin sheet of slope s
/// bends a ray by (ior - 1) s toward the thicker side.
template <class N>
RAINREF_FN Two<N> prism(const RainOnGlassUniforms& u, const Vec3<N>& normal, N steep, const Two<N>& slope) {
  // Along u, which is horizontal, and v, up the glass; both fade where the glass is level.
  const N zero(0.0f), one(1.0f), inverse = one / max(steep, N(0.05f));
  const Vec3<N> along_u{normal.z * inverse, zero, -normal.x * inverse};
  const Vec3<N> along_v{normal.y * along_u.z, normal.z * along_u.x - normal.x * along_u.z, -normal.y * along_u.x};
  const Vec3<N> rise = slope.a * along_u + slope.b * along_v;
  return Two<N>{N(u.bend) * dot(rise, Vec3<N>(u.right)), N(u.bend) * dot(rise, Vec3<N>(u.up))};
}
/// Share of that displacement for a scene point at this depth.
template <class N>
RAINREF_FN N share_beyond(const GlassPixel<N>& p) {
  constexpr const char* is_behind = "what lies behind the glass is further away than the glass, which is in front of the eye";
  return guard<N>(saturate(N(1.0f) - p.distance / guard<N>(max(p.own_depth, N(1e-3f)), is_behind)), is_behind);
}
// If something nearer than the glass lies under any texel of the lookup, the pixel shows its own scene texel.
template <class N, class Maps>
RAINREF_FN Vec3<N> rain_on_glass_corrected(const RainOnGlassUniforms& u, const Maps& m, const GlassPixel<N>& p, int column, int row) {
  const N one(1.0f), half(0.5f);
  const auto glass = (p.covered > half) & (p.own_depth > p.distance);
  if (!any(glass)) return p.own;
  const N steep = steepness(p.normal);
  const Two<N> slope = water_slope(u, m, p.u, p.v, p.normal, steep);
  const auto seen = glass & is_wet(slope);
  if (!any(seen)) return p.own;
  const Two<N> moved = prism(u, p.normal, steep, slope);
  const N x = moved.a, y = moved.b;
  const N cx = (N::index(column) + half) * N(u.pixel[0]), cy = N(static_cast<float>(row) + 0.5f) * N(u.pixel[1]), two(2.0f);
  if (u.use_probe != 0) {
    const Vec3<N> behind = probe_at(u, m, (two * cx - one) * N(u.half_width) + x, (two * cy - one) * N(u.half_height) + y);
    return select(seen, behind, p.own);
  }
  const N beyond = share_beyond(p);
  const N su = cx + x * beyond * uniform_quotient(0.5f, u.half_width, N()),
          sv = cy + y * beyond * uniform_quotient(0.5f, u.half_height, N());
  const N nearest = sample_bilinear<0, 1, N>(fixed_texture<Address::clamp, Address::clamp, 1>(*m.near_depth), su, sv)[0];
  return select(seen & (nearest > p.distance), scene_at(m, su, sv), p.own);
}

/// own: the scene's texel here; maps: the textures for the lookups.
template <class N, bool corrected, class Io, class Maps>
RAINREF_FN void give_glass(const RainOnGlassUniforms& u, const Io& io, const Vec3<N>& own, const Maps& maps, int column, int row) {
  N s[4], n[4], depth(0.0f);
  io.surface.load(s);
  io.orientation.load(n);
  if constexpr (corrected) depth = io.scene_depth();
  const GlassPixel<N> p{s[0], s[1], s[2], n[3], Vec3<N>(n[0], n[1], n[2]), own, depth};
  if constexpr (corrected)
    io.colour(rain_on_glass_corrected<N>(u, maps, p, column, row), N(1.0f));
  else
    io.colour(rain_on_glass_as_published<N>(u, maps, p, column, row), N(1.0f));
}
#endif
