// The rows of a pass in lanes: the shell of every pass that computes each texel separately. Re-included for every target, like
// math/lanes-inl.h.
#if defined(RAINREF_PASS_ROWS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAINREF_PASS_ROWS_INL_H_
#undef RAINREF_PASS_ROWS_INL_H_
#else
#define RAINREF_PASS_ROWS_INL_H_
#endif

#include "math/lanes-inl.h"
#include "pass/row_pointers.h"
#include "rainref/executor.h"

HWY_BEFORE_NAMESPACE();
namespace rainref {
namespace HWY_NAMESPACE {

#define RAINREF_FN HWY_INLINE HWY_ATTR
#include "pass/cursor-inl.h"
#undef RAINREF_FN

struct LaneCursors {
  template <Format f, int reach = 0>
  using Texels = TexelCursor<Lanes, typename pass::StorageOf<f>::type, pass::StorageOf<f>::channels, reach>;
  using Sampled = pass::SampledPointer;
  template <Format f>
  using Stored = pass::StoredPointer<typename pass::StorageOf<f>::type>;
  template <class Record>
  using Records = pass::RecordPointer<Record>;
  template <class>
  using List = pass::NoCursor;
  template <class>
  using Changed = pass::NoCursor;
  /// Stores at once, because keeping the lanes would need a constructor of this target.
  template <Format f, Format... others>
  struct Result : pass::ResultPointers<f, others...> {
    using Base = pass::ResultPointers<f, others...>;
    using Base::Base;
    HWY_INLINE HWY_ATTR void operator()(Lanes v) const {
      static_assert(Base::channels == 1);
      store(this->row + this->x, v, this->rounding, this->count);
    }
    HWY_INLINE HWY_ATTR void operator()(const Vec3<Lanes>& v, Lanes w) const {
      static_assert(Base::channels == 4);
      const Lanes c[4] = {v.x, v.y, v.z, w};
      if constexpr (sizeof...(others) == 0) {
        store4(this->row + 4 * this->x, c, this->rounding);
      } else {
        store_as<f>(c);
        (store_as<others>(c), ...);
      }
    }

   private:
    template <Format g>
    HWY_INLINE HWY_ATTR void store_as(const Lanes (&c)[4]) const {
      if (this->format != g) return;
      store4(reinterpret_cast<typename pass::StorageOf<g>::type*>(this->row) + 4 * this->x, c, this->rounding);
    }
  };
};

/// Result of views(io), which a text computes once for a row; this is the default.
struct NoViews {};
template <class Text, class Io>
HWY_INLINE HWY_ATTR auto views_of(const Io& io) {
  if constexpr (requires { Text::views(io); })
    return Text::views(io);
  else
    return NoViews();
}

/// The vector at x, whose neighbours may lie beyond an end of the row. It makes its own cursors: passing those of the row would force them
/// into memory.
template <class P, class Text, bool corrected>
HWY_NOINLINE HWY_ATTR void at_an_end(const typename P::Uniforms& u, Rounding rounding, const pass::HostIo<P>& host, int x, int y, int x1) {
  using Io = typename P::template Io<LaneCursors>;
  constexpr int n = Lanes::size();
  alignas(16) std::byte room[pass::copied_bytes<P, Io>(n)];
  Io io;
  pass::begin_row<P>(host, io, y, rounding);
  pass::move_to<P>(io, x, x1 - x < n ? x1 - x : n);
  pass::copy_ends<P>(host, io, room, pass::width_of<P>(host), n);
  const auto views = views_of<Text>(io);
  if constexpr (std::is_same_v<decltype(views), const NoViews>)
    Text::template run<Lanes, corrected>(u, io, x, y);
  else
    Text::template run<Lanes, corrected>(u, io, views, x, y);
}
template <class P, class Text, bool corrected>
HWY_ATTR void rows_of(const typename P::Uniforms& uniforms, Rounding rounding, const pass::HostIo<P>& host, const parallel::Tile& tile) {
  constexpr int n = Lanes::size(), reach = pass::reach_of<P>;
  const typename P::Uniforms u = uniforms;  // a copy, because stores to an image must not seem to change it
  const int width = pass::width_of<P>(host), x1 = tile.x1;
  for (int y = tile.y0; y < tile.y1; ++y) {
    typename P::template Io<LaneCursors> io;
    pass::begin_row<P>(host, io, y, rounding);
    const auto views = views_of<Text>(io);
    for (int x = tile.x0; x < x1; x += n) {
      if (reach != 0 && (x < reach || x + n + reach > width)) {
        at_an_end<P, Text, corrected>(uniforms, rounding, host, x, y, x1);
      } else {
        pass::move_to<P>(io, x, x1 - x < n ? x1 - x : n);
        if constexpr (std::is_same_v<decltype(views), const NoViews>)
          Text::template run<Lanes, corrected>(u, io, x, y);
        else
          Text::template run<Lanes, corrected>(u, io, views, x, y);
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rainref
HWY_AFTER_NAMESPACE();

// For the target's namespace of a room, after the arithmetic of pass P.
#undef RAINREF_PASS_ROWS
#define RAINREF_PASS_ROWS(P)                                                                                                              \
  HWY_ATTR void P##Rows(const P::Uniforms& u, bool corrected, Rounding rounding, const pass::HostIo<P>& io, const parallel::Tile& tile) { \
    if constexpr (P::about.corrected.revision != 0)                                                                                       \
      if (corrected) return rows_of<P, P##Text, true>(u, rounding, io, tile);                                                             \
    if constexpr (P::about.as_published.revision != 0)                                                                                    \
      if (!corrected) return rows_of<P, P##Text, false>(u, rounding, io, tile);                                                           \
  }
// Once, outside every namespace. The dispatch table is in the room, because if only one target is compiled, its namespace is named.
#undef RAINREF_PASS_DISPATCH
#define RAINREF_PASS_DISPATCH(room, P)                                                                                                 \
  namespace rainref::room {                                                                                                            \
  RAINREF_EXPORT(P##Rows);                                                                                                             \
  static void P##Dispatched(const P::Uniforms& u, bool corrected, Rounding rounding, const pass::HostIo<P>& io,                        \
                            const parallel::Tile& tile) {                                                                              \
    RAINREF_DISPATCH(P##Rows)(u, corrected, rounding, io, tile);                                                                       \
  }                                                                                                                                    \
  }                                                                                                                                    \
  template <>                                                                                                                          \
  void rainref::pass::rows<rainref::room::P>(const rainref::room::P::Uniforms& u, bool corrected, Rounding rounding,                   \
                                             const rainref::pass::HostIo<rainref::room::P>& io, const rainref::parallel::Tile& tile) { \
    rainref::room::P##Dispatched(u, corrected, rounding, io, tile);                                                                    \
  }

#endif  // RAINREF_PASS_ROWS_INL_H_
