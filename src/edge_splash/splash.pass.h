// Pass splash: masks of edge, angle and noise, and the scene with drops blended over it.
#ifndef RAINREF_FN
#ifndef RAINREF_EDGE_SPLASH_SPLASH_PASS_H_
#define RAINREF_EDGE_SPLASH_SPLASH_PASS_H_
#include "edge_splash/uniforms.h"
#include "pass/definition.h"
#include "scene/uniform_block.h"

namespace rainref::edge_splash {

inline constexpr std::string_view splash_sentence = "Masks of edge, angle and noise, and the scene with drops blended over it.";
template <class B>
struct SplashResults {
  using Mask = typename B::template Result<Format::r8>;
  static constexpr pass::Out edge{.name = "edge", .sentence = "1 at an edge of the depth."},
      angle{.name = "angle", .sentence = "1 where the edge faces up."}, noise{.name = "noise", .sentence = "1 where a drop is."},
      colour{.name = "colour",
             .sentence = "Linear radiance with drops, and the scene's alpha.",
             .colour_space = "linear Rec. 709",
             .alpha = "straight"},
      published_colour{.name = "colour",
                       .sentence = "Linear radiance with drops; alpha is blended like a colour.",
                       .colour_space = "linear Rec. 709",
                       .alpha = "straight",
                       .format_key = "edge_splash.storage"};
};

/// As published. A read outside the depth or the noise is 0.
struct PublishedSplashPass : pass::Takes<PublishedSplashUniforms> {
  static constexpr pass::About about{"splash", splash_sentence, {1}, {}, {"sobel", "length"}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::drop_color>("1", scene::radiance, "Linear RGB and opacity of the drops."),
                  member<&U::width>("texel", {1, 65536}, "Columns of the picture."),
                  member<&U::height>("texel", {1, 65536}, "Rows of the picture."),
                  member<&U::noise_width>("texel", {2, 65536}, "Columns of the noise map."),
                  member<&U::noise_height>("texel", {2, 65536}, "Rows of the noise map."),
                  member<&U::edge_threshold>("1", scene::share, "Sobel sum of device depths that counts as an edge."),
                  member<&U::rain_drop_scale>("1", scene::share, "Threshold of the noise."),
                  member<&U::time>("s", scene::frame_time, "Frame number over frame rate, rounded once."),
                  member<&U::drop_speed>("texel/s", {-1e6, 1e6}, "Speed of the noise in x and in y."),
                  member<&U::thickness>("texel", {0, 20}, "Distance of the taps where the depth is 1.")});
  }
  template <class B>
  struct Io {
    using R = SplashResults<B>;
    typename B::template Texels<Format::rgba16f> scene = pass::In{.name = "scene"};
    typename B::Sampled depth = pass::In{.name = "depth", .same_size = true};
    typename B::Sampled noise_map = pass::In{.name = "noise_map"};
    typename R::Mask edge = R::edge, angle = R::angle, noise = R::noise;
    typename B::template Result<Format::rgba16f, Format::rgba8> colour = R::published_colour;
  };
};
struct SplashPass : pass::Takes<SplashUniforms> {
  static constexpr pass::About about{"splash", splash_sentence, {}, {1}, {"sobel", "length"}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::drop_color>("1", scene::radiance, "Linear RGB and opacity of the drops."),
                  member<&U::up>("1", scene::component, "Unit vector that points up, camera axes: right, up, forward."),
                  member<&U::reach>("texel", {0, 1e9}, "Texels that the band covers at 1 m."),
                  member<&U::pixel>("1", {0, 1e6}, "Extent of a pixel on the image plane at distance 1."),
                  member<&U::half_size>("1", {0, 1e6}, "Half the extent of the image plane at distance 1."),
                  member<&U::depth_scale>("1/m", {-1e4, 1e4}, "1 / z = depth_scale d + depth_bias."),
                  member<&U::depth_bias>("1/m", {0, 1e4}, "See depth_scale."),
                  member<&U::reach_min>("texel", scene::whole(1, 4096), "Smallest reach of the taps."),
                  member<&U::reach_max>("texel", scene::whole(1, 4096), "Largest reach of the taps; whole."),
                  member<&U::step_low>("m", {0, 1e5}, "Sobel sum of distances at which an edge begins."),
                  member<&U::step_high>("m", {0, 1e5}, "Sobel sum from which it is whole."),
                  member<&U::bend_low>("1", {0, 11}, "Bend at which an edge begins."),
                  member<&U::bend_high>("1", {0, 11}, "Bend from which it is whole."),
                  member<&U::cosine_low>("1", {0, 11}, "Cosine between an edge's normal and up at which the mask begins."),
                  member<&U::cosine_high>("1", {0, 11}, "Cosine from which it is whole."),
                  member<&U::noise_low>("1", {0, 11}, "Noise at which a drop begins."),
                  member<&U::noise_high>("1", {0, 11}, "Noise from which it is whole."),
                  member<&U::noise_scale>("1", {0, 1e7}, "Texture coordinates of the noise in a pixel."),
                  member<&U::noise_offset>("1", scene::share, "Texture coordinates that the noise has scrolled, in [0, 1).")});
  }
  template <class B>
  struct Io {
    using R = SplashResults<B>;
    typename B::template Texels<Format::rgba16f> scene = pass::In{.name = "scene"};
    typename B::Sampled depth = pass::In{.name = "depth", .same_size = true};
    typename B::Sampled noise_map = pass::In{.name = "noise_map", .filter = Filter::linear};
    typename B::template Texels<Format::r8> layer = pass::In{.name = "layer"};
    typename R::Mask edge = R::edge, angle = R::angle, noise = R::noise;
    typename B::template Result<Format::rgba16f> colour = R::colour;
  };
};

}  // namespace rainref::edge_splash
#endif
#else

