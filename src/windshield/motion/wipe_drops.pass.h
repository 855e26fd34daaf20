// Pass wipe_drops: the effect of the blades on drops, and on the film that they sweep. Geometry is in plane coordinates [m]. Needs
// drops/drop-inl.h.
#ifndef RAINREF_FN
#ifndef RAINREF_WINDSHIELD_WIPE_DROPS_PASS_H_
#define RAINREF_WINDSHIELD_WIPE_DROPS_PASS_H_
#include <cmath>
#include <cstring>
#include <span>
#include <string>

#include <fmt/format.h>

#include "drops/records.h"
#include "pass/definition.h"
#include "scene/uniform_block.h"
#include "windshield/motion/uniforms.h"
#include "windshield/uniforms.h"

namespace rainref::windshield {

/// Treats each drop separately and, corrected, each texel of the film. wipe_drops.h describes which drop gets the water of the texels. The
/// film's lanes are written by hand.
struct WipeDropsPass : pass::Takes<WipeDropsUniforms> {
  static constexpr pass::About about{"wipe_drops",
                                     "Drops in the swept area ride on the blade; corrected: with the film that it sweeps.",
                                     {1, capture::Judge::keyed},
                                     {1, capture::Judge::keyed},
                                     {"length"}};
  using Record = drops::Drop;
  static scene::UniformBlock uniforms() {
    return block({member<&U::frame>("m", {-1e4, 1e4}, "x = f0 u + f1 v, y = f2 v: plane coordinates of glass coordinates."),
                  member<&U::follow>("1", scene::share, "as-published: share of the way to the leading edge that a captured drop makes."),
                  member<&U::inverse_frame>("1/m", {-1e9, 1e9}, "u = i0 x + i1 y, v = i2 y."),
                  member<&U::inherit>("1", scene::share, "as-published: share of the blade's velocity that a captured drop takes over."),
                  member<&U::gain>("1", {0, 100}, "as-published: mass that a captured drop gains."),
                  member<&U::radius_scale>("m", scene::share, "corrected: base radius of a drop of one mass unit."),
                  member<&U::wiper_count>("1", {0, 65536}, "Records in the list of wipers."),
                  member<&U::bin_count>("1", {0, 4096}, "corrected: radial bins that share out the film."),
                  member<&U::texel>("1", scene::share, "corrected: 1 over the film's columns and rows."),
                  member<&U::columns>("texel", {0, 65536}, "corrected: columns of the film."),
                  member<&U::rows>("texel", {0, 65536}, "corrected: rows of the film.")});
  }
  /// The records that are used.
  template <class Inputs>
  static std::span<const Wiper> wipers(const Inputs& m) {
    return std::span(m.captured.wipers.records).first(static_cast<std::size_t>(m.uniforms.wiper_count));
  }
  template <class Inputs>
  static std::string fault(const Inputs& m) {
    const WipeDropsUniforms& u = m.uniforms;
    for (const Wiper& w : wipers(m)) {
      float numbers[sizeof(Wiper) / sizeof(float)];
      std::memcpy(numbers, &w, sizeof numbers);
      for (const float x : numbers)
        if (!std::isfinite(x)) return fmt::format("in.wipers: expected finite numbers, found {}", x);
    }
    if (!m.corrected || (u.columns == m.width && u.rows == m.height && u.bin_count >= 1 && u.bin_count <= 4096)) return "";
    return fmt::format("uniforms columns, rows, bin_count: expected {}, {} and 1 to 4096, found {}, {} and {}", m.width, m.height,
                       u.columns, u.rows, u.bin_count);
  }
  template <class B>
  struct Io {
    typename B::template Changed<drops::Drop> drops = {pass::In{.name = "drops", .from = "integrate"}, pass::Out{.name = "drops"}};
    typename B::template Records<Wiper> wipers = pass::In{.name = "wipers", .count = "wiper_count"};
    typename B::template Texels<Format::r32f> film = pass::In{.name = "film", .from = "merge", .previous = true, .variant = "corrected"};
    typename B::template Result<Format::r32f> new_film = pass::Out{.name = "film", .variant = "corrected"};
  };
};

}  // namespace rainref::windshield
#endif
#else

