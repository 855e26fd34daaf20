// The texel loads of sampling-inl.h for lanes and textures of four channels: channels are gathered in pairs, because a gather
// costs by the element. The same values. Text only: include it right after sampling-inl.h.
#if HWY_TARGET <= HWY_AVX2
template <int First, int Count, class N, class T, class Line>
  requires(std::same_as<N, Lanes> && T::channels == 4 && T::address_u != Address::border && T::address_v != Address::border && First % 2 == 0 && Count > 1)
RAINREF_FN Channels<N, Count> load_texel(const T& t, const Line& column, const Line& row) {
  const Lanes::DI d;
  const hn::RepartitionToWide<Lanes::DI> wide;
  const auto bytes = hn::ShiftLeft<2>((row.place + column.place).i);
  const hn::Half<Lanes::DI> half;
  const auto low = hn::PromoteTo(wide, hn::LowerHalf(half, bytes)), high = hn::PromoteTo(wide, hn::UpperHalf(half, bytes));
  Channels<N, Count> out;
  RAINREF_UNROLL for (int k = 0; k < Count; k += 2) {
    const auto* base = reinterpret_cast<const std::int64_t*>(t.texels + First + k);
    const auto a = hn::BitCast(d, hn::GatherOffset(wide, base, low)), b = hn::BitCast(d, hn::GatherOffset(wide, base, high));
    out[k] = hn::BitCast(Lanes::D(), hn::ConcatEven(d, b, a));
    if (k + 1 < Count) out[k + 1] = hn::BitCast(Lanes::D(), hn::ConcatOdd(d, b, a));
  }
  return out;
}
#endif
