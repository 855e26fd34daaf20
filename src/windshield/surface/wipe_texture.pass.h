// Pass wipe_texture: removes water under the blades from the height texture, and updates the mask of freshly wiped glass.
//
// It has no decisions: coverage falls from 1 to 0 over edge_width at the blade's edge, and the distances that determine it are continuous.
#ifndef RAINREF_FN
#ifndef RAINREF_WINDSHIELD_WIPE_TEXTURE_PASS_H_
#define RAINREF_WINDSHIELD_WIPE_TEXTURE_PASS_H_
#include "pass/definition.h"
#include "scene/uniform_block.h"
#include "windshield/uniforms.h"

namespace rainref::windshield {

struct WipeTextureUniforms {
  float frame[3], edge_width;
  float axis_length[2], strength, keep;
  float dt, inverse_tau, wiped_limit;
  std::int32_t wiper_count;
};
static_assert(sizeof(WipeTextureUniforms) == 48);

/// In place. Its lanes skip wipers that cannot reach them: see kernels.cpp.
struct WipeTexturePass : pass::Takes<WipeTextureUniforms> {
  static constexpr pass::About about{
      "wipe_texture", "What the blades take off the height, and the mask of freshly wiped glass.", {1}, {1}, {"dot", "length"}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::frame>("m/texel", {-1e4, 1e4}, "Plane coordinates of a step: x of a column, x and y of a row."),
                  member<&U::edge_width>("m", {0, 1e4}, "Width over which coverage falls at a blade's edge."),
                  member<&U::axis_length>("m", {0, 1e4}, "as-published: lengths of the axes u and v."),
                  member<&U::strength>("mm", {0, 1000}, "as-published: what full coverage takes off the height."),
                  member<&U::keep>("1", scene::share, "as-published: share of the mask that a frame leaves."),
                  member<&U::dt>("s", {0, 1}, "corrected: time since the frame before, so rounded that sums are exact."),
                  member<&U::inverse_tau>("1/s", {0, 100}, "corrected: 1 over the time constant of the mask."),
                  member<&U::wiped_limit>("s", {0, 1 << 15}, "corrected: the time since a wipe grows to this and no further."),
                  member<&U::wiper_count>("1", {0, 65536}, "Wipers in the list.")});
  }
  template <class B>
  struct Io {
    typename B::template Texels<Format::r16f> height = pass::In{.name = "height", .from = "splat"};  // [mm]
    typename B::template Texels<Format::r16f> mask =
        pass::In{.name = "mask", .from = "wipe_texture", .previous = true, .variant = "as-published"};
    typename B::template Texels<Format::r32f> wiped =
        pass::In{.name = "wiped", .from = "wipe_texture", .previous = true, .variant = "corrected"};
    typename B::template Records<Wiper> wipers = pass::In{.name = "wipers", .count = "wiper_count"};
    typename B::template Result<Format::r16f> new_height = pass::Out{.name = "height"};
    typename B::template Result<Format::r16f> new_mask = pass::Out{.name = "mask", .sentence = "Freshly wiped glass: 1, and falling."};
    typename B::template Result<Format::r32f> new_wiped =
        pass::Out{.name = "wiped",
                  .sentence = "Time since the last wipe, to about 32 time constants of the mask.",
                  .unit = "s",
                  .range = {0, 16384},
                  .variant = "corrected"};
  };
};

}  // namespace rainref::windshield
#endif
#else

template <class N>
RAINREF_FN N coverage_at(N distance, N half_width, N edge_width) {
  return saturate(N(0.5f) + (half_width - distance) / edge_width);
}

/// Distance from p to the segment from a to b, all in metres.
template <class N>
RAINREF_FN N segment_distance(N px, N py, N ax, N ay, N bx, N by) {
  const N along_x = bx - ax, along_y = by - ay, from_x = px - ax, from_y = py - ay;
  const N length_sq = guard<N>(max(square(along_x) + square(along_y), N(1e-12f)), "a blade has a length");
  const N t = saturate((from_x * along_x + from_y * along_y) / length_sq);
  return length(from_x - t * along_x, from_y - t * along_y);
}

/// Plane coordinates of a texel's centre [m].
template <class N>
struct PlanePoint {
  N x, y;
  RAINREF_FN PlanePoint(N x_, N y_) : x(x_), y(y_) {}
};
template <class N, class Uniforms>
RAINREF_FN PlanePoint<N> texel_in_plane(const Uniforms& u, int x, int y) {
  const N column = N::index(x) + N(0.5f), row(static_cast<float>(y) + 0.5f);
  return PlanePoint<N>(N(u.frame[0]) * column + N(u.frame[1]) * row, N(u.frame[2]) * row);
}

