// Intersects rays with a heightfield, written once for any number type R of doubles: one ray, or several side by side. Text only.
//
// Definition of a hit. In the grid, vertices are at whole x and y; a cell is two triangles with the diagonal from (1, 0) to (0, 1). The ray
// is at wall k at time (k - o) (1 / d): one expression, a pure and monotone function of k, so cells [latest entry, earliest exit) cover the
// ray without gaps, and a tie is a step through the corner. At each edge or diagonal that the ray crosses, g = height of the ray - height
// of the edge, by an expression that is the same for both neighbours: a change of the sign of g cannot fall between them. The first change
// is the hit. Its t comes from the plane of the triangle, clamped to the times at the walls of the triangle's cell.
// Tests that skip cells (their highest vertex, the tile's slab, a nearer hit) only leave out intervals in which g does not change its sign,
// or that begin after the nearer hit. So the result does not depend on tiles, lanes or other surfaces.
//
// Requirements for R: + - * /, comparisons to R::Mask, & | ^ of masks and without(a, b) (a and not b), select, R::any, whole(a) (the floor
// of a, for |a| < 2^31), gather(p, i) (p[i], widened), corners(pairs, i, ...) (of the cell after vertex i), minimum and maximum.

/// A ray in the grid's axes: x and y in cells, h along the axis.
template <class R>
struct GridRay {
  R ox, oy, oh, dx, dy, dh, nearest, farthest;
};

/// Moves directions along a wall slightly off it, so that a reciprocal stays finite; 1e-30 cells per unit of t do not matter.
template <class R>
RAINREF_FN R without_zero(R d) {
  return select(abs(d) < R(1e-30), R(1e-30), d);
}

template <class R>
RAINREF_FN R within_unit(R x) {
  return maximum(R(0.0), minimum(R(1.0), x));
}

/// is_level: HeightfieldView::is_level, known at compile time.
template <bool is_level, class R>
RAINREF_FN GridRay<R> to_grid(const HeightfieldView& field, const R (&origin)[3], const R (&direction)[3], R nearest, R farthest) {
  const R x = origin[0] - R(field.origin[0]), y = origin[1] - R(field.origin[1]), z = origin[2] - R(field.origin[2]);
  const auto& m = field.to_grid;
  if constexpr (is_level) {
    return {R(m[0][0]) * x,
            R(m[1][2]) * z,
            R(m[2][1]) * y,
            without_zero(R(m[0][0]) * direction[0]),
            without_zero(R(m[1][2]) * direction[2]),
            R(m[2][1]) * direction[1],
            nearest,
            farthest};
  } else {
    return {R(m[0][0]) * x + R(m[0][1]) * y + R(m[0][2]) * z,
            R(m[1][0]) * x + R(m[1][1]) * y + R(m[1][2]) * z,
            R(m[2][0]) * x + R(m[2][1]) * y + R(m[2][2]) * z,
            without_zero(R(m[0][0]) * direction[0] + R(m[0][1]) * direction[1] + R(m[0][2]) * direction[2]),
            without_zero(R(m[1][0]) * direction[0] + R(m[1][1]) * direction[1] + R(m[1][2]) * direction[2]),
            R(m[2][0]) * direction[0] + R(m[2][1]) * direction[1] + R(m[2][2]) * direction[2],
            nearest,
            farthest};
  }
}

/// The wall through which the ray leaves the cell that contains time t; walls are at times (k - o) inverse.
template <class R>
RAINREF_FN R leaving_wall(R t, R o, R d, R inverse, R ahead, R step, double first, double last) {
  const R k = whole(maximum(R(first), minimum(R(last), o + t * d))) + ahead;
  const auto late = (k - o) * inverse <= t, early = (k - step - o) * inverse > t;
  return select(late, k + step, select(early, k - step, k));
}

/// Time at which the ray is on the plane of a triangle of cell (i, j), and its speed toward it, in height.
template <class R>
RAINREF_FN R meet_plane(const GridRay<R>& r, R i, R j, R upper, typename R::Mask is_upper, R h00, R h10, R h01, R h11, R& closing) {
  const R base = select(is_upper, h11, h00), slope_x = select(is_upper, h11 - h01, h10 - h00),
          slope_y = select(is_upper, h11 - h10, h01 - h00);
  const R x = r.ox - i - upper, y = r.oy - j - upper;
  const R gap = r.oh - (base + (x * slope_x + y * slope_y));
  closing = r.dh - (r.dx * slope_x + r.dy * slope_y);
  return (R(0.0) - gap) / without_zero(closing);
}

