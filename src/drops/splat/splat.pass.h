// Pass splat: the height of the water on the glass [mm], texel by texel.
//
//   height = film + drops in slot order,    a drop gives h kernel(q),    q = |distance in the plane of the glass| / R
//
// Contact-angle hysteresis holds a drop by its contact line. The stronger the pull, the longer the drop is, the wider below, and the
// steeper at its advancing side. With a along the pull and b across it, in the drop's own lengths, it
//   gives h (1 + K a) kernel(q),    q^2 = (a / L)^2 + (b / (1 + T a / L))^2,    h over L (1 + T K <a^2>)
// This keeps its volume, and moves its centre of mass below its centre. T = K = 0, L = 1: round.
//
// If necks says that a drop still consists of two (corrected), both footprints are drawn: discs of radii A and B around points on a line
// through its centre, in lengths of R:
//   q^2 = smooth minimum of |p - a|^2 + 1 - A^2 and |p - b|^2 + 1 - B^2
// Both caps have the same curvature: the pressure under a flat drop is the same everywhere, so its height has one Laplacian. The rounded
// part of the minimum is the neck. The larger disc grows to R while they approach each other; h is divided by the volume, summed along the
// line. While it is two the drop leans less.
//
// R and h grow as the cube root of the mass. as-published measures each axis by its own length, so frame[1] is 0 there; corrected measures
// in the plane, where a drop is round on sheared glass too. Needs drop-inl.h.
#ifndef RAINREF_FN
#ifndef RAINREF_DROPS_SPLAT_PASS_H_
#define RAINREF_DROPS_SPLAT_PASS_H_
#include <span>
#include <string>
#include <vector>

#include "drops/drops.h"
#include "drops/motion/necks.pass.h"
#include "drops/records.h"
#include "drops/splat/uniforms.h"
#include "pass/definition.h"
#include "rainref/executor.h"
#include "scene/uniform_block.h"