// ---- as published --------------------------------------------------------------------------------------------------
//   coverage: capsule around the blade at its current position
//   height = max(0, height - strength coverage),   mask = max(mask keep, coverage), in the mask's own format
template <class N>
RAINREF_FN N wipe_coverage_as_published(const WipeTextureUniforms& u, const Wiper* wipers, int x, int y) {
  const PlanePoint<N> p = texel_in_plane<N>(u, x, y);
  N coverage(0.0f);
  for (int i = 0; i < u.wiper_count; ++i) {
    const Wiper& w = wipers[i];
    const N sx(u.axis_length[0]), sy(u.axis_length[1]);
    const N distance = segment_distance(p.x, p.y, N(w.inner[0]) * sx, N(w.inner[1]) * sy, N(w.outer[0]) * sx, N(w.outer[1]) * sy);
    coverage = max(coverage, coverage_at(distance, N(w.half_width), N(u.edge_width)));
  }
  return coverage;
}
template <class N>
RAINREF_FN N wiped_height_as_published(const WipeTextureUniforms& u, N height, N coverage) {
  return max(height - N(u.strength) * coverage, N(0.0f));
}
template <class N>
RAINREF_FN N wiped_mask_as_published(const WipeTextureUniforms& u, N mask, N coverage) {
  return max(mask * N(u.keep), coverage);
}

// ---- corrected -----------------------------------------------------------------------------------------------------
//   coverage: annular sector from the blade's previous position to the current one, half_width wider all around
//   height = height (1 - coverage),   wiped = min(wiped + dt, limit) (1 - coverage),   mask = exp(-wiped / tau)
//
// The distance to the sector, which is less than half a turn, is the smallest of three: to the previous blade, to the current blade, and
// within the sector's angle |r - radii|. Outside that angle the third is made larger than the others. A point at distance s beside the ray
// of the nearer blade is at most |r - radii| + 2 s from the sector. A point behind the pivot is at most |r - radii| + 2 r from it; there s
// plus its distance behind, along the sum of the axes, is more than r.
template <class N>
RAINREF_FN N sector_distance(const Wiper& w, N px, N py, N before, N now) {
  const N cx0(w.previous_axis[0]), cy0(w.previous_axis[1]), cx1(w.axis[0]), cy1(w.axis[1]), inner(w.inner_radius), outer(w.outer_radius);
  const float turn = w.direction < 0 ? -1.0f : 1.0f;
  const N beside = max(max(N(turn) * (px * cy0 - py * cx0), N(turn) * (py * cx1 - px * cy1)), N(0.0f));
  const N behind = max(-(px * (cx0 + cx1) + py * (cy0 + cy1)), N(0.0f));
  const N r = length(px, py);
  const N between = max(max(inner - r, r - outer), N(0.0f)) + N(2.0f) * (beside + behind);
  return min(min(before, now), between);
}
template <class N>
RAINREF_FN N sector_distance(const Wiper& w, N x, N y) {
  const N px = x - N(w.pivot[0]), py = y - N(w.pivot[1]);
  const N cx0(w.previous_axis[0]), cy0(w.previous_axis[1]), cx1(w.axis[0]), cy1(w.axis[1]), inner(w.inner_radius), outer(w.outer_radius);
  const N before = segment_distance(px, py, inner * cx0, inner * cy0, outer * cx0, outer * cy0);
  const N now = segment_distance(px, py, inner * cx1, inner * cy1, outer * cx1, outer * cy1);
  return sector_distance(w, px, py, before, now);
}
template <class N>
RAINREF_FN N wipe_coverage_corrected(const WipeTextureUniforms& u, const Wiper* wipers, int x, int y) {
  const PlanePoint<N> p = texel_in_plane<N>(u, x, y);
  N coverage(0.0f);
  for (int i = 0; i < u.wiper_count; ++i) {
    const Wiper& w = wipers[i];
    coverage = max(coverage, coverage_at(sector_distance(w, p.x, p.y), N(w.half_width), N(u.edge_width)));
  }
  return coverage;
}
template <class N>
RAINREF_FN N wiped_height_corrected(N height, N coverage) {
  return height * (N(1.0f) - coverage);
}
template <class N>
RAINREF_FN N time_since_wipe(const WipeTextureUniforms& u, N wiped, N coverage) {
  return min(wiped + N(u.dt), N(u.wiped_limit)) * (N(1.0f) - coverage);
}
template <class N>
RAINREF_FN N wiped_mask_corrected(const WipeTextureUniforms& u, N wiped) {
  return exp(-(wiped * N(u.inverse_tau)));
}

struct WipeTexturePassText {
  template <class N, bool corrected, class Io>
  static RAINREF_FN void run(const WipeTextureUniforms& u, const Io& io, int x, int y) {
    if constexpr (corrected) {
      const N coverage = wipe_coverage_corrected<N>(u, io.wipers.data(), x, y);
      const N since = time_since_wipe(u, io.wiped(), coverage);
      io.new_height(wiped_height_corrected(io.height(), coverage));
      io.new_mask(wiped_mask_corrected(u, since));
      io.new_wiped(since);
    } else {
      const N coverage = wipe_coverage_as_published<N>(u, io.wipers.data(), x, y);
      io.new_height(wiped_height_as_published(u, io.height(), coverage));
      io.new_mask(wiped_mask_as_published(u, io.mask(), coverage));
    }
  }
};
#endif
