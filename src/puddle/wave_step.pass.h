// Pass wave_step: the next level of the wave from the newest and the previous level.
#ifndef RAINREF_FN
#ifndef RAINREF_PUDDLE_WAVE_STEP_PASS_H_
#define RAINREF_PUDDLE_WAVE_STEP_PASS_H_
#include <cmath>
#include <span>
#include <vector>

#include "pass/definition.h"
#include "puddle/host.h"
#include "puddle/uniforms.h"
#include "scene/uniform_block.h"

namespace rainref::puddle {

/// Its lanes are written by hand, in place over one plane for each level: see kernels_wave.cpp.
struct WaveStepPass : pass::Takes<WaveStepUniforms> {
  static constexpr pass::About about{
      "wave_step", "The next level of the water from the newest and the previous one.", {1}, {2}, {"the four neighbours", "length"}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::damping>("1", scene::share, "as-published: factor of the new level; corrected: gamma of a step."),
                  member<&U::step>("texel", {1, 8}, "as-published: offset of the neighbours."),
                  member<&U::courant_sq>("1", {0, 0.5}, "corrected: Courant number squared, times (1 + gamma) / 2."),
                  member<&U::drop_count>("1", {0, 1 << 20}, "Drops in the list."),
                  member<&U::rest>("1", scene::share, "Stored value of level water."),
                  member<&U::rim_damping>("1", scene::share, "corrected: share of the wave that the rim takes at the edge itself."),
                  member<&U::rim_inverse>("1/texel", {0, 2}, "corrected: one over the width of the rim."),
                  member<&U::size>("texel", {0, 8192}, "corrected: columns and rows of the wave.")});
  }
  template <class B>
  struct Io {
    typename B::template Planes<Format::rg16f, Format::rg32f, Format::rgba8> wave =
        pass::In{.name = "wave", .from = "wave_step", .previous = true};
    typename B::template Records<Drop> drops = pass::In{.name = "drops", .from = "raindrops"};
    typename B::template Texels<Format::r32f> shore = pass::In{.name = "shore", .variant = "corrected", .optional = true};
    typename B::template Result<Format::rg16f, Format::rg32f, Format::rgba8> next = {
        pass::Out{
            .name = "wave", .sentence = "Newest level, previous level.", .encoding = "u = 2 (s - 1/2)", .format_key = "puddle.storage"},
        pass::Out{.name = "wave",
                  .sentence = "Newest level, previous level.",
                  .unit = "m",
                  .range = {-rgba8_range, rgba8_range},
                  .encoding = "floats: height = s; rgba8: height = 0.04 (s - 128/255)",
                  .format_key = "puddle.storage"}};
  };
};

}  // namespace rainref::puddle
#endif
#else

/// Row: const Storage*, or another type from which element() reads values. here, below and above are rows of the newest level, readable
/// `reach` texels to both sides.
template <class Row, class Previous>
struct WaveRows {
  Row here, below, above, below_next, above_next;
  const Previous* previous;
  int reach;           ///< whole texels to the neighbours
  float fraction;      ///< fractional part of the offset; *_next are the rows one texel further out
  const float* shore;  ///< corrected: share of the wave that the shore leaves; null: all of it
};
/// newest_row(dy): the row dy rows away.
template <class Newest, class NewestRow, class Previous>
RAINREF_FN WaveRows<const Newest*, Previous> rows_around(const WaveStepUniforms& u, bool corrected, const NewestRow& newest_row,
                                                         const Previous* previous, const float* shore) {
  // With a whole offset r the neighbours are r away; with a fractional one between r and r + 1.
  const int r = corrected ? 1 : static_cast<int>(u.step);
  const float fraction = corrected ? 0.0f : u.step - static_cast<float>(r);
  return {newest_row(0), newest_row(-r), newest_row(r), newest_row(-r - 1), newest_row(r + 1), previous, r, fraction, shore};
}
template <class N, class Storage>
RAINREF_FN N element(const Storage* row, int x) {
  return N::load(row + x);
}