/// Intersects the tile with the rays in `active`; `limit` is the nearest known hit. Returns the mask of rays that hit before or at the
/// limit, with t, the part, and the position in the cell.
template <class R>
RAINREF_FN typename R::Mask meet_cells(const HeightfieldView& field, const HeightfieldTile& tile, const GridRay<R>& r, R limit,
                                       typename R::Mask active, R& hit_t, R& hit_part, R& hit_u, R& hit_v) {
  using Mask = typename R::Mask;
  const R zero(0.0), one(1.0), columns(field.columns), stride(field.columns + 1);
  const R ix = one / r.dx, iy = one / r.dy;
  const Mask right = r.dx > zero, up = r.dy > zero, falls = r.dh < zero;
  const R ahead_x = select(right, one, zero), ahead_y = select(up, one, zero);
  const R step_x = select(right, one, R(-1.0)), step_y = select(up, one, R(-1.0));

  // The interval within the tile, and the part of it in the slab of heights.
  const R x_in = (select(right, R(tile.x0), R(tile.x1)) - r.ox) * ix, x_out = (select(right, R(tile.x1), R(tile.x0)) - r.ox) * ix;
  const R y_in = (select(up, R(tile.y0), R(tile.y1)) - r.oy) * iy, y_out = (select(up, R(tile.y1), R(tile.y0)) - r.oy) * iy;
  const R begin = maximum(maximum(x_in, y_in), r.nearest);
  // Up to and including the limit: a hit at the limit may still win by its number.
  const R last = minimum(r.farthest, limit) * R(1 + 0x1p-50) + R(0x1p-1000);
  const R ih = one / without_zero(r.dh);
  const R slab_a = (R(tile.low - tile.margin) - r.oh) * ih, slab_b = (R(tile.high + tile.margin) - r.oh) * ih;
  R t = maximum(begin, minimum(slab_a, slab_b));
  const R end = minimum(minimum(minimum(x_out, y_out), last), maximum(slab_a, slab_b));
  active = active & (t < end);
  const Mask nowhere = without(active, active);
  Mask found = nowhere;
  if (!R::any(active)) return found;
  t = select(active, t, begin);

  // Inactive rays use the tile's first cell, because the data that they fetch must exist.
  R kx = select(active, leaving_wall(t, r.ox, r.dx, ix, ahead_x, step_x, tile.x0, tile.x1 - 1), R(tile.x0) + ahead_x);
  R ky = select(active, leaving_wall(t, r.oy, r.dy, iy, ahead_y, step_y, tile.y0, tile.y1 - 1), R(tile.y0) + ahead_y);
  const R sum_o = r.ox + r.oy, sum_d = without_zero(r.dx + r.dy), is = one / sum_d;
  const Mask to_upper = sum_d > zero;

  const auto difference = [&](R at, R a, R b, R f) RAINREF_LAMBDA { return (r.oh + at * r.dh) - (a * (one - f) + b * f); };
  // g at time `at`, on the wall x (a to b along y), the wall y (c to d along x), or in the corner given by f.
  const auto at_wall = [&](R at, Mask on_x, Mask on_y, R i, R j, R a, R b, R c, R d, R f) RAINREF_LAMBDA {
    const R along = within_unit(select(on_y, r.ox, r.oy) + at * select(on_y, r.dx, r.dy) - select(on_y, i, j));
    return difference(at, select(on_y, c, a), select(on_y, d, b), select(on_x | on_y, along, f));
  };

  // The side on which the ray begins. A ray through the slab's top or bottom is above or below. A ray through a side of the tile has the
  // sign at that wall. A ray that starts here is compared with its triangle.
  Mask above = falls;
  const Mask unknown = active & (t <= begin);
  if (R::any(unknown)) {
    const R i = kx - ahead_x, j = ky - ahead_y, at = select(unknown, j * stride + i, zero);
    R h00 = zero, h10 = zero, h01 = zero, h11 = zero;
    corners(field.pairs, at, h00, h10, h01, h11);
    const R tx = (kx - step_x - r.ox) * ix, ty = (ky - step_y - r.oy) * iy, entry = maximum(tx, ty);
    const R g = at_wall(entry, tx > ty, ty > tx, i, j, select(right, h00, h10), select(right, h01, h11), select(up, h00, h01),
                        select(up, h10, h11), one - ahead_y);
    const R x = within_unit(r.ox + r.nearest * r.dx - i), y = within_unit(r.oy + r.nearest * r.dy - j);
    const R lower = h00 + (x * (h10 - h00) + y * (h01 - h00)), upper = h11 + ((one - x) * (h01 - h11) + (one - y) * (h10 - h11));
    const R inside = (r.oh + r.nearest * r.dh) - select(x + y < one, lower, upper);
    above = (unknown & (select(r.nearest > entry, inside, g) > zero)) | without(falls, unknown);
  }

  const R lowered = r.oh - R(tile.margin), first_cell = zero - (ahead_y * stride + ahead_x);
  R h00 = zero, h10 = zero, h01 = zero, h11 = zero;
  Mask walking = without(active, unknown), waiting = unknown, found_upper = nowhere;
  while (R::any(walking | waiting)) {
    // Each ray walks to a cell that it may hit, and waits there for the others. A ray runs a few cells ahead of the check, so that the
    // fetches of several cells overlap.
    while (R::any(walking)) {
      R ahead_kx = kx, ahead_ky = ky, ahead_t = t;
      _Pragma("GCC unroll 4") for (int cell = 0; cell < cells_ahead; ++cell) {
        const R tx = (ahead_kx - r.ox) * ix, ty = (ahead_ky - r.oy) * iy, exit = minimum(tx, ty);
        const R top = gather(field.highest, ahead_ky * stride + ahead_kx + first_cell);
        const Mask clear = lowered + select(falls, exit, ahead_t) * r.dh > top;
        waiting = waiting | without(walking, clear);
        walking = walking & clear & (exit < end);
        ahead_kx = select(tx <= ty, ahead_kx + step_x, ahead_kx);
        ahead_ky = select(ty <= tx, ahead_ky + step_y, ahead_ky);
        ahead_t = exit;
        kx = select(walking, ahead_kx, kx);
        ky = select(walking, ahead_ky, ky);
        t = select(walking, exit, t);
      }
    }
    if (!R::any(waiting)) break;
    // A ray that passes a cell that it might have hit often hits the next one, so that one is intersected without a check.
    int cells_met = 0;
    do {
      const R tx = (kx - r.ox) * ix, ty = (ky - r.oy) * iy, exit = minimum(tx, ty);
      const R i = kx - ahead_x, j = ky - ahead_y, at = j * stride + i;
      corners(field.pairs, at, h00, h10, h01, h11);
      const R g_exit = at_wall(exit, tx < ty, ty < tx, i, j, select(right, h10, h00), select(right, h11, h01), select(up, h01, h00),
                               select(up, h11, h10), ahead_y);
      const R diagonal = (i + j + one - sum_o) * is;
      const Mask crosses = (t < diagonal) & (diagonal < exit);
      const R g_diagonal = difference(diagonal, h01, h10, within_unit(r.ox + diagonal * r.dx - i));
      const Mask above_then = (crosses & (g_diagonal > zero)) | without(above, crosses), above_at_exit = g_exit > zero;
      const Mask before = above ^ above_then, hit = waiting & (t < exit) & (before | (above_then ^ above_at_exit));
      const Mask upper = (before | (diagonal >= exit)) ^ to_upper;
      found_upper = found_upper | (hit & upper);
      found = found | hit;
      const Mask steps = without(waiting, hit) & (exit < end);
      t = select(steps, exit, t);
      kx = select(steps & (tx <= ty), kx + step_x, kx);
      ky = select(steps & (ty <= tx), ky + step_y, ky);
      waiting = steps;
    } while (++cells_met < 2 && R::any(waiting));
    walking = waiting;
    waiting = nowhere;
  }
  if (!R::any(found)) return found;

  // A ray that hit stays in its cell, whose heights were fetched with those of the continuing rays.
  const R hit_i = kx - ahead_x, hit_j = ky - ahead_y, hit_upper = select(found_upper, one, zero);
  R closing = zero;
  const R on_plane = meet_plane(r, hit_i, hit_j, hit_upper, found_upper, h00, h10, h01, h11, closing);
  const R low_x = (hit_i - r.ox) * ix, high_x = (hit_i + one - r.ox) * ix, low_y = (hit_j - r.oy) * iy, high_y = (hit_j + one - r.oy) * iy;
  const R entry = maximum(maximum(select(right, low_x, high_x), select(up, low_y, high_y)), r.nearest);
  hit_t = minimum(maximum(on_plane, entry), minimum(select(right, high_x, low_x), select(up, high_y, low_y))) + zero;
  hit_u = within_unit(r.ox + hit_t * r.dx - hit_i);
  hit_v = within_unit(r.oy + hit_t * r.dy - hit_j);
  hit_part = (hit_j * columns + hit_i) * R(2.0) + hit_upper;
  return found & (hit_t <= minimum(r.farthest, limit)) & (hit_t >= r.nearest);
}