template <class N>
struct Plane {
  N x, y;
};
template <class N>
RAINREF_FN Plane<N> to_plane(const float* frame, N u, N v) {
  return {N(frame[0]) * u + N(frame[1]) * v, N(frame[2]) * v};
}
template <class N>
RAINREF_FN Plane<N> to_glass(const float* inverse, N x, N y) {
  return {N(inverse[0]) * x + N(inverse[1]) * y, N(inverse[2]) * y};
}

/// A drop as the pass returns it.
template <class N>
struct WipedDrop : DropState<N> {
  N wiper;  ///< index of the last record that captured it; -1: none, -2: it is thrown off
  N bin;    ///< its radial bin there
  RAINREF_FN WipedDrop() {}
  RAINREF_FN explicit WipedDrop(const DropState<N>& d) : DropState<N>(d), wiper(-1.0f), bin(-1.0f) {}
};

/// Whether p lies within the half width of the blade with this axis. (rx, ry) = p - pivot.
template <class N>
RAINREF_FN typename N::Mask under_blade(const Wiper& w, const float* axis, N rx, N ry) {
  const N ax(axis[0]), ay(axis[1]);
  const N along = clamp(rx * ax + ry * ay, N(w.inner_radius), N(w.outer_radius));
  return square(rx - along * ax) + square(ry - along * ay) <= square(N(w.half_width));
}

// ---- as published --------------------------------------------------------------------------------------------------
// The swept area is the quad between the previous and the current segment, a chord of the sector (physics: W10), or the points within
// half_width of the current segment. A captured drop moves by `follow` toward the leading edge and takes `inherit` of the blade's velocity
// there, so that it lags behind: the bow wave. A blade at rest captures nothing; the source does not define this.
/// Whether (x, y) is left of the line from a to b, for a blade that turns counter-clockwise; else right of it.
template <class N>
RAINREF_FN typename N::Mask inward(const Wiper& w, const Plane<N>& a, const Plane<N>& b, N x, N y) {
  return N(w.direction) * ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) >= N(0.0f);
}
template <class N>
RAINREF_FN typename N::Mask in_quad(const WipeDropsUniforms& uniforms, const Wiper& w, N x, N y) {
  const Plane<N> a = to_plane(uniforms.frame, N(w.previous_inner[0]), N(w.previous_inner[1]));
  const Plane<N> b = to_plane(uniforms.frame, N(w.previous_outer[0]), N(w.previous_outer[1]));
  const Plane<N> c = to_plane(uniforms.frame, N(w.outer[0]), N(w.outer[1])), d = to_plane(uniforms.frame, N(w.inner[0]), N(w.inner[1]));
  return inward(w, a, b, x, y) & inward(w, b, c, x, y) & inward(w, c, d, x, y) & inward(w, d, a, x, y);
}
template <class N>
RAINREF_FN DropState<N> wipe_drop_as_published(const WipeDropsUniforms& uniforms, const Wiper* wipers, const DropState<N>& in) {
  DropState<N> d = in;
  const auto live = in.life > N(0.0f);
  for (int i = 0; i < uniforms.wiper_count; ++i) {
    const Wiper& w = wipers[i];
    if (w.direction == 0.0f) continue;
    const Plane<N> p = to_plane(uniforms.frame, d.u, d.v);
    const N rx = p.x - N(w.pivot[0]), ry = p.y - N(w.pivot[1]);
    const auto captured = live & (in_quad(uniforms, w, p.x, p.y) | under_blade(w, w.axis, rx, ry));
    // Relative to the pivot: the nearest point of the blade, and half_width ahead of it.
    const N ax(w.axis[0]), ay(w.axis[1]), lead(w.half_width * w.direction);
    const N along = clamp(rx * ax + ry * ay, N(w.inner_radius), N(w.outer_radius));
    const N tx = along * ax - lead * ay, ty = along * ay + lead * ax;
    const Plane<N> target = to_glass(uniforms.inverse_frame, N(w.pivot[0]) + tx, N(w.pivot[1]) + ty);
    const Plane<N> velocity = to_glass(uniforms.inverse_frame, -(N(w.rate) * ty), N(w.rate) * tx);
    d.u = select(captured, mix(d.u, target.x, N(uniforms.follow)), d.u);
    d.v = select(captured, mix(d.v, target.y, N(uniforms.follow)), d.v);
    d.velocity_u = select(captured, mix(d.velocity_u, velocity.x, N(uniforms.inherit)), d.velocity_u);
    d.velocity_v = select(captured, mix(d.velocity_v, velocity.y, N(uniforms.inherit)), d.velocity_v);
    d.mass = select(captured, d.mass + N(uniforms.gain), d.mass);
  }
  return d;
}

