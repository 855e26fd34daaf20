// Pass drops: the scene refracted by the water on the window. Needs background.pass.h.
#ifndef RAINREF_FN
#ifndef RAINREF_SCREEN_DROPS_DROPS_PASS_H_
#define RAINREF_SCREEN_DROPS_DROPS_PASS_H_
#include "pass/definition.h"
#include "scene/uniform_block.h"
#include "screen_drops/uniforms.h"

namespace rainref::screen_drops {

inline constexpr std::string_view drops_sentence = "The scene through the drops on the window: linear radiance, and where water is.";
inline constexpr pass::Out drops_colour{
    .name = "colour", .sentence = "Linear radiance, alpha 1.", .colour_space = "linear Rec. 709", .alpha = "1"};

struct PublishedDropsPass : pass::Takes<PublishedDropsUniforms> {
  static constexpr pass::About about{"drops", drops_sentence, {3}, {}, {"dot", "length", "normalize"}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::resolution>("pixel", scene::whole(1, 65536), "Columns and rows of the picture."),
                  member<&U::time>("s", scene::frame_time, "Frame number over frame rate, rounded once."),
                  member<&U::grid>("cell/pixel", scene::share, "Cells of layer 1 in a pixel."),
                  member<&U::keep>("1", scene::share, "Times keep_from - layer: the noise below which a cell holds a drop."),
                  member<&U::refraction>("1", scene::component, "Pictures per unit of the normal."),
                  member<&U::printed_misprint>("1", scene::flag, "1: the displacement as the report prints it."),
                  member<&U::noise_nearest>("1", scene::flag, "1: noise is looked up unfiltered, texel floor(fract(u) size)."),
                  member<&U::layers>("1", scene::whole(1, most_published_layers), "Grids of cells."),
                  member<&U::water_step>("1", scene::share, "1 over layers."),
                  member<&U::cell_angle>("rad", {0, 100}, "Of the sine over a cell."),
                  member<&U::noise_middle>("1", scene::share, "Noise that displaces nothing."),
                  member<&U::displacement>("rad", {-100, 100}, "Of the grid per unit of noise."),
                  member<&U::keep_from>("1", {0, 100}, "Layer from which on no cell holds a drop."),
                  member<&U::threshold>("1", {least_threshold, 2}, "Sum of the sines above which a drop is."),
                  member<&U::printed_normal>("1", scene::flag, "1: the normal as the report prints it, of the cosine of a sine."),
                  member<&U::level>("1", {0, 16}, "Mip level at which drops see the scene, without gradient_level."),
                  member<&U::gradient_level>("1", scene::flag, "1: the level follows from the gradient of the drop's normal.")});
  }
  template <class B>
  struct Io {
    typename B::template Texels<Format::rgba16f> background = pass::In{.name = "background", .from = "background"};
    typename B::template Stored<Format::rgba16f> scene = pass::In{.name = "scene", .filter = Filter::linear, .mip_filter = Filter::linear};
    typename B::Sampled noise = pass::In{.name = "noise", .filter = Filter::linear};
    typename B::template Result<Format::r8> water =
        pass::Out{.name = "water", .sentence = "Layer whose drop shows, over the number of layers; 0: none."};
    typename B::template Result<Format::rgba16f> colour = drops_colour;
  };
};
/// corrected. Its lanes are written by hand: see kernels.cpp.
struct DropsPass : pass::Takes<DropsUniforms> {
  static constexpr pass::About about{"drops", drops_sentence, {}, {1}, {"dot", "length", "normalize"}};
  static scene::UniformBlock uniforms() {
    return block(
        {member<&U::cells_per_pixel>("cell/pixel", {0, 1e6}, "Of each layer."),
         member<&U::offset_x>("cell", scene::share, "Place of the picture's corner in each layer."),
         member<&U::offset_y>("cell", scene::share, "Place of the picture's corner in each layer."),
         member<&U::pixels_per_cell>("pixel/cell", {0, 1e9}, "Of each layer."),
         member<&U::level>("1", {0, 32}, "Mip level at which each layer's drops see the scene."),
         member<&U::first_row>("texel", {0, 1 << 24}, "Row of cells where each layer begins.").guarded("the first layer begins in row 0"),
         member<&U::pixel>("1", {0, 1e6}, "Extent of a pixel on the image plane at distance 1."),
         member<&U::half_size>("1", {0, 1e6}, "Half the extent of the image plane at distance 1."),
         member<&U::scene_scale>("1", {0, 1e6}, "Texture coordinates of the scene per unit of the image plane."),
         member<&U::sine>("1", scene::share, "Of the contact angle."), member<&U::water_ior>("1", {1, 2}, "Refractive index of water."),
         member<&U::inner>("1", scene::share, "Share of the background that the water's surface mirrors."),
         member<&U::has_flow>("1", scene::flag, "1: height counts."),
         member<&U::flow_slope>("1/mm", {0, 1e9}, "Slope per difference of heights two texels apart."),
         member<&U::flow_pixel>("1", scene::share, "1 over the picture's columns and rows."),
         member<&U::visible_from>("mm", {0, 10}, "Height at which flowing water begins to show."),
         member<&U::visible_to>("mm", {0, 10}, "Height from which it shows fully."),
         member<&U::flow_level>("1", {0, 32}, "Mip level at which flowing water sees the scene."),
         member<&U::flow_texel>("1", scene::share, "1 over the columns and rows of height.")});
  }
  template <class B>
  struct Io {
    typename B::template Texels<Format::rgba16f> background = pass::In{.name = "background", .from = "background"};
    typename B::template Stored<Format::rgba16f> scene = pass::In{.name = "scene", .filter = Filter::linear, .mip_filter = Filter::linear};
    typename B::template Stored<Format::rgba32f> cells = pass::In{.name = "cells", .from = "cells"};
    typename B::template Stored<Format::r16f> height = pass::In{.name = "height", .from = "splat", .filter = Filter::linear};
    typename B::template Result<Format::r8> water = pass::Out{.name = "water", .sentence = "Share of the pixel that water covers."};
    typename B::template Result<Format::rgba16f> colour = drops_colour;
  };
};

}  // namespace rainref::screen_drops
#endif
#else