template <class N>
struct Splash {
  N edge, angle, noise;
  Channels<N, 4> colour;
  RAINREF_FN Splash() {}
};
template <class N, class M>
RAINREF_FN N one_where(M mask) {
  return select(mask, N(1.0f), N(0.0f));
}

// ---- as published --------------------------------------------------------------------------------------------------
/// Truncates a float to an integer, as HLSL does.
template <class N>
RAINREF_FN N truncated(N x) {
  return select(x < N(0.0f), -floor(-x), floor(x));
}
/// x - size trunc(x / size), the remainder of % for floats: in (-size, size), with the sign of x.
template <class N>
RAINREF_FN N remainder_of(N x, float size) {
  const N rest = x - N(size) * truncated(x / N(size)), zero(0.0f), whole(size);
  // The quotient may be rounded up to the next integer; the remainder would then have the other sign.
  const N risen = select((x >= zero) & (rest < zero), rest + whole, rest);
  return select((x < zero) & (rest > zero), rest - whole, risen);
}
template <class N>
struct Gradient {
  N x, y;
};
/// The sums of the tap pattern exactly as printed: p0 is p6, p1 does not shrink with distance, all rows are one offset too low.
template <class N, class T>
RAINREF_FN Gradient<N> gradient_as_published(const PublishedSplashUniforms& u, const T& depth, N x, N y) {
  const N thickness(static_cast<float>(u.thickness)), two(2.0f);
  const N centre = texel_at<N>(depth, x, y), shift = thickness * (centre * centre);
  const N sobel_y = truncated(y - shift);
  const N left = truncated(x - shift), right = truncated(x + shift), low = truncated(sobel_y - shift), high = truncated(sobel_y + shift);
  const N p0 = texel_at<N>(depth, left, high), p1 = texel_at<N>(depth, x, sobel_y - thickness), p2 = texel_at<N>(depth, right, low);
  const N p3 = texel_at<N>(depth, left, sobel_y), p5 = texel_at<N>(depth, right, sobel_y);
  const N p6 = texel_at<N>(depth, left, high), p7 = texel_at<N>(depth, x, high), p8 = texel_at<N>(depth, right, high);
  return {((((-p0 - p3 * two) - p6) + p2) + p5 * two) + p8, ((((-p0 - p1 * two) - p2) + p6) + p7 * two) + p8};
}
/// Masks are 0 or 1. Only these two functions decide anything.
template <class N>
struct EdgeMasks {
  N edge, angle;
};
template <class N, class T>
RAINREF_FN EdgeMasks<N> edge_masks(const PublishedSplashUniforms& u, const T& depth, N x, N y) {
  const Gradient<N> g = gradient_as_published(u, depth, x, y);
  return {one_where<N>(length(g.x, g.y) >= N(u.edge_threshold)), one_where<N>(is_at_most_half_turn(g.y, g.x))};
}
template <class N, class T>
RAINREF_FN N noise_mask(const PublishedSplashUniforms& u, const T& noise_map, N x, N y) {
  const N scrolled = N(u.time) * N(u.drop_speed);
  const N column = truncated(remainder_of(x + scrolled, static_cast<float>(u.noise_width)));
  const N row = truncated(remainder_of(y + scrolled, static_cast<float>(u.noise_height)));
  return one_where<N>(texel_at<N>(noise_map, column, row) >= N(u.rain_drop_scale));
}
template <class N>
RAINREF_FN Splash<N> blend_as_published(const PublishedSplashUniforms& u, const EdgeMasks<N>& masks, N noise, const Channels<N, 4>& scene,
                                        N x, N y) {
  const N zero(0.0f), thickness(static_cast<float>(u.thickness)), width(static_cast<float>(u.width)), height(static_cast<float>(u.height));
  const auto passed = (x + thickness >= width) | (y + thickness >= height) | (x - thickness < zero) | (y - thickness < zero);
  // The edge is multiplied by the angle twice, which does not matter for a mask of zeros and ones.
  const N weight = (((masks.edge * masks.angle) * masks.angle) * noise) * N(u.drop_color[3]);
  Splash<N> out;
  out.edge = select(passed, zero, masks.edge);
  out.angle = select(passed, zero, masks.angle);
  out.noise = select(passed, zero, noise);
  // The target ARGB32 cannot hold values outside [0, 1]; in a target of halves the pass clamps.
  for (int k = 0; k < 4; ++k)
    out.colour[k] = guard_below<N>(saturate(select(passed, scene[k], mix(scene[k], N(u.drop_color[k]), weight))), "no colour is negative");
  return out;
}
/// A read outside the depth or the noise is 0.
template <class N, class T>
RAINREF_FN Splash<N> splash_as_published(const PublishedSplashUniforms& u, const T& depth, const T& noise_map, const Channels<N, 4>& scene,
                                         int column, int row) {
  const N x = N::index(column), y(static_cast<float>(row));
  return blend_as_published(u, edge_masks(u, depth, x, y), noise_mask(u, noise_map, x, y), scene, x, y);
}