// ---- corrected -----------------------------------------------------------------------------------------------------
// A blade sweeps everything that its capsule touches between its two angles: the annular sector widened by half_width at both radii, and
// the capsule at both ends. A captured drop keeps its distance from the pivot and is put ahead of the leading edge so that it just touches
// it: its centre is half_width + its own base radius from the blade's line. It moves with the blade.
template <class N>
RAINREF_FN typename N::Mask in_sweep(const Wiper& w, N x, N y) {
  const N rx = x - N(w.pivot[0]), ry = y - N(w.pivot[1]), zero(0.0f), turning(w.direction), half_width(w.half_width);
  // Counter-clockwise of the first axis, clockwise of the last, and on their side of the pivot: the sector is less than a half turn.
  const N past_first = turning * (N(w.previous_axis[0]) * ry - N(w.previous_axis[1]) * rx);
  const N past_last = turning * (N(w.axis[0]) * ry - N(w.axis[1]) * rx);
  const N side = (N(w.previous_axis[0]) + N(w.axis[0])) * rx + (N(w.previous_axis[1]) + N(w.axis[1])) * ry;
  const N radius_sq = square(rx) + square(ry);
  const auto between = (radius_sq >= square(N(w.inner_radius) - half_width)) & (radius_sq <= square(N(w.outer_radius) + half_width));
  const auto sector = (past_first >= zero) & (past_last <= zero) & (side > zero) & between;
  return sector | under_blade(w, w.previous_axis, rx, ry) | under_blade(w, w.axis, rx, ry);
}
/// The radial bin of a point in the sweep.
template <class N>
RAINREF_FN N radial_bin(const WipeDropsUniforms& uniforms, const Wiper& w, N x, N y) {
  const N radius = length(x - N(w.pivot[0]), y - N(w.pivot[1]));
  const N half_width(w.half_width), bins(static_cast<float>(uniforms.bin_count));
  const N width = (N(w.outer_radius) - N(w.inner_radius)) + N(2.0f) * half_width;
  const N bin = floor((radius - (N(w.inner_radius) - half_width)) * (bins / width));
  return guard<N>(clamp(bin, N(0.0f), bins - N(1.0f)), "what is swept lies between the ends of the bins, but for rounding");
}
/// Two rounds over the records, because a drop pushed by one blade may land in the sweep of another. A drop that is still in a sweep then
/// lies between two blades that meet; it is thrown off, and its life ends.
template <class N>
RAINREF_FN WipedDrop<N> wipe_drop_corrected(const WipeDropsUniforms& uniforms, const Wiper* wipers, const DropState<N>& in) {
  WipedDrop<N> d(in);
  const N zero(0.0f), one(1.0f);
  const auto live = in.life > zero;
  const N base_radius = N(uniforms.radius_scale) * cube_root_of_mass(in.mass, 0.0f);
  for (int i = 0; i < 2 * uniforms.wiper_count; ++i) {
    const int index = i % uniforms.wiper_count;
    const Wiper& w = wipers[index];
    if (w.direction == 0.0f) continue;
    const Plane<N> p = to_plane(uniforms.frame, d.u, d.v);
    const auto captured = live & in_sweep(w, p.x, p.y);
    if (!any(captured)) continue;
    const N radius = length(p.x - N(w.pivot[0]), p.y - N(w.pivot[1]));
    // The sine and cosine of the angle by which it is ahead.
    constexpr const char* is_away = "a scene keeps the inner end further from the pivot than a drop reaches";
    const N s = guard<N>(min((N(w.half_width) + base_radius) / guard<N>(max(radius, N(w.half_width)), is_away), one), is_away);
    const N c = sqrt(guard<N>(max(one - square(s), zero), is_away));
    const N ax(w.axis[0]), ay(w.axis[1]), turned = N(w.direction) * s;
    const N rx = radius * (c * ax - turned * ay), ry = radius * (c * ay + turned * ax);
    const Plane<N> place = to_glass(uniforms.inverse_frame, N(w.pivot[0]) + rx, N(w.pivot[1]) + ry);
    const Plane<N> velocity = to_glass(uniforms.inverse_frame, -(N(w.rate) * ry), N(w.rate) * rx);
    d.u = guard<N>(select(captured, place.x, d.u), for_lanes);
    d.v = guard<N>(select(captured, place.y, d.v), for_lanes);
    d.velocity_u = guard<N>(select(captured, velocity.x, d.velocity_u), for_lanes);
    d.velocity_v = guard<N>(select(captured, velocity.y, d.velocity_v), for_lanes);
    d.wiper = guard<N>(select(captured, N(static_cast<float>(index)), d.wiper), for_lanes);
    d.bin = guard<N>(select(captured, radial_bin(uniforms, w, p.x, p.y), d.bin), for_lanes);
  }
  const Plane<N> p = to_plane(uniforms.frame, d.u, d.v);
  for (int i = 0; i < uniforms.wiper_count; ++i) {
    if (wipers[i].direction == 0.0f) continue;
    const auto squeezed = live & in_sweep(wipers[i], p.x, p.y);
    d.life = select(squeezed, zero, d.life);
    d.wiper = select(squeezed, N(-2.0f), d.wiper);
  }
  return d;
}