// ---- as published --------------------------------------------------------------------------------------------------
//   d = -(s0 - 1/2) 2 + (s1 + s2 + s3 + s4 - 2),   d *= damping,   d += drops,   stored as d / 2 + 1/2
// s0 is the previous level; s1 ... s4 are the newest level below, left, right and above (seed 003 uses other names).
template <class N>
RAINREF_FN N drop_as_published(const Drop& drop, N x, N y) {
  const N distance = length(N(drop.x) - x, N(drop.y) - y);
  return N(drop.amplitude) * smoothstep(4.0f, 0.5f, distance);
}
template <class N, class Row, class Previous, class Drops>
RAINREF_FN N wave_step_as_published(const WaveStepUniforms& u, const WaveRows<Row, Previous>& in, Drops drops, int x, int y) {
  const int r = in.reach;
  N left = element<N>(in.here, x - r), right = element<N>(in.here, x + r), down = element<N>(in.below, x), up = element<N>(in.above, x);
  if (in.fraction != 0.0f) {
    // Like a texture unit between two texels: a fractional STEP diffuses.
    const N f(in.fraction);
    left = mix(left, element<N>(in.here, x - r - 1), f);
    right = mix(right, element<N>(in.here, x + r + 1), f);
    down = mix(down, element<N>(in.below_next, x), f);
    up = mix(up, element<N>(in.above_next, x), f);
  }
  const N velocity = -(N::load(in.previous + x) - N(0.5f)) * N(2.0f);
  N d = velocity + (sum_any_order(down, left, right, up) - N(2.0f));
  d = d * N(u.damping);
  const N fx = N::index(x) + N(0.5f), fy = N(static_cast<float>(y) + 0.5f);
  for (const Drop& drop : drops) {
    if (drop.amplitude > 0.01f) d = d + drop_as_published(drop, fx, fy);
  }
  return d * N(0.5f) + N(0.5f);
}