namespace rainref::drops {

/// Its lanes are written by hand, drop by drop: see kernels.cpp.
struct SplatPass : pass::Takes<SplatUniforms> {
  static constexpr pass::About about{
      "splat", "The height of the water: every live drop, in slot order; corrected: on the film.", {1}, {3}, {"length"}, "ordered_scatter"};
  static scene::UniformBlock uniforms() {
    return block({member<&U::size>("texel", {1, 65536}, "Columns and rows of the height texture."),
                  member<&U::radius_scale>("m", scene::share, "Radius of a drop of mass 1."),
                  member<&U::height_scale>("mm", {0, 1e4}, "Height of a drop of mass 1."),
                  member<&U::frame>("m/texel", {-1e4, 1e4}, "Plane coordinates of a step: x of a column, x and y of a row."),
                  member<&U::smallest_radius>("m", {0, 1e5}, "A smaller drop is drawn this wide, and as much lower."),
                  member<&U::kernel>("1", {0, 4}, "0: paraboloid, 1: quartic, 2: smoothstep, 3: hemisphere, 4: disc."),
                  member<&U::blend>("1", {0, 2}, "0: add, 1: max, 2: add, rounded to half after each drop as a blending unit does."),
                  member<&U::drop_count>("1", {0, DropArrays::most_slots}, "Drops in the list."),
                  member<&U::film_scale>("mm", {0, 1e9}, "corrected: height of a mass unit in a texel."),
                  member<&U::gravity>("1", {-1e9, 1e9}, "corrected: pull on a drop of mass 1, in plane axes, over what holds it."),
                  member<&U::wind>("1", {-1e9, 1e9}, "corrected: the same of the wind."),
                  member<&U::longer>("1", scene::share, "Of a drop that is just held, its length more than round; 0 as published."),
                  member<&U::taper>("1", scene::share, "Its width's slope along its half length; 0 as published."),
                  member<&U::skew>("1", scene::share, "Its height's slope along its half length; 0 as published."),
                  member<&U::moment>("1", scene::share, "corrected: mean squared place along it, over its half length squared.")});
  }
  /// Whether a drop may add something to a tile of texels. Other drops certainly add nothing: the test extends a texel and a fiftieth of
  /// its radius further than the text. has_neck: it may have one.
  static bool reaches(const SplatUniforms& u, const Drop& d, const parallel::Tile& t, bool has_neck) {
    if (!(d.life > 0 && d.mass > 0)) return false;
    const double column = 0.5 * (t.x0 + t.x1) - static_cast<double>(d.position[0]) * u.size[0],
                 row = 0.5 * (t.y0 + t.y1) - static_cast<double>(d.position[1]) * u.size[1];
    const double plane_x = u.frame[0] * column + u.frame[1] * row, plane_y = u.frame[2] * row;
    const auto magnitude = [](double z) { return z < 0 ? -z : z; };
    // From the centre of the tile to its farthest texel centre, and one texel more.
    const double columns = 0.5 * (t.x1 - t.x0) + 0.5, rows = 0.5 * (t.y1 - t.y0) + 0.5;
    const double around = magnitude(u.frame[0]) * columns + (magnitude(u.frame[1]) + magnitude(u.frame[2])) * rows;
    const double reach = 1.02 * static_cast<double>(has_neck ? lean_reach(u) * neck_reach : lean_reach(u));
    const double needed = (__builtin_sqrt(plane_x * plane_x + plane_y * plane_y) - around) / reach;  // in units of the radius
    const double scale = u.radius_scale;
    return needed < u.smallest_radius || needed * needed * needed < scale * scale * scale * d.mass;
  }
  /// The number given by the uniform, or all: a port that lost some may have fewer.
  static std::span<const Drop> counted(const SplatUniforms& u, std::span<const Drop> all) {
    const auto said = static_cast<std::size_t>(u.drop_count);
    return u.drop_count < 0 || said > all.size() ? all : all.first(said);
  }
  static std::vector<Drop> near(const Uniforms& u, std::span<const Drop> all, bool corrected, int, const parallel::Tile& t) {
    std::vector<Drop> near;
    for (const Drop& d : counted(u, all))
      if (reaches(u, d, t, corrected)) near.push_back(d);
    return near;
  }
  /// The neck of a drop, or null.
  static const Neck* neck_of(std::span<const Neck> necks, std::uint32_t id) {
    for (const Neck& n : necks)
      if (n.id == id) return &n;
    return nullptr;
  }
  template <class Inputs>
  static std::string fault(const Inputs& m) {
    return necks_fault(m.captured.necks.records);
  }
  static bool rounds_inside(const SplatUniforms& u) { return static_cast<SplatBlend>(u.blend) == SplatBlend::add_in_half; }
  template <class B>
  struct Io {
    typename B::template Records<Drop> drops = pass::In{.name = "drops"};
    typename B::template Texels<Format::r32f, 1> film = pass::In{.name = "film", .from = "merge", .variant = "corrected"};
    typename B::template Records<Neck> necks = pass::In{.name = "necks", .from = "necks", .variant = "corrected", .optional = true};
    typename B::template Result<Format::r16f> height =
        pass::Out{.name = "height", .sentence = "Height of the water over the glass.", .unit = "mm", .range = {0, 8}};
  };
};

}  // namespace rainref::drops
#endif
#else