// ---- corrected -----------------------------------------------------------------------------------------------------
// From the distances z around the pixel, with r = the band in pixels, clamped to [reach_min, reach_max]:
//   g     = Sobel's sums of z over taps r apart: x to the right, y up
//   edge  = |g| large  and  bend large,  bend = max(|q(up) + q(down) - 2 q|, |q(left) + q(right) - 2 q|) / q(nearest), q = 1 / z
//   angle = cosine of g against up as the picture shows it here
// For a plane q is affine over the picture, so a plane has no bend however steeply it recedes. At a step from zn to zf the bend is 1 - zn /
// zf.
template <class N>
struct Taps {
  N q[9];  ///< left to right, then bottom to top: [4] is the pixel
  RAINREF_FN Taps() {}
};
template <class N, class T>
RAINREF_FN N inverse_distance(const SplashUniforms& u, const T& depth, N x, N y) {
  return texel_at<N>(depth, x, y) * N(u.depth_scale) + N(u.depth_bias);
}
/// The reach for a distance, in whole texels.
template <class N>
RAINREF_FN N reach_of(const SplashUniforms& u, N q) {
  return floor(clamp(N(u.reach) * q, N(u.reach_min), N(u.reach_max)) + N(0.5f));
}

/// Sobel's sums: the kernels (-1 0 1, -2 0 2, -1 0 1) and its transpose.
template <class N>
RAINREF_FN Gradient<N> sobel(const Taps<N>& t) {
  const auto z = [&](int k) RAINREF_LAMBDA { return N(1.0f) / t.q[k]; };
  const N z0 = z(0), z1 = z(1), z2 = z(2), z3 = z(3), z5 = z(5), z6 = z(6), z7 = z(7), z8 = z(8);
  const N two(2.0f);
  return {sum_any_order(z2 - z0, two * (z5 - z3), z8 - z6), sum_any_order(z6 - z0, two * (z7 - z1), z8 - z2)};
}
template <class N>
RAINREF_FN N bend_of(const Taps<N>& t) {
  const N twice = N(2.0f) * t.q[4], across = abs((t.q[3] + t.q[5]) - twice), along = abs((t.q[1] + t.q[7]) - twice);
  const N nearest = max(max(max(max(t.q[4], t.q[1]), t.q[3]), t.q[5]), t.q[7]);
  return max(across, along) / nearest;
}

