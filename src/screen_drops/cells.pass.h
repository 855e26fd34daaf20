// Pass cells, corrected: the drop that a cell holds now, from whole numbers of 16 bits that cells.h draws, as shares.

/// In cells: centre, radius of the base; and how far its cycle has come. Radius 0: none.
template <class N>
struct CellDrop {
  N x, y, radius, phase;
};
/// Largest radius R of this cycle: density ~ R^-3 between largest / 2 and largest, so that layers of half the size each go on
/// with it. The area of the base grows to pi R^2 in the impact's share of the cycle and then dwindles, both evenly in time. The
/// whole cap stays inside its cell.
template <class N>
RAINREF_FN CellDrop<N> cell_drop(const CellsUniforms& c, N size, N x, N y, N phase) {
  const N one(1.0f), half(0.5f);
  const N reach = N(c.largest) / sqrt(one + N(3.0f) * size);
  const N share = min(phase * uniform_quotient(1.0f, c.impact, N()), (one - phase) * uniform_quotient(1.0f, 1.0f - c.impact, N()));
  const N room = one - N(2.0f) * reach;
  return {half + (x - half) * room, half + (y - half) * room, reach * sqrt(max(share, N(0.0f))), phase};
}