/// The colour of a pixel, and the share of it that is water.
template <class N>
struct Window {
  Vec3<N> colour;
  N water;
};

// ---- as published --------------------------------------------------------------------------------------------------
// For layers r = layers, ..., 2, 1, each over the earlier ones, with u = pixel / resolution:
//   x = resolution r grid,  p = cell_angle u x + (n - noise_middle) displacement,  n = noise(u / 10).rg
//   d = noise(round(u x - .25) / x),  t = (sin p.x + sin p.y) max(0, 1 - 2 fract(time (d.b + .1) + d.g))
//   a drop where d.r < (keep_from - r) keep and t > threshold:
//     scene(u - refraction v.xy),  v = normalize(-(cos p, mix(.2, 2, t - .5)))
// round(a) is floor(a + 1/2). The report prints (1 - c2) c3 instead of (n - c2) c3. It does not give c1 = cell_angle, c2 = noise_middle, c3
// = displacement, nor c1 = keep_from and c2 = keep of its rule for keeping drops, nor the threshold. It prints the .2, 2 and .5 of the
// normal. It calls the sine p, and its normal uses the cosine of that: cos(sin p).
//
// The origin's lookup has no level: a fragment shader takes one from the differences of neighbouring pixels. gradient_level has its
// analytic form. With w the normal before it is normalized and w' its derivative by a step of one pixel, v' = (w' - v (v.w')) / |w|. The
// shift counts as constant: it is the gradient of the drop's own normal.
template <int Count, class N, class T>
RAINREF_FN auto published_noise(const PublishedDropsUniforms& d, const T& noise, N u, N v) {
  return d.noise_nearest != 0 ? sample_nearest<0, Count, N>(noise, u, v) : sample_bilinear<0, Count, N>(noise, u, v);
}
template <class N>
struct PublishedDrop {
  N layer;  ///< 0: none
  N u, v;   ///< coordinates of the lookup in the scene
  N level;  ///< of the lookup; 0 without gradient_level
};
/// Square of the way that the lookup goes in the scene [texel] in a step of one pixel along an axis of the picture. near, far: texels that
/// a unit of the normal moves it along this axis and across; v_near, v_far, v_z: the normal; w_near, w_z: the step's w', 0 across.
template <class N>
RAINREF_FN N squared_stride(N near, N far, N v_near, N v_far, N v_z, N inverse, N w_near, N w_z) {
  const N along = v_near * w_near + v_z * w_z;
  const N forward = N(1.0f) + near * ((w_near - v_near * along) * inverse), aside = far * ((v_far * along) * inverse);
  return square(forward) + square(aside);
}
template <class N, class T>
RAINREF_FN PublishedDrop<N> published_drop(const PublishedDropsUniforms& d, const T& noise, int column, int row) {
  const N half(0.5f), one(1.0f), two(2.0f), quarter(0.25f), zero(0.0f);
  const N width(d.resolution[0]), height(d.resolution[1]);
  const N u = (N::index(column) + half) / width, v = N(static_cast<float>(row) + 0.5f) / height;
  PublishedDrop<N> out{zero, u, v, zero};
  const auto n = published_noise<2, N>(d, noise, u * N(0.1f), v * N(0.1f));
  const bool misprint = d.printed_misprint != 0;
  const N middle(d.noise_middle), per_unit(d.displacement);
  const N shift_x = (misprint ? one - middle : n[0] - middle) * per_unit, shift_y = (misprint ? one - middle : n[1] - middle) * per_unit;
  // Packs and scenes do not exceed this, but a mistake tried on the uniforms may.
  for (int r = d.layers < most_published_layers ? d.layers : most_published_layers; r > 0; --r) {
    const N layer(static_cast<float>(r)), columns = width * layer * N(d.grid), rows = height * layer * N(d.grid);
    const N px = N(d.cell_angle) * u * columns + shift_x, py = N(d.cell_angle) * v * rows + shift_y;
    const N cell_x = floor((u * columns - quarter) + half), cell_y = floor((v * rows - quarter) + half);
    const auto s = published_noise<3, N>(d, noise, cell_x / columns, cell_y / rows);
    const auto is_kept = s[0] < (N(d.keep_from) - layer) * N(d.keep);
    if (!any(is_kept)) continue;
    const N fade = max(zero, one - fract(N(d.time) * (s[2] + N(0.1f)) + s[1]) * two);
    const N sine_x = sin(px), sine_y = sin(py), t = (sine_x + sine_y) * fade;
    const auto is_drop = is_kept & (t > N(d.threshold));
    if (!any(is_drop)) continue;
    const bool printed = d.printed_normal != 0;
    const N x = cos(printed ? sine_x : px), y = cos(printed ? sine_y : py), z = mix(N(0.2f), two, t - half);
    const N inverse = one / sqrt(sum_any_order(square(x), square(y), square(z)));
    out.layer = guard<N>(select(is_drop, layer, out.layer), for_lanes);
    out.u = guard<N>(select(is_drop, u + x * inverse * N(d.refraction), out.u), for_lanes);
    out.v = guard<N>(select(is_drop, v + y * inverse * N(d.refraction), out.v), for_lanes);
    if (d.gradient_level == 0) continue;
    // Derivatives by the angle, each then times the angle of a pixel.
    const N cosine_x = printed ? cos(px) : x, cosine_y = printed ? cos(py) : y;
    const N turn_x = printed ? sin(sine_x) * cosine_x : sine_x, turn_y = printed ? sin(sine_y) * cosine_y : sine_y;
    const N per_pixel = N(d.cell_angle) * (layer * N(d.grid)), rise = N(1.8f) * fade;
    const N wide = width * N(d.refraction), high = height * N(d.refraction), vx = x * inverse, vy = y * inverse, vz = z * inverse;
    const N across = squared_stride(wide, high, vx, vy, vz, inverse, -turn_x * per_pixel, (rise * cosine_x) * per_pixel);
    const N upward = squared_stride(high, wide, vy, vx, vz, inverse, -turn_y * per_pixel, (rise * cosine_y) * per_pixel);
    const N level = log(max(max(across, upward), one)) * N(0.7213475f);  // half the logarithm to base 2
    out.level = guard<N>(select(is_drop, level, out.level), for_lanes);
  }
  return out;
}
template <class N, class S, class T>
RAINREF_FN Window<N> drops_as_published(const PublishedDropsUniforms& d, const S& scene, const T& noise, const Vec3<N>& background,
                                        int column, int row) {
  const PublishedDrop<N> drop = published_drop<N>(d, noise, column, row);
  const auto is_drop = drop.layer > N(0.0f);
  if (!any(is_drop)) return {background, drop.layer};
  const bool is_sharp = d.gradient_level == 0 && d.level == 0;
  const Vec3<N> seen = is_sharp ? sharp_scene_at<N>(scene, drop.u, drop.v)
                                : scene_at<N>(scene, drop.u, drop.v, d.gradient_level != 0 ? drop.level : N(d.level));
  return {guard<N>(select(is_drop, seen, background), for_lanes), drop.layer * N(d.water_step)};
}