template <class N, class T>
RAINREF_FN Taps<N> taps_corrected(const SplashUniforms& u, const T& depth, N x, N y) {
  // The nearest surface that the band may belong to; it determines the width of the band.
  const N far(u.reach_max);
  const N q = inverse_distance(u, depth, x, y);
  const N beside = max(inverse_distance(u, depth, x - far, y), inverse_distance(u, depth, x + far, y));
  const N around = max(inverse_distance(u, depth, x, y - far), inverse_distance(u, depth, x, y + far));
  const N reach = reach_of(u, max(q, max(beside, around)));
  const N left = x - reach, right = x + reach, low = y - reach, high = y + reach;
  Taps<N> taps;
  taps.q[0] = inverse_distance(u, depth, left, low);
  taps.q[1] = inverse_distance(u, depth, x, low);
  taps.q[2] = inverse_distance(u, depth, right, low);
  taps.q[3] = inverse_distance(u, depth, left, y);
  taps.q[5] = inverse_distance(u, depth, right, y);
  taps.q[6] = inverse_distance(u, depth, left, high);
  taps.q[7] = inverse_distance(u, depth, x, high);
  taps.q[8] = inverse_distance(u, depth, right, high);
  taps.q[4] = q;
  return taps;
}
template <class N, class T, class R>
RAINREF_FN Splash<N> splash_corrected(const SplashUniforms& u, const T& depth, const R& noise_map, N layer, const Channels<N, 4>& scene,
                                      int column, int row) {
  const N x = N::index(column), y(static_cast<float>(row)), half(0.5f);
  const Taps<N> taps = taps_corrected(u, depth, x, y);
  const Gradient<N> g = sobel(taps);
  const N magnitude = length(g.x, g.y);
  const N edge = smoothstep(u.step_low, u.step_high, magnitude) * smoothstep(u.bend_low, u.bend_high, bend_of(taps));

  // The vertical through this pixel in the picture: the direction in which (X, Y) moves if the point moves up.
  const N plane_x = (x + half) * N(u.pixel[0]) - N(u.half_size[0]), plane_y = (y + half) * N(u.pixel[1]) - N(u.half_size[1]);
  const N up_x = N(u.up[0]) - plane_x * N(u.up[2]), up_y = N(u.up[1]) - plane_y * N(u.up[2]);
  const N facing = ((g.x * up_x + g.y * up_y) / max(magnitude, N(u.step_low))) / max(length(up_x, up_y), N(1e-4f));
  const N angle = smoothstep(u.cosine_low, u.cosine_high, facing);

  const N s = guard_below<N>(sample_bilinear<0, 1, N>(noise_map, (x + half) * N(u.noise_scale[0]) + N(u.noise_offset[0]),
                                                      (y + half) * N(u.noise_scale[1]) + N(u.noise_offset[1])),
                             "the offset of the tile lies between 0 and 1")[0];
  const N noise = smoothstep(u.noise_low, u.noise_high, s);

  const N weight = ((edge * angle) * noise) * (layer * N(u.drop_color[3]));
  Splash<N> out;
  out.edge = edge;
  out.angle = angle;
  out.noise = noise;
  for (int k = 0; k < 3; ++k) out.colour[k] = mix(scene[k], N(u.drop_color[k]), weight);
  out.colour[3] = scene[3];
  return out;
}

template <class N, class Io>
RAINREF_FN Channels<N, 4> scene_of(const Io& io) {
  N in[4];
  io.scene.load(in);
  Channels<N, 4> out;
  for (int k = 0; k < 4; ++k) out[k] = in[k];
  return out;
}
template <class N, class Io>
RAINREF_FN void give(const Io& io, const Splash<N>& s) {
  io.edge(s.edge);
  io.angle(s.angle);
  io.noise(s.noise);
  io.colour(Vec3<N>(s.colour[0], s.colour[1], s.colour[2]), s.colour[3]);
}
template <class Depth, class Noise>
struct SplashTextures {
  Depth depth;
  Noise noise_map;
};
// clang before 17 does not deduce aggregates.
template <class Depth, class Noise>
SplashTextures(Depth, Noise) -> SplashTextures<Depth, Noise>;
struct PublishedSplashPassText {
  template <class Io>
  static RAINREF_FN auto views(const Io& io) {
    constexpr Address none = Address::border;
    return SplashTextures{io.depth.template fixed<none, none, 1>(), io.noise_map.template fixed<none, none, 1>()};
  }
  template <class N, bool, class Io, class Textures>
  static RAINREF_FN void run(const PublishedSplashUniforms& u, const Io& io, const Textures& t, int x, int y) {
    give(io, splash_as_published<N>(u, t.depth, t.noise_map, scene_of<N>(io), x, y));
  }
};
struct SplashPassText {
  template <class Io>
  static RAINREF_FN auto views(const Io& io) {
    constexpr Address edge = Address::clamp, tile = Address::repeat;
    return SplashTextures{io.depth.template fixed<edge, edge, 1>(), io.noise_map.template fixed<tile, tile, 1>()};
  }
  template <class N, bool, class Io, class Textures>
  static RAINREF_FN void run(const SplashUniforms& u, const Io& io, const Textures& t, int x, int y) {
    give(io, splash_corrected<N>(u, t.depth, t.noise_map, io.layer(), scene_of<N>(io), x, y));
  }
};
#endif