/// A drop as drawn: centre [texel], radius [m], height [mm], 0 for a dead one.
template <class N>
struct Stamp {
  N x, y, radius, inverse_radius_sq, height;
  // For a leaning drop: a unit vector in the plane, 1 over its half length and half width, slopes.
  N lean_x, lean_y, inverse_length, inverse_radius, taper, skew;
  // For a drop that is two: the line through both centres, a unit vector; the amount added to q^2 for each, and its change along the line.
  N neck_x, neck_y, larger, larger_slope, smaller, smaller_slope, fillet, inverse_fillet;
  RAINREF_FN Stamp() {}
};
/// x / max(x, least): the drop's own radius divided by the radius with which it is drawn.
template <class N>
RAINREF_FN N over_larger(N x, float least) {
  return x / max(x, N(least));
}
/// Direction and amount of a drop's lean: 1 if hysteresis just holds it, and if it slides.
template <class N>
struct Lean {
  N x, y, load;
};
template <class N>
RAINREF_FN Lean<N> lean_of(const SplatUniforms& u, N root) {
  const N root_sq = square(root);
  const N x = root_sq * N(u.gravity[0]) + root * N(u.wind[0]), y = root_sq * N(u.gravity[1]) + root * N(u.wind[1]);
  const N size = length(x, y), inverse = N(1.0f) / max(size, N(1e-6f));
  // A drop without pull is round, whatever the direction.
  const auto is_pulled = size > N(1e-6f);
  return {select(is_pulled, x * inverse, N(1.0f)), select(is_pulled, y * inverse, N(0.0f)), min(size, N(1.0f))};
}
/// The varying part of q^2 along the line through both centres, divided by its square: the smooth minimum of two straight lines.
template <class N>
RAINREF_FN N neck_profile(const Stamp<N>& s, N along) {
  const N a = s.larger - s.larger_slope * along, b = s.smaller - s.smaller_slope * along;
  return min(a, b) - square(max(s.fillet - abs(a - b), N(0.0f))) * s.inverse_fillet;
}
/// Area under the profile across the line at a point where 1 - q^2 is c, divided by a factor; the smoothstep is nearly (1 - q^2)^(7/3).
template <class N>
RAINREF_FN N section(SplatKernel kernel, N c) {
  switch (kernel) {
    case SplatKernel::paraboloid:
      return c * sqrt(c);
    case SplatKernel::quartic:
      return square(c) * sqrt(c);
    case SplatKernel::smoothstep:
      return (square(c) * sqrt(c)) * cube_root(c);
    case SplatKernel::hemisphere:
      return c;
    default:
      return sqrt(c);
  }
}
/// The stamp of a drop with this neck. Its volume is accurate to a five-hundredth; for the smoothstep, whose power is an approximation, to
/// a fourteenth.
template <class N>
RAINREF_FN void put_neck(const SplatUniforms& u, const NeckState<N>& neck, Stamp<N>& s) {
  const N zero(0.0f), one(1.0f);
  const N apart = length(neck.offset_x, neck.offset_y);
  const N inverse = one / guard<N>(max(apart, N(1e-6f)), "the smaller of two that are seen as two is apart");
  const N way = neck.left * apart;
  s.neck_x = neck.offset_x * inverse;
  s.neck_y = neck.offset_y * inverse;
  const Footprints<N> r = footprints(neck.share, neck.left);
  const N to_larger = -(neck.share * way), to_smaller = (one - neck.share) * way;
  s.larger = square(to_larger) + (one - square(r.larger));
  s.smaller = square(to_smaller) + (one - square(r.smaller));
  s.larger_slope = N(2.0f) * to_larger;
  s.smaller_slope = N(2.0f) * to_smaller;
  s.fillet = guard<N>(max((N(neck_width) * neck.left) * square(r.smaller), N(1e-6f)), "a neck has a width while it is kept");
  s.inverse_fillet = N(0.25f) / s.fillet;
  s.inverse_radius = one / s.radius;
  // For both, and for a round drop, at the centres of equal parts of their length.
  const N low = to_larger - r.larger, high = to_smaller + r.smaller;
  const N middle = N(0.5f) * (low + high), half = N(0.5f) * (high - low);
  const auto kernel = static_cast<SplatKernel>(u.kernel);
  N both = zero, round = zero, moment = zero;
  for (int i = 0; i < neck_parts; ++i) {
    const N at(static_cast<float>(2 * i + 1 - neck_parts) * (1.0f / neck_parts)), along = middle + half * at;
    const N inside =
        guard<N>(max(one - (square(along) + neck_profile(s, along)), zero), "there is water all along the line, but for rounding");
    const N cut = section(kernel, inside);
    both = both + cut;
    moment = moment + along * cut;
    round = round + section(kernel, one - square(at));
  }
  constexpr const char* hold_water = "both footprints hold water";
  s.height = s.height * (round / guard<N>(max(both * half, N(1e-6f)), hold_water));
  if (leans(u)) {
    // If both caps have the same curvature the larger one holds more water. So the centre of mass is off the centre, and the drop is higher
    // and wider below.
    const N below = (s.neck_x * s.lean_x + s.neck_y * s.lean_y) * (moment / guard<N>(max(both, N(1e-6f)), hold_water));
    const N even = one + (s.taper * s.skew) * N(u.moment);
    const N least = guard<N>(max(even + (s.taper + s.skew) * below, N(0.25f)), "the middle of mass is near the middle");
    s.height = s.height * (even / least);
  }
}
/// neck: null if the drop has none.
template <class N>
RAINREF_FN Stamp<N> splat_stamp(const SplatUniforms& u, N position_u, N position_v, N mass, N life, const NeckState<N>* neck = nullptr) {
  Stamp<N> s;
  s.x = position_u * N(u.size[0]);
  s.y = position_v * N(u.size[1]);
  const N root = cube_root_of_mass(mass, 0.0f), own = N(u.radius_scale) * root;
  s.radius = max(own, N(u.smallest_radius));
  s.inverse_radius_sq = N(1.0f) / square(s.radius);
  // A drop that is drawn wider than it is keeps its volume.
  N height = (N(u.height_scale) * root) * square(over_larger(own, u.smallest_radius));
  if (leans(u)) {
    const N one(1.0f);
    Lean<N> lean = lean_of(u, root);
    if (neck) lean.load = lean.load * (one - neck->left);
    const N stretched = one + N(u.longer) * lean.load;
    s.lean_x = lean.x;
    s.lean_y = lean.y;
    s.inverse_radius = one / s.radius;
    s.inverse_length = s.inverse_radius / stretched;
    s.taper = N(u.taper) * lean.load;
    s.skew = N(u.skew) * lean.load;
    height = height / (stretched * (one + (s.taper * s.skew) * N(u.moment)));
  }
  s.height = guard<N>(select(life > N(0.0f), height, N(0.0f)), all_live);
  if (neck) put_neck(u, *neck, s);
  return s;
}