// ---- corrected -----------------------------------------------------------------------------------------------------
/// Water at a pixel: normal across the view (unit length unless mixed), coverage, mip level of the scene behind it.
template <class N>
struct Surface {
  N x, y, cover, level;
};
/// Position of a pixel with this centre in a layer [cell], and in the texture of flowing water.
template <class N>
RAINREF_FN Two<N> cell_place(const DropsUniforms& u, int layer, N px, N py) {
  return Two<N>{px * N(u.cells_per_pixel[layer]) + N(u.offset_x[layer]), py * N(u.cells_per_pixel[layer]) + N(u.offset_y[layer])};
}
template <class N>
RAINREF_FN Two<N> flow_place(const DropsUniforms& u, N px, N py) {
  return Two<N>{px * N(u.flow_pixel[0]), py * N(u.flow_pixel[1])};
}
/// The drops of the cells, finer layers below coarser ones, without those that a Wanted excludes. A cap of base radius R and contact angle
/// a is part of a sphere of radius R / sin a, so its normal at distance d from the axis leans by d sin a / R.
template <class N, class C>
RAINREF_FN Surface<N> still_drops(const DropsUniforms& u, const C& cells, int column, int row, Wanted wanted) {
  const N half(0.5f), one(1.0f), zero(0.0f);
  const N px = N::index(column) + half, py = N(static_cast<float>(row) + 0.5f);
  const Level<N> whole = uniform_level<N>(cells, 0);
  Surface<N> s{zero, zero, zero, zero};
  for (int l = layers - 1; l >= 0; --l) {
    if ((wanted >> l & 1) == 0) continue;
    const Two<N> place = cell_place(u, l, px, py);
    const N qx = place.a, qy = place.b;
    const N cx = floor(qx), cy = floor(qy), pixels(u.pixels_per_cell[l]);
    const auto drop = guard<N>(
        load_texel<0, 4, N>(cells, texel_column<N>(cells, whole, to_int(cx)), texel_row<N>(cells, whole, to_int(cy) + u.first_row[l])),
        "the cells cover the picture");
    const N dx = (qx - cx) - drop[0], dy = (qy - cy) - drop[1], radius = drop[2];
    // The share of the pixel that the base covers; reduced for a base smaller than a pixel.
    const N cover = saturate((radius - length(dx, dy)) * pixels + half) * min(N(2.0f) * radius * pixels, one);
    if (!any(cover > zero)) continue;
    const N lean = N(u.sine) / max(radius, N(1e-3f));
    s = {mix(s.x, dx * lean, cover), mix(s.y, dy * lean, cover), mix(s.cover, one, cover), mix(s.level, N(u.level[l]), cover)};
  }
  return s;
}
/// Flowing water over the drops: its slope, up along (x, y), by central differences of the height.
template <class N, class H>
RAINREF_FN Surface<N> with_flow(const DropsUniforms& u, const H& height, const Surface<N>& s, int column, int row) {
  const N one(1.0f);
  const Two<N> place = flow_place(u, N::index(column) + N(0.5f), N(static_cast<float>(row) + 0.5f));
  const N x = place.a, y = place.b, dx(u.flow_texel[0]), dy(u.flow_texel[1]);
  const N left = sample_bilinear<0, 1, N>(height, x - dx, y)[0], right = sample_bilinear<0, 1, N>(height, x + dx, y)[0];
  const N down = sample_bilinear<0, 1, N>(height, x, y - dy)[0], up = sample_bilinear<0, 1, N>(height, x, y + dy)[0];
  const N cover = smoothstep(u.visible_from, u.visible_to, N(0.25f) * sum_any_order(left, right, down, up));
  const N gx = (right - left) * N(u.flow_slope[0]), gy = (up - down) * N(u.flow_slope[1]);
  const N inverse = one / sqrt(sum_any_order(one, square(gx), square(gy)));
  return {mix(s.x, -gx * inverse, cover), mix(s.y, -gy * inverse, cover), mix(s.cover, one, cover), mix(s.level, N(u.flow_level), cover)};
}
/// The water at a pixel.
template <class N, class C, class H>
RAINREF_FN Surface<N> water_at(const DropsUniforms& u, const C& cells, const H& height, int column, int row, Wanted wanted = wanted_all) {
  const Surface<N> s = still_drops<N>(u, cells, column, row, wanted);
  return u.has_flow != 0 && (wanted & wanted_flow) != 0 ? with_flow(u, height, s, column, row) : s;
}
/// The view ray behind the water, and the share of light that the water's surface mirrors.
template <class N>
struct BentRay {
  Vec3<N> direction;
  N reflected;
};
// The view ray is refracted at the glass, which is perpendicular to the view, and at the water's surface, by Snell's law. The scene is far
// away, so only the direction matters. By Fresnel's reflectance of the surface, 1 beyond the critical angle, it mirrors the dimmed
// background.
/// px, py: a pixel's centre.
template <class N>
RAINREF_FN Vec3<N> view_ray(const DropsUniforms& u, N px, N py) {
  return normalize(Vec3<N>{px * N(u.pixel[0]) - N(u.half_size[0]), py * N(u.pixel[1]) - N(u.half_size[1]), N(1.0f)});
}
/// slope_x, slope_y: of the normal, as in Surface.
template <class N>
RAINREF_FN BentRay<N> bent_ray(const DropsUniforms& u, const Vec3<N>& ray, N slope_x, N slope_y) {
  const N one(1.0f), zero(0.0f);
  const Vec3<N> normal = normalize(Vec3<N>{slope_x, slope_y, sqrt(max(one - square(slope_x) - square(slope_y), N(0.04f)))});
  const Vec3<N> inside = guard<N>(refract(ray, Vec3<N>{zero, zero, N(-1.0f)}, 1.0f / u.water_ior), "the ray enters the denser medium");
  const Vec3<N> bent = refract(inside, N(-1.0f) * normal, u.water_ior);
  const N cosine =
      guard_below<N>(saturate(dot(bent, normal)), "a refracted ray leaves on the side of the normal; one that is reflected is 0");
  return {bent, fresnel_dielectric(cosine, u.water_ior)};
}
/// The colour of a wet pixel with this centre.
template <class N, class S>
RAINREF_FN Vec3<N> behind_water(const DropsUniforms& u, const S& scene, const Surface<N>& s, const Vec3<N>& background, N px, N py) {
  const N half(0.5f), one(1.0f);
  const Vec3<N> ray = view_ray(u, px, py);
  const Vec3<N> water = in_parts(s.x, s.y, [&](N x, N y) RAINREF_LAMBDA {
    const BentRay<N> bent = bent_ray(u, ray, x, y);
    const N ahead = one / max(bent.direction.z, N(0.05f));
    const Vec3<N> seen = scene_at<N>(scene, half + bent.direction.x * ahead * N(u.scene_scale[0]),
                                     half + bent.direction.y * ahead * N(u.scene_scale[1]), s.level);
    return mix(seen, N(u.inner) * background, bent.reflected);
  });
  return mix(background, water, s.cover);
}
template <class N, class S, class C, class H>
RAINREF_FN Window<N> drops_corrected(const DropsUniforms& u, const S& scene, const C& cells, const H& height, const Vec3<N>& background,
                                     int column, int row) {
  const N half(0.5f), zero(0.0f);
  const Surface<N> s = water_at<N>(u, cells, height, column, row);
  const auto wet = s.cover > zero;
  if (!any(wet)) return {background, zero};
  const Vec3<N> behind = behind_water(u, scene, s, background, N::index(column) + half, N(static_cast<float>(row) + 0.5f));
  return {guard<N>(select(wet, behind, background), for_lanes), s.cover};
}