/// For the film's texel.
template <class N>
RAINREF_FN Plane<N> texel_centre(const WipeDropsUniforms& uniforms, int column, int row) {
  const N u = (N::index(column) + N(0.5f)) * N(uniforms.texel[0]), v = N(static_cast<float>(row) + 0.5f) * N(uniforms.texel[1]);
  return to_plane(uniforms.frame, u, v);
}
/// The record that first sweeps the film's texel (column, row), -1: none; and its bin there.
template <class N>
struct SweptTexel {
  N wiper, bin;
};
template <class N>
RAINREF_FN SweptTexel<N> swept_texel(const WipeDropsUniforms& uniforms, const Wiper* wipers, int column, int row) {
  const Plane<N> p = texel_centre<N>(uniforms, column, row);
  SweptTexel<N> swept{N(-1.0f), N(-1.0f)};
  for (int i = 0; i < uniforms.wiper_count; ++i) {
    const Wiper& w = wipers[i];
    if (w.direction == 0.0f) continue;
    const auto first = in_sweep(w, p.x, p.y) & (swept.wiper < N(0.0f));
    if (!any(first)) continue;
    swept.wiper = guard<N>(select(first, N(static_cast<float>(i)), swept.wiper), for_lanes);
    swept.bin = guard<N>(select(first, radial_bin(uniforms, w, p.x, p.y), swept.bin), for_lanes);
  }
  return swept;
}

struct WipeDropsPassText {
  template <class N>
  using State = DropState<N>;
  template <bool>
  static constexpr bool gives(int) {
    return true;
  }
  template <class N, bool corrected, class Io>
  static RAINREF_FN auto run_record(const WipeDropsUniforms& u, const Io& io, const DropState<N>& d) {
    if constexpr (corrected)
      return wipe_drop_corrected<N>(u, io.wipers.data(), d);
    else
      return wipe_drop_as_published<N>(u, io.wipers.data(), d);
  }
  /// The film after the sweep: 0 where a record sweeps, otherwise unchanged.
  template <class N, bool corrected, class Io>
  static RAINREF_FN void run(const WipeDropsUniforms& u, const Io& io, int x, int y) {
    if constexpr (corrected) {
      const N here = io.film();
      const Plane<N> p = texel_centre<N>(u, x, y);
      typename N::Mask swept = false;
      for (const Wiper& w : io.wipers.records.first(static_cast<std::size_t>(u.wiper_count)))
        if (w.direction != 0) swept = swept | in_sweep(w, p.x, p.y);
      io.new_film(select(swept, N(0.0f), here));
    }
  }
};
#endif
