// Hits of a heightfield in lanes of doubles. Re-included for every target.
#if defined(RAINREF_COMPOSITOR_HIT_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAINREF_COMPOSITOR_HIT_LANES_INL_H_
#undef RAINREF_COMPOSITOR_HIT_LANES_INL_H_
#else
#define RAINREF_COMPOSITOR_HIT_LANES_INL_H_
#endif

#include "compositor/surface.h"
#include "math/double_lanes-inl.h"

RAINREF_TARGET_BEGIN(compositor)

/// The cells of a vector of hits.
struct CellLanes {
  DoubleLanes::Int x, y, upper;  ///< decoded part: 2 (y columns + x) + upper
  DoubleLanes u, v;
  HWY_INLINE HWY_ATTR CellLanes(const Hit* hits, int columns) {
    using N = DoubleLanes;
    static_assert(sizeof(Hit) == 4 * sizeof(double));
    const N::DI di;
    const auto parts = hn::GatherIndex(di, reinterpret_cast<const std::int32_t*>(&hits->part), hn::ShiftLeft<3>(hn::Iota(di, 0)));
    const auto apart = hn::ShiftLeft<2>(hn::Iota(hn::RebindToSigned<N::D>(), 0));
    u = hn::GatherIndex(N::D(), &hits->u, apart);
    v = hn::GatherIndex(N::D(), &hits->v, apart);
    // Parts are below 2^31, where the rounded quotient has the integer part of the exact one.
    const N::Int cell(hn::ShiftRight<1>(parts));
    y = to_int(floor(to_number(cell) / N(static_cast<double>(columns))));
    x = cell + y * -columns;
    upper = hn::And(parts, hn::Set(di, 1));
  }
};

HWY_INLINE HWY_ATTR void put(const Vec3<DoubleLanes>& v, std::size_t i, const VecArraysOut& to) {
  hn::StoreU(v.x.v, DoubleLanes::D(), to.component[0] + i);
  hn::StoreU(v.y.v, DoubleLanes::D(), to.component[1] + i);
  hn::StoreU(v.z.v, DoubleLanes::D(), to.component[2] + i);
}

RAINREF_TARGET_END(compositor)

#endif  // RAINREF_COMPOSITOR_HIT_LANES_INL_H_