/// kernel(q); 0 from q = 1 on, except for the disc, which ends beyond it.
template <class N>
RAINREF_FN N splat_profile(SplatKernel kernel, N q_sq) {
  const N inside = max(N(1.0f) - q_sq, N(0.0f));
  switch (kernel) {
    case SplatKernel::paraboloid:
      return inside;
    case SplatKernel::quartic:
      return square(inside);
    case SplatKernel::smoothstep:
      return N(1.0f) - smoothstep(0.0f, 1.0f, sqrt(q_sq));
    case SplatKernel::hemisphere:
      return sqrt(inside);
    default:
      return select(q_sq <= N(1.0f), N(1.0f), N(0.0f));
  }
}
/// The same for a drop with a neck, whose fillet may make q^2 negative.
template <class N>
RAINREF_FN N necked_profile(SplatKernel kernel, N q_sq) {
  return splat_profile(kernel, max(q_sq, N(0.0f)));
}
/// Height of a leaning drop at a point with this share of its central height.
template <class N>
RAINREF_FN N skewed_height(const Stamp<N>& s, N share) {
  return s.height * max(share, N(0.0f));
}
/// Contribution of a drop to the texel with its centre at (x, y) [texel].
template <bool is_leaning, bool has_neck = false, class N>
RAINREF_FN N splat_contribution(const SplatUniforms& u, SplatKernel kernel, const Stamp<N>& s, N x, N y) {
  const N column = x - s.x, row = y - s.y;
  const N plane_x = N(u.frame[0]) * column + N(u.frame[1]) * row, plane_y = N(u.frame[2]) * row;
  if constexpr (is_leaning) {
    const N one(1.0f), a = (s.lean_x * plane_x + s.lean_y * plane_y) * s.inverse_length;
    const N b = ((s.lean_x * plane_y - s.lean_y * plane_x) * s.inverse_radius) / max(one + s.taper * a, N(0.0625f));
    if constexpr (has_neck) {
      const N e = s.neck_x * s.lean_x + s.neck_y * s.lean_y, f = s.neck_y * s.lean_x - s.neck_x * s.lean_y;
      const N q_sq = (square(a) + square(b)) + neck_profile(s, e * a + f * b);
      return skewed_height(s, one + s.skew * a) * necked_profile(kernel, q_sq);
    }
    return skewed_height(s, one + s.skew * a) * splat_profile(kernel, square(a) + square(b));
  }
  if constexpr (has_neck) {
    const N a = plane_x * s.inverse_radius, b = plane_y * s.inverse_radius;
    const N q_sq = (square(a) + square(b)) + neck_profile(s, s.neck_x * a + s.neck_y * b);
    return s.height * necked_profile(kernel, q_sq);
  }
  return s.height * splat_profile(kernel, (square(plane_x) + square(plane_y)) * s.inverse_radius_sq);
}
template <class N>
RAINREF_FN N splat_blend(SplatBlend blend, N before, N drop) {
  return blend == SplatBlend::max ? max(before, drop) : before + drop;
}