template <class Scene, class Noise>
struct PublishedDropsTextures {
  Scene scene;
  Noise noise;
};
// clang before 17 does not deduce aggregates.
template <class Scene, class Noise>
PublishedDropsTextures(Scene, Noise) -> PublishedDropsTextures<Scene, Noise>;
struct PublishedDropsPassText {
  template <class Io>
  static RAINREF_FN auto views(const Io& io) {
    return PublishedDropsTextures{wrapped_scene(io.scene), io.noise.template fixed<Address::repeat, Address::repeat, 4>()};
  }
  template <class N, bool, class Io, class Textures>
  static RAINREF_FN void run(const PublishedDropsUniforms& u, const Io& io, const Textures& t, int column, int row) {
    const Window<N> w = drops_as_published<N>(u, t.scene, t.noise, io.background.rgb(), column, row);
    io.water(w.water);
    io.colour(w.colour, N(1.0f));
  }
};
struct DropsPassText {
  template <class N, bool, class Io>
  static RAINREF_FN void run(const DropsUniforms& u, const Io& io, int column, int row) {
    constexpr Address edge = Address::clamp;
    const Window<N> w = drops_corrected<N>(u, io.scene.template fixed<edge, edge, 4>(), io.cells.template fixed<edge, edge, 4>(),
                                           io.height.template fixed<edge, edge, 1>(), io.background.rgb(), column, row);
    io.water(w.water);
    io.colour(w.colour, N(1.0f));
  }
};
#endif
