// Records of a list in lanes: the shell of every pass that treats each record separately. Re-included for every target, like
// math/lanes-inl.h; after pass/rows-inl.h.
#if defined(RAINREF_PASS_RECORDS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RAINREF_PASS_RECORDS_INL_H_
#undef RAINREF_PASS_RECORDS_INL_H_
#else
#define RAINREF_PASS_RECORDS_INL_H_
#endif

#include <algorithm>
#include <cstdint>

#include "math/lane_pair-inl.h"
#include "pass/rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rainref {
namespace HWY_NAMESPACE {

/// The first `count` values from p; the rest are 0.
HWY_INLINE HWY_ATTR Lanes load_some(const float* p, int count) {
  if (HWY_LIKELY(count == Lanes::size())) return Lanes::load(p);
  HWY_ALIGN float block[HWY_MAX_BYTES / sizeof(float)] = {};
  std::copy_n(p, count, block);
  return Lanes::load(block);
}
template <class N>
HWY_INLINE HWY_ATTR N load_some_of(const float* p, int count) {
  constexpr int n = Lanes::size();
  if constexpr (N::size() == n)
    return load_some(p, count);
  else
    return N(load_some(p, std::min(count, n)), load_some(p + n, std::max(count - n, 0)));
}
/// Changes records [begin, end) of the columns in place; a vector without records is left unchanged. then(first, count, before, given)
/// receives the text's results for `count` records from `first` on, including results beside the record. N: Lanes, or LanePair for a long
/// text.
template <class P, class Text, bool corrected, class N = Lanes, class Then>
HWY_INLINE HWY_ATTR void change_records(const typename P::Uniforms& uniforms, const pass::HostIo<P>& host,
                                        const std::vector<float*>& columns, std::int64_t begin, std::int64_t end, const Then& then) {
  using State = typename Text::template State<N>;
  const typename P::Uniforms u = uniforms;  // a copy, because stores to a column must not seem to change it
  typename P::template Io<LaneCursors> io;
  pass::begin_row<P>(host, io, 0, Rounding::rne);
  float* const* const column = columns.data();
  for (std::int64_t i = begin; i < end; i += N::size()) {
    const int count = static_cast<int>(std::min<std::int64_t>(N::size(), end - i));
    State before;
    int k = 0;
    State::each(before, [&](N& number) HWY_ATTR { number = load_some_of<N>(column[k++] + i, count); });
    if (!any(before.lives())) continue;
    const auto given = Text::template run_record<N, corrected>(u, io, before);
    k = 0;
    State::each(given, [&](const N& number) HWY_ATTR {
      if (Text::template gives<corrected>(k)) store(column[k] + i, number, Rounding::rne, count);
      ++k;
    });
    then(i, count, before, given);
  }
}
/// For a pass that takes no records and makes one.
template <class P, class Text, bool corrected>
HWY_INLINE HWY_ATTR void give_record(const typename P::Uniforms& u, const pass::HostIo<P>& host, const std::vector<float*>& columns) {
  typename P::template Io<LaneCursors> io;
  pass::begin_row<P>(host, io, 0, Rounding::rne);
  const auto given = Text::template run_record<Lanes, corrected>(u, io);
  int k = 0;
  Text::template State<Lanes>::each(
      given, [&](const Lanes& number) HWY_ATTR { store(columns[static_cast<std::size_t>(k++)], number, Rounding::rne, 1); });
}

}  // namespace HWY_NAMESPACE
}  // namespace rainref
HWY_AFTER_NAMESPACE();

#endif  // RAINREF_PASS_RECORDS_INL_H_