/// The drops in a texel, which gets all stamps. `blended` gives the target's value after a drop: with `accumulate = half` rounded to half,
/// else the number itself. have_necks: for each stamp.
template <class N, class Blended>
RAINREF_FN N splat_drops(const SplatUniforms& u, const Stamp<N>* stamps, const unsigned char* have_necks, int x, int y, Blended blended) {
  const N fx = N::index(x) + N(0.5f), fy = N(static_cast<float>(y) + 0.5f);
  N height(0.0f);
  for (int i = 0; i < u.drop_count; ++i) {
    const auto kernel = static_cast<SplatKernel>(u.kernel);
    const auto drop_with = [&](auto neck) {
      return leans(u) ? splat_contribution<true, neck()>(u, kernel, stamps[i], fx, fy)
                      : splat_contribution<false, neck()>(u, kernel, stamps[i], fx, fy);
    };
    const N drop = have_necks[i] ? drop_with(std::true_type()) : drop_with(std::false_type());
    height = blended(splat_blend(static_cast<SplatBlend>(u.blend), height, drop));
  }
  return height;
}

/// corrected: the film, in whole mass units per texel, filtered by a tent of 3 x 3 texels, which keeps its volume. Rows are readable one
/// texel to both sides, where the nearest texel is repeated. Operands have names because compilers evaluate the operands of + in different
/// orders, and the diagnosis names equal causes in the order of evaluation.
template <class N>
RAINREF_FN N film_tent(N before, N here, N after) {
  const N middle = N(0.5f) * here, sides = N(0.25f) * (before + after);
  return middle + sides;
}
template <class N>
RAINREF_FN N film_row(const float* row, int x) {
  const N before = N::load(row + x - 1), own = N::load(row + x), after = N::load(row + x + 1);
  return film_tent(before, own, after);
}
template <class N>
RAINREF_FN N film_height(const SplatUniforms& u, const float* below, const float* here, const float* above, int x) {
  const N before = film_row<N>(below, x), own = film_row<N>(here, x), after = film_row<N>(above, x);
  return N(u.film_scale) * film_tent(before, own, after);
}

struct SplatPassText {
  template <class N, bool corrected, class Io>
  static RAINREF_FN void run(const SplatUniforms& uniforms, const Io& io, int x, int y) {
    std::vector<Stamp<N> > near;
    std::vector<unsigned char> have_necks;
    SplatUniforms u = uniforms;
    for (const Drop& d : SplatPass::counted(uniforms, io.drops.records)) {
      const Neck* const neck = corrected ? SplatPass::neck_of(io.necks.records, d.id) : nullptr;
      if (!io.drops.takes(SplatPass::reaches(uniforms, d, {x, y, x + 1, y + 1}, neck))) continue;
      NeckState<N> both;
      if (neck) both = loaded_neck<N>(neck->offset, neck->share, neck->left);
      near.push_back(splat_stamp<N>(uniforms, N::load(&d.position[0]), N::load(&d.position[1]), N::load(&d.mass), N::load(&d.life),
                                    neck ? &both : nullptr));
      have_necks.push_back(neck != nullptr);
    }
    u.drop_count = static_cast<std::int32_t>(near.size());
    const bool rounds_each = SplatPass::rounds_inside(u);
    const N drops = splat_drops<N>(u, near.data(), have_necks.data(), x, y,
                                   [&](N sum) { return rounds_each ? half_of(sum, io.height.rounding) : sum; });
    if constexpr (corrected)
      io.height(film_height<N>(u, io.film.row[0], io.film.row[1], io.film.row[2], x) + drops);
    else
      io.height(drops);
  }
};
#endif