// ---- corrected -----------------------------------------------------------------------------------------------------
//   new = (1 + gamma) u - gamma p + C^2 (1 + gamma)/2 L(u) + impulse,     previous = u + impulse
// On a natural shore new = rest + shore (new - rest), with shore from 1 in the water to 0 on dry ground. L is the five-point Laplacian and
// C the Courant number. The weights of u and p add to 1, so the rest value and the unit of the stored heights cancel out. The mean has the
// roots 1 and gamma, so it is kept. The impulse goes to both levels: a displacement, not a kick. (physics: P3, P7)
//
// In a rim along the edges both levels are multiplied by kept = 1 - rim_damping depth^2, p before and new after (Cerjan and others,
// Geophysics 50:705, 1985). This is (d/dt + sigma)^2 u = c^2 L(u), whose waves fade and keep their speed. Applied to new alone it would
// also be a stiff spring, which reflects waves. With A = 2 / (kept (1 + gamma)) and B = 2 gamma kept / (1 + gamma) it is A new - 2 u + B p
// = C^2 L(u), and because A + B >= 2 and A >= B no profile of kept lets the energy grow: the limit of C stays.
//
// The crater of a drop at distance r, with q = r / R < 1: (1 - q^2)^2 (1 - 4 q^2). Its volume is exactly 0.
template <class N>
RAINREF_FN N drop_corrected(const Drop& drop, N x, N y) {
  const N inverse = uniform_quotient(1.0f, drop.radius, N());
  const N s = square((x - N(drop.x)) * inverse) + square((y - N(drop.y)) * inverse);
  const N rim = max(N(1.0f) - s, N(0.0f));
  return N(drop.amplitude) * (square(rim) * (N(1.0f) - N(4.0f) * s));
}
template <class N, class Drops>
RAINREF_FN N impulse_corrected(Drops drops, int x, int y) {
  const N fx = N::index(x) + N(0.5f), fy = N(static_cast<float>(y) + 0.5f);
  N sum(0.0f);
  for (const Drop& drop : drops) sum = sum + drop_corrected(drop, fx, fy);
  return sum;
}
/// Share of the wave that the rim leaves in a step; its depth is 0 in free water and 1 on the edge.
template <class N>
RAINREF_FN N kept_in_rim(const WaveStepUniforms& u, int x, int y) {
  const N fx = N::index(x) + N(0.5f), fy = N(static_cast<float>(y) + 0.5f);
  const N edge = min(min(fx, N(u.size[0]) - fx), min(fy, N(u.size[1]) - fy));
  const N depth = max(N(1.0f) - N(u.rim_inverse) * edge, N(0.0f));
  return N(1.0f) - N(u.rim_damping) * square(depth);
}
template <class N, class Row, class Previous, class Drops>
RAINREF_FN N wave_step_corrected(const WaveStepUniforms& u, const WaveRows<Row, Previous>& in, Drops drops, int x, int y) {
  const N here = element<N>(in.here, x);
  // Summed in pairs, so that a mirrored or transposed wave keeps its symmetry to the last bit.
  const N around =
      sum_any_order_in_pairs(element<N>(in.here, x - 1), element<N>(in.here, x + 1), element<N>(in.below, x), element<N>(in.above, x));
  const N laplacian = minus_four_times(around, here);
  const bool has_rim = u.rim_damping > 0.0f;
  const N rim = has_rim ? kept_in_rim<N>(u, x, y) : N(1.0f);
  const N stored = N::load(in.previous + x);
  const N previous = has_rim ? N(u.rest) + rim * (stored - N(u.rest)) : stored;
  const N moving = here + N(u.damping) * (here - previous);
  N next = moving + N(u.courant_sq) * laplacian;
  if (!drops.empty()) next = next + impulse_corrected<N>(drops, x, y);
  if (!in.shore && !has_rim) return next;
  const N kept = !in.shore ? rim : has_rim ? N::load(in.shore + x) * rim : N::load(in.shore + x);
  return N(u.rest) + kept * (next - N(u.rest));
}
/// The second output, which becomes the previous level.
template <class N, class Storage, class Drops>
RAINREF_FN N wave_previous_corrected(const Storage* here, const float* shore, Drops drops, int x, int y) {
  const N impulse = impulse_corrected<N>(drops, x, y);
  return N::load(here + x) + (shore ? N::load(shore + x) * impulse : impulse);
}

struct WaveStepPassText {
  template <class N, bool corrected, class Io>
  static RAINREF_FN void run(const WaveStepUniforms& u, const Io& io, int x, int y) {
    // The other drops add exactly nothing here; a GPU may leave them out, and the lanes do.
    const float cx = static_cast<float>(x) + 0.5f, cy = static_cast<float>(y) + 0.5f;
    std::vector<Drop> found;
    for (const Drop& d : io.drops.records) {
      const float reach = (corrected ? d.radius : 4.0f) + 1.5f;
      if (io.drops.takes(std::abs(d.x - cx) < reach && std::abs(d.y - cy) < reach)) found.push_back(d);
    }
    const std::span<const Drop> near = found;
    io.wave.in_storage([&]<class Storage>(Storage) {
      const auto newest = [&](int dy) { return io.wave.template row<Storage>(0, dy); };
      const WaveRows<const Storage*, Storage> rows =
          rows_around<Storage>(u, corrected, newest, io.wave.template row<Storage>(1, 0), io.shore.row[0]);
      if constexpr (corrected) {
        const N next = wave_step_corrected<N>(u, rows, near, x, y);
        io.next(next, near.empty() ? N::load(rows.here + x) : wave_previous_corrected<N>(rows.here, rows.shore, near, x, y));
      } else {
        const N next = wave_step_as_published<N>(u, rows, near, x, y);
        io.next(next, N::load(rows.here + x));
      }
    });
  }
};
#endif
