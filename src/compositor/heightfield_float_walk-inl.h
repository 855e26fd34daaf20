// A walk in floats, with 16 rays in a vector of 64 bytes. For each ray it returns that it certainly misses, a guess of the triangle that it
// hits, or nothing. A guess is then checked in doubles, and the remaining rays walk in doubles (heightfield_walk-inl.h). The result is
// always that of the definition. Text only, for one target.
//
// Proof that a miss is correct. Let A be the number of cells that the ray passes within the tile, along its faster axis. Positions are
// relative to the cell in which it enters, so all of them are below A + 2. Nine roundings (of the first position, the direction, the
// reciprocal, three of the wall's time, three of the place along the wall) move the float position of the ray at time t by less than 10 eps
// (A + 2), eps = 2^-24; we use delta = 16 eps (A + 2). Heights of the sheet at a distance delta differ by at most 2 steepest delta, and if
// the planes of two triangles are extended beyond their edge by at most 4 steepest delta. Heights themselves have an error below 16 eps
// spread. So if at every edge that the ray crosses in floats it is farther from the sheet than
//   doubt = 8 steepest delta + 16 eps spread + twice the tile's margin
// and always on the same side, then it is on that side at every edge that it crosses by the definition. These edges may differ near a
// corner or along an edge, but between two edges the distance is linear, and the true ray is at most delta away.
//
// A ray may leave the tile through a wall later than in floats, and continue inside along the wall for about delta divided by its speed
// across the wall. The possible change of its height above the sheet in that time is added to `doubt`. The same holds for a ray that enters
// through a wall, because floats begin before that.
//
// Proof that a checked guess is the hit. It is the first triangle that floats cannot rule out, entered at a point where the side is certain
// (g > doubt, or the start). The check ensures that the true ray leaves that side on the triangle's plane at time h, and is within the
// triangle then. Before h it may cross other edges than in floats, outside the triangle. But at a share s of the way from h back to the
// entry it is at most s delta outside (at h it is inside), where the sheet differs from the plane by less than 8 steepest s delta, and g is
// at least s doubt there. So the side does not change at any edge before h. The check requires a margin inside the triangle that is large
// enough for doubles: rates of the distances to the edges are at most |dx| + |dy|.
//
// Start of a ray: it is above if it enters through the slab's top, and below if it enters through its bottom. The slab extends the heights
// by `doubt`, so this also holds for a ray through a corner of the slab: a ray steep enough to violate it cannot come up through the sheet
// in that cell.
namespace float_walk {

using D = FloatTag;
using DI = hn::RebindToSigned<D>;
using V = hn::Vec<D>;
using VI = hn::Vec<DI>;
using M = hn::Mask<D>;

HWY_INLINE HWY_ATTR V all(float x) { return hn::Set(D(), x); }
HWY_INLINE HWY_ATTR V times_plus(V a, V b, V c) { return hn::Add(hn::Mul(a, b), c); }
HWY_INLINE HWY_ATTR V narrow(const Pair& a) {
  return hn::Combine(D(), hn::DemoteTo(NarrowTag(), a.upper.v), hn::DemoteTo(NarrowTag(), a.lower.v));
}
/// For a nonnegative number; -0 does not matter here.
HWY_INLINE HWY_ATTR Pair floor_of(const Pair& a) { return {hn::Floor(a.lower.v), hn::Floor(a.upper.v)}; }
HWY_INLINE HWY_ATTR V within_unit(V x) { return hn::Min(hn::Max(x, hn::Zero(D())), all(1)); }
HWY_INLINE HWY_ATTR V without_zero(V x) { return hn::IfThenElse(hn::Lt(hn::Abs(x), all(1e-30f)), all(1e-30f), x); }
/// For a whole number of magnitude below 2^22.
HWY_INLINE HWY_ATTR VI integer(V a) {
  const V large = all(0x1.8p23f);  // adding it makes the last bit worth 1
  return hn::Sub(hn::BitCast(DI(), hn::Add(a, large)), hn::BitCast(DI(), large));
}
HWY_INLINE HWY_ATTR bool any(M mask) { return !hn::AllFalse(D(), mask); }
/// Result of the floats for the requested lanes, as bit masks; lanes in neither mask are undecided.
struct Outcome {
  std::uint32_t missed = 0;
  std::uint32_t guessed = 0, upper = 0;  ///< upper: the guessed lanes whose triangle contains the fourth vertex
  V i, j;                                ///< cells guessed, from the tile's first
  V h00, h10, h01, h11;                  ///< the heights of their corners
  HWY_INLINE HWY_ATTR Outcome() {}
};

HWY_INLINE HWY_ATTR void walk(const HeightfieldView& field, const HeightfieldTile& tile, const GridRay<Pair>& r, const Pair& limit,
                              std::uint32_t lanes, Outcome& out) {
  const D d;
  const DI di;
  const FloatTile& f = tile.floats;
  const V zero = hn::Zero(d), one = all(1), columns = all(f.columns), rows = all(f.rows), middle = all(f.middle);
  const V low = all(f.low), high = all(f.high);
  const VI stride = hn::Set(di, static_cast<std::int32_t>(field.columns) + 1);

  const Pair ox = r.ox - Pair(tile.x0), oy = r.oy - Pair(tile.y0), oh = r.oh - Pair(static_cast<double>(f.middle));
  const V dx = narrow(r.dx), dy = narrow(r.dy), dh = narrow(r.dh), float_ox = narrow(ox), float_oy = narrow(oy), float_oh = narrow(oh);
  const V ix = hn::Div(one, dx), iy = hn::Div(one, dy), ih = hn::Div(one, without_zero(dh));
  const V abs_ix = hn::Abs(ix), abs_iy = hn::Abs(iy), fastest = hn::Max(hn::Abs(dx), hn::Abs(dy));
  const M right = hn::Gt(dx, zero), up = hn::Gt(dy, zero), falls = hn::Lt(dh, zero);
  const V ahead_x = hn::IfThenElseZero(right, one), ahead_y = hn::IfThenElseZero(up, one);
  V far_x = hn::IfThenElseZero(right, columns), near_x = hn::Sub(columns, far_x);
  V far_y = hn::IfThenElseZero(up, rows), near_y = hn::Sub(rows, far_y);

  // Positions and times are relative to a point near the ray's entry and its cell, so that the numbers are small.
  const V side_by_origin = hn::Max(hn::Mul(hn::Sub(near_x, float_ox), ix), hn::Mul(hn::Sub(near_y, float_oy), iy));
  const V slab_by_origin = hn::Mul(hn::Sub(hn::IfThenElse(falls, high, low), float_oh), ih);
  const Pair start = to_double(hn::Min(hn::Max(hn::Max(side_by_origin, slab_by_origin), narrow(r.nearest)), all(1e30f)));
  const Pair x = ox + start * r.dx, y = oy + start * r.dy;
  const Pair cell_x = floor_of(maximum(Pair(0.0), minimum(Pair(tile.x1 - tile.x0 - 1), x)));
  const Pair cell_y = floor_of(maximum(Pair(0.0), minimum(Pair(tile.y1 - tile.y0 - 1), y)));
  const V fx = narrow(cell_x), fy = narrow(cell_y);
  far_x = hn::Sub(far_x, fx), near_x = hn::Sub(near_x, fx), far_y = hn::Sub(far_y, fy), near_y = hn::Sub(near_y, fy);
  const V px = narrow(x - cell_x), py = narrow(y - cell_y), ph = narrow(oh + start * r.dh);
  const V nearest = narrow(r.nearest - start), farthest = hn::Min(narrow(minimum(r.farthest, limit) - start), all(1e30f));

  // Numbers that are too large or NaN leave a lane undecided, as does a ray for which the roundings of doubles matter.
  const M active = float_mask_of_bits(lanes), nowhere = hn::AndNot(active, active);
  const M ordinary = hn::And(
      hn::And(hn::Le(hn::Max(hn::Abs(float_ox), hn::Abs(float_oy)), all(f.far_beside)), hn::Le(hn::Abs(float_oh), all(f.far_above))),
      hn::And(hn::And(hn::Le(hn::Add(hn::Abs(px), hn::Abs(py)), all(f.away)), hn::Le(hn::Abs(ph), all(f.tall))),
              hn::Le(hn::Add(fastest, hn::Abs(dh)), all(1e18f))));

  // A wall is at time (wall times inverse) + this.
  const V qx = hn::Neg(hn::Mul(px, ix)), qy = hn::Neg(hn::Mul(py, iy));
  const V out_x = times_plus(far_x, ix, qx), out_y = times_plus(far_y, iy, qy);
  const V beside_x = hn::Mul(all(f.beside), abs_ix), beside_y = hn::Mul(all(f.beside), abs_iy);
  const V slab_a = hn::Mul(hn::Sub(low, ph), ih), slab_b = hn::Mul(hn::Sub(high, ph), ih);
  const V slab_in = hn::Min(slab_a, slab_b), slab_out = hn::Max(slab_a, slab_b);
  const V in_x = hn::Sub(times_plus(near_x, ix, qx), beside_x), in_y = hn::Sub(times_plus(near_y, iy, qy), beside_y);
  const V side_in = hn::Max(hn::Max(in_x, in_y), nearest);
  const V begin = hn::Max(side_in, slab_in);
  const V within = hn::Min(slab_out, hn::Add(farthest, hn::Min(beside_x, beside_y)));
  const V leaves = hn::Min(within, hn::Min(hn::Add(out_x, beside_x), hn::Add(out_y, beside_y)));
  const V end = hn::Min(within, hn::Min(out_x, out_y));
  const M passes_by = hn::And(hn::And(active, ordinary), hn::Gt(begin, leaves));
  const M walks = hn::And(hn::And(active, ordinary), hn::Le(begin, leaves));
  out.missed = bits_of(passes_by);
  if (!any(walks)) return;
  const V across = times_plus(hn::Max(hn::Abs(begin), hn::Abs(end)), fastest, hn::Add(hn::Add(hn::Abs(px), hn::Abs(py)), all(2)));
  const V cells = hn::Min(across, all(f.longest)), faster = times_plus(fastest, all(f.steepest_twice), hn::Abs(dh));
  const V leaving = hn::Sub(leaves, end);
  const V doubt = times_plus(leaving, faster, times_plus(cells, all(f.doubt_for_cell), all(f.doubt)));

  // A ray that falls from high above the surrounding blocks continues to the height of their highest vertex, or to their border.
  V t = hn::IfThenElseZero(walks, begin);
  const V block_time = hn::Mul(hn::Min(abs_ix, abs_iy), all(block_cells - 0.1f));
  for (M leaps = hn::And(hn::And(walks, falls), hn::Gt(hn::Sub(end, t), block_time)); any(leaps);) {
    const V center = hn::Add(t, block_time), beyond = hn::Add(center, block_time);
    const V block_at_x = hn::Add(hn::Add(times_plus(center, dx, px), fx), all(f.into_block_x));
    const V block_at_y = hn::Add(hn::Add(times_plus(center, dy, py), fy), all(f.into_block_y));
    const V block_x = hn::Max(zero, hn::Min(hn::Mul(block_at_x, all(1.0f / block_cells)), all(f.last_block_x)));
    const V block_y = hn::Max(zero, hn::Min(hn::Mul(block_at_y, all(1.0f / block_cells)), all(f.last_block_y)));
    const VI block = hn::Add(hn::Mul(integer(hn::Floor(block_y)), hn::Set(di, field.blocks_across)), integer(hn::Floor(block_x)));
    const V top = hn::GatherIndex(d, field.nearby + f.first_block, hn::IfThenElseZero(hn::RebindMask(di, leaps), block));
    const V down = hn::Mul(hn::Sub(hn::Add(hn::Sub(top, middle), all(f.doubt)), ph), ih);
    t = hn::IfThenElse(leaps, hn::Max(t, hn::Min(down, beyond)), t);
    leaps = hn::And(leaps, hn::And(hn::Ge(t, beyond), hn::Lt(t, end)));
  }

  // The cell relative to that of px and py; its walls ahead; the index of its first vertex.
  const V first_x = hn::Neg(fx), first_y = hn::Neg(fy);
  const V here_x = hn::IfThenElseZero(walks, times_plus(t, dx, px)), here_y = hn::IfThenElseZero(walks, times_plus(t, dy, py));
  const V i0 = hn::Floor(hn::Max(first_x, hn::Min(here_x, hn::Add(first_x, hn::Sub(columns, one)))));
  const V j0 = hn::Floor(hn::Max(first_y, hn::Min(here_y, hn::Add(first_y, hn::Sub(rows, one)))));
  V kx = hn::Add(i0, ahead_x), ky = hn::Add(j0, ahead_y);
  VI at = hn::Add(hn::Add(hn::Mul(integer(hn::Add(j0, fy)), stride), integer(hn::Add(i0, fx))), hn::Set(di, f.first));
  const V step_x = hn::IfThenElse(right, one, all(-1)), step_y = hn::IfThenElse(up, one, all(-1));
  const VI move_x = hn::IfThenElse(hn::RebindMask(di, right), hn::Set(di, 1), hn::Set(di, -1));
  const VI move_y = hn::IfThenElse(hn::RebindMask(di, up), stride, hn::Neg(stride));
  const V is = hn::Div(one, without_zero(hn::Add(dx, dy))), qs = hn::Neg(hn::Mul(hn::Add(px, py), is));
  const M to_upper = hn::Gt(is, zero);

  // Gaps of rays that begin below the sheet are turned over by this sign.
  const V below = all(-0.0f);
  V side = hn::IfThenElse(falls, zero, below);
  V h00 = zero, h10 = zero, h01 = zero, h11 = zero;
  M unsure = nowhere, walking = walks, waiting = nowhere, guessed = nowhere, in_second = nowhere;
  const M asks = hn::And(walks, hn::And(hn::Le(slab_in, side_in), hn::Le(t, begin)));
  if (any(asks)) {
    corners(field.pairs, at, h00, h10, h01, h11);
    const V u = within_unit(hn::Sub(here_x, i0)), v = within_unit(hn::Sub(here_y, j0)), u1 = hn::Sub(one, u), v1 = hn::Sub(one, v);
    const V lower_height = times_plus(u, hn::Sub(h10, h00), times_plus(v, hn::Sub(h01, h00), hn::Sub(h00, middle)));
    const V upper_height = times_plus(u1, hn::Sub(h01, h11), times_plus(v1, hn::Sub(h10, h11), hn::Sub(h11, middle)));
    const V gap = hn::Sub(times_plus(t, dh, ph), hn::IfThenElse(hn::Lt(hn::Add(u, v), one), lower_height, upper_height));
    const V latest = hn::Max(times_plus(all(2), beside_x, in_x), times_plus(all(2), beside_y, in_y));
    const V entering = hn::Sub(hn::Max(latest, side_in), side_in);
    waiting = hn::And(asks, hn::Gt(hn::Abs(gap), times_plus(entering, faster, doubt)));
    unsure = hn::AndNot(waiting, asks);
    walking = hn::AndNot(asks, walks);
    side = hn::IfThenElse(asks, hn::IfThenElse(hn::Gt(gap, zero), zero, below), side);
  }

  const V lowered = hn::Sub(ph, doubt);
  bool fetched = any(waiting);  // all in the cells whose corners were fetched above
  for (;;) {
    // A ray that passes a cell that it might have hit also tests the next two.
    for (int cell = 0; cell < 3 && any(waiting); ++cell) {
      if (!fetched) corners(field.pairs, at, h00, h10, h01, h11);
      fetched = false;
      const V tx = times_plus(kx, ix, qx), ty = times_plus(ky, iy, qy), exit = hn::Min(tx, ty);
      const V i = hn::Sub(kx, ahead_x), j = hn::Sub(ky, ahead_y);
      const V g00 = hn::Sub(h00, middle), g10 = hn::Sub(h10, middle), g01 = hn::Sub(h01, middle), g11 = hn::Sub(h11, middle);
      const M on_x = hn::Lt(tx, ty);
      const V along =
          within_unit(hn::Sub(times_plus(exit, hn::IfThenElse(on_x, dy, dx), hn::IfThenElse(on_x, py, px)), hn::IfThenElse(on_x, j, i)));
      const V a = hn::IfThenElse(on_x, hn::IfThenElse(right, g10, g00), hn::IfThenElse(up, g01, g00));
      const V b = hn::IfThenElse(on_x, hn::IfThenElse(right, g11, g01), hn::IfThenElse(up, g11, g10));
      const V exit_gap = hn::Xor(side, hn::Sub(times_plus(exit, dh, ph), times_plus(along, hn::Sub(b, a), a)));
      const V diagonal = times_plus(hn::Add(hn::Add(i, j), one), is, qs);
      const V along_diagonal = within_unit(hn::Sub(times_plus(diagonal, dx, px), i));
      const V diagonal_gap = hn::Xor(side, hn::Sub(times_plus(diagonal, dh, ph), times_plus(along_diagonal, hn::Sub(g10, g01), g01)));
      const M crosses = hn::And(hn::Lt(t, diagonal), hn::Lt(diagonal, exit)), is_clear_there = hn::Gt(diagonal_gap, doubt);
      // Unchanged for a stopped ray, whose cell and time stay; its corners are fetched again with those of the others.
      in_second = hn::Or(hn::And(crosses, is_clear_there), hn::Le(diagonal, t));
      const M passes = hn::AndNot(hn::AndNot(is_clear_there, crosses), hn::And(waiting, hn::Gt(exit_gap, doubt)));
      guessed = hn::Or(guessed, hn::AndNot(passes, waiting));
      waiting = hn::And(passes, hn::Lt(exit, end));
      kx = hn::IfThenElse(hn::And(waiting, on_x), hn::Add(kx, step_x), kx);
      ky = hn::IfThenElse(hn::AndNot(on_x, waiting), hn::Add(ky, step_y), ky);
      const VI move = hn::IfThenElse(hn::RebindMask(di, on_x), move_x, move_y);
      at = hn::IfThenElse(hn::RebindMask(di, waiting), hn::Add(at, move), at);
      t = hn::IfThenElse(waiting, exit, t);
    }
    walking = hn::Or(walking, waiting);
    waiting = nowhere;
    if (!any(walking)) break;
    // Each ray walks to a cell that it may hit, and waits there for the others. A ray runs a few cells ahead of the check, so that the
    // fetches of several cells overlap.
    do {
      V ahead_kx = kx, ahead_ky = ky, ahead_h = hn::Mul(t, dh);
      VI ahead_at = at;
      _Pragma("GCC unroll 4") for (int cell = 0; cell < cells_ahead; ++cell) {
        const V tx = times_plus(ahead_kx, ix, qx), ty = times_plus(ahead_ky, iy, qy), exit = hn::Min(tx, ty);
        const V top = hn::GatherIndex(d, field.highest, ahead_at);
        const V exit_h = hn::Mul(exit, dh);
        const M is_clear = hn::Gt(hn::Add(hn::Min(ahead_h, exit_h), lowered), hn::Sub(top, middle));
        waiting = hn::Or(waiting, hn::AndNot(is_clear, walking));
        walking = hn::And(walking, hn::And(is_clear, hn::Lt(exit, end)));
        // A ray through a corner passes through the cell beside it, which is tested too.
        const M moves_x = hn::Lt(tx, ty);
        ahead_kx = hn::IfThenElse(moves_x, hn::Add(ahead_kx, step_x), ahead_kx);
        ahead_ky = hn::IfThenElse(moves_x, ahead_ky, hn::Add(ahead_ky, step_y));
        ahead_at = hn::Add(ahead_at, hn::IfThenElse(hn::RebindMask(di, moves_x), move_x, move_y));
        ahead_h = exit_h;
        kx = hn::IfThenElse(walking, ahead_kx, kx);
        ky = hn::IfThenElse(walking, ahead_ky, ky);
        at = hn::IfThenElse(hn::RebindMask(di, walking), ahead_at, at);
        t = hn::IfThenElse(walking, exit, t);
      }
    } while (any(walking));
    if (!any(waiting)) break;
  }
  // A stopped ray stays in its cell, whose corners were fetched with those of the continuing rays.
  out.missed |= bits_of(hn::AndNot(hn::Or(guessed, unsure), walks));
  out.guessed = bits_of(guessed);
  out.upper = bits_of(hn::AndNot(hn::Xor(in_second, to_upper), guessed));
  out.i = hn::Add(hn::Sub(kx, ahead_x), fx);
  out.j = hn::Add(hn::Sub(ky, ahead_y), fy);
  out.h00 = h00, out.h10 = h10, out.h01 = h01, out.h11 = h11;
}

}  // namespace float_walk
