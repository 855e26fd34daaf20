// Faster lookups of sampling-inl.h for lanes. A gather costs per element, so the channels of a texel, and the two texels of a row in a
// bilinear lookup, are gathered as one word. The values are the same. Text only: include it right after sampling-inl.h.
#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
/// If all lanes need one level, as neighbouring elements mostly do, it is a uniform level.
template <class N, class T>
requires(std::same_as<N, Lanes>) RAINREF_FN bool is_uniform(const T& t, const typename N::Int& level, Level<N>& out) {
  const std::int32_t first = hn::GetLane(level.i);
  if (!hn::AllTrue(Lanes::DI(), hn::Eq(level.i, hn::Set(Lanes::DI(), first)))) return false;
  out = uniform_level<N>(t, first);
  return true;
}
/// 32-bit words a and b (low and high half of the lanes) of 64-bit elements, separated.
struct WordPair {
  hn::Vec<Lanes::DI> first, second;
};
/// Offsets of the lanes, below 2^32, one by one. Two of them leave the vector as one word; they are unsigned, so no sign extension is
/// needed.
struct ByteOffsets {
  HWY_ALIGN std::uint64_t two[HWY_MAX_BYTES / sizeof(std::uint64_t)];
  HWY_INLINE HWY_ATTR explicit ByteOffsets(hn::Vec<Lanes::DI> bytes) {
    const hn::Repartition<std::uint64_t, Lanes::DI> d;
    hn::Store(hn::BitCast(d, bytes), d, two);
  }
  HWY_INLINE HWY_ATTR std::size_t operator[](int lane) const {
    const std::uint64_t both = two[lane / 2];
    return lane % 2 == 0 ? static_cast<std::uint32_t>(both) : both >> 32;
  }
};
/// Two neighbouring 32-bit words from each byte offset on, as 8-byte loads, because some processors gather more slowly.
RAINREF_FN WordPair gather_words(const void* from, hn::Vec<Lanes::DI> bytes) {
  const Lanes::DI d;
  const ByteOffsets at(bytes);
  const auto one = [&](int i) RAINREF_LAMBDA {
    return hn::LoadU(hn::Full64<std::int32_t>(), reinterpret_cast<const std::int32_t*>(static_cast<const char*>(from) + at[i]));
  };
  const auto two = [&](int i) RAINREF_LAMBDA { return hn::Combine(hn::Full128<std::int32_t>(), one(i + 1), one(i)); };
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
  const auto four = [&](int i) RAINREF_LAMBDA { return hn::Combine(hn::Full256<std::int32_t>(), two(i + 2), two(i)); };
#if HWY_TARGET <= HWY_AVX3
  const auto low = hn::Combine(d, four(4), four(0)), high = hn::Combine(d, four(12), four(8));
#else
  const auto low = four(0), high = four(4);
#endif
#else
  const auto low = two(0), high = two(2);
#endif
  return {hn::ConcatEven(d, high, low), hn::ConcatOdd(d, high, low)};
}
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
/// Widens the halves in the low and in the high 16 bits of each word.
RAINREF_FN Lanes widen_low(hn::Vec<Lanes::DI> words) {
  const hn::Rebind<hwy::float16_t, Lanes::D> d16;
  return hn::PromoteTo(Lanes::D(), hn::BitCast(d16, hn::TruncateTo(Lanes::DH(), hn::BitCast(Lanes::DU(), words))));
}
RAINREF_FN Lanes widen_high(hn::Vec<Lanes::DI> words) {
  return widen_low(hn::BitCast(Lanes::DI(), hn::ShiftRight<16>(hn::BitCast(Lanes::DU(), words))));
}
#endif

/// The two texels of a row: the one at `left`, and the one at `right`, which is its neighbour or, at an edge, the same.
struct TexelPair {
  Lanes left, right;
};
/// Four words from each byte offset on, separated: one 16-byte load for each lane instead of two or four gathers.
struct FourWords {
  hn::Vec<Lanes::DI> word[4];
  HWY_INLINE HWY_ATTR FourWords() {}
};
RAINREF_FN FourWords load_words(const void* from, hn::Vec<Lanes::DI> bytes) {
  const Lanes::DI d;
  const hn::Repartition<std::int64_t, Lanes::DI> pairs;
  const ByteOffsets at(bytes);
  const auto block = [&](int i) RAINREF_LAMBDA {
    return hn::LoadU(hn::Full128<std::int32_t>(), reinterpret_cast<const std::int32_t*>(static_cast<const char*>(from) + at[i]));
  };
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
  const auto two = [&](int i) RAINREF_LAMBDA { return hn::Combine(hn::Full256<std::int32_t>(), block(i + 4), block(i)); };
#endif
  // For lanes i, i + 4, i + 8 ...: a block of 16 bytes each.
  const auto every_fourth = [&](int i) RAINREF_LAMBDA {
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX3
    return hn::Combine(d, two(i + 8), two(i));
#elif HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
    return two(i);
#else
    return block(i);
#endif
  };
  const auto a = every_fourth(0), b = every_fourth(1), c = every_fourth(2), e = every_fourth(3);
  const auto ab = hn::BitCast(pairs, hn::InterleaveLower(d, a, b)), ce = hn::BitCast(pairs, hn::InterleaveLower(d, c, e));
  const auto ab_high = hn::BitCast(pairs, hn::InterleaveUpper(d, a, b)), ce_high = hn::BitCast(pairs, hn::InterleaveUpper(d, c, e));
  FourWords out;
  out.word[0] = hn::BitCast(d, hn::InterleaveLower(pairs, ab, ce));
  out.word[1] = hn::BitCast(d, hn::InterleaveUpper(pairs, ab, ce));
  out.word[2] = hn::BitCast(d, hn::InterleaveLower(pairs, ab_high, ce_high));
  out.word[3] = hn::BitCast(d, hn::InterleaveUpper(pairs, ab_high, ce_high));
  return out;
}
template <int First, int Count, class N, class T, class Line>
requires(std::same_as<N, Lanes>&& std::same_as<typename T::Stored, float> && (T::channels == 2 || T::channels == 4) &&
         T::address_u != Address::border && T::address_v != Address::border && First % 2 == 0 &&
         Count == 2) RAINREF_FN Channels<N, Count> load_texel(const T& t, const Line& column, const Line& row) {
  const auto bytes = hn::ShiftLeft<2>((row.place + column.place).i);
  Channels<N, Count> out;
  RAINREF_UNROLL for (int k = 0; k < Count; k += 2) {
    const WordPair pair = gather_words(t.texels + First + k, bytes);
    out[k] = hn::BitCast(Lanes::D(), pair.first);
    if (k + 1 < Count) out[k + 1] = hn::BitCast(Lanes::D(), pair.second);
  }
  return out;
}
template <int First, int Count, class N, class T, class Line>
requires(std::same_as<N, Lanes>&& std::same_as<typename T::Stored, float>&& T::channels == 4 && T::address_u != Address::border &&
         T::address_v != Address::border &&
         Count > 2) RAINREF_FN Channels<N, Count> load_texel(const T& t, const Line& column, const Line& row) {
  const FourWords w = load_words(t.texels, hn::ShiftLeft<2>((row.place + column.place).i));
  Channels<N, Count> out;
  RAINREF_UNROLL for (int k = 0; k < Count; ++k) out[k] = hn::BitCast(Lanes::D(), w.word[First + k]);
  return out;
}
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
template <int First, int Count, class N, class T, class Line>
requires(std::same_as<N, Lanes>&& std::same_as<typename T::Stored, Half>&& T::channels == 4 && First == 0 &&
         Count > 2) RAINREF_FN Channels<N, Count> load_texel(const T& t, const Line& column, const Line& row) {
  const WordPair pair = gather_words(t.texels, hn::ShiftLeft<1>((row.place + column.place).i));
  Channels<N, Count> out;
  out[0] = widen_low(pair.first);
  out[1] = widen_high(pair.first);
  out[2] = widen_low(pair.second);
  if constexpr (Count > 3) out[3] = widen_high(pair.second);
  return out;
}
template <int First, int Count, class N, class T, class Line>
requires(std::same_as<N, Lanes>&& std::same_as<typename T::Stored, Half>&& T::channels == 4 && First % 2 == 0 &&
         Count <= 2) RAINREF_FN Channels<N, Count> load_texel(const T& t, const Line& column, const Line& row) {
  const auto words = hn::GatherOffset(Lanes::DI(), reinterpret_cast<const std::int32_t*>(t.texels + First),
                                      hn::ShiftLeft<1>((row.place + column.place).i));
  Channels<N, Count> out;
  out[0] = widen_low(words);
  if constexpr (Count > 1) out[1] = widen_high(words);
  return out;
}

template <class T, class Line>
RAINREF_FN TexelPair load_pair(const T& t, const Line& left, const Line& right, const Line& row) {
  const auto place = (row.place + left.place).i;
  const Lanes::Mask same{hn::RebindMask(Lanes::D(), hn::Eq(left.place.i, right.place.i))};
  if constexpr (std::same_as<typename T::Stored, Half>) {
    const auto words = hn::GatherOffset(Lanes::DI(), reinterpret_cast<const std::int32_t*>(t.texels), hn::ShiftLeft<1>(place));
    const Lanes first = widen_low(words);
    return {first, select(same, first, widen_high(words))};
  } else {
    const WordPair pair = gather_words(t.texels, hn::ShiftLeft<2>(place));
    const Lanes first = hn::BitCast(Lanes::D(), pair.first);
    return {first, select(same, first, Lanes(hn::BitCast(Lanes::D(), pair.second)))};
  }
}
template <int First, int Count, class N, class T>
requires(std::same_as<N, Lanes>&& Pitched<T>&& T::channels == 1 && T::address_u == Address::clamp && Count == 1 &&
         First == 0) RAINREF_FN Channels<N, Count> sample_level(const T& t, const Level<N>& l, N u, N v) {
  const N x = texel_coordinate(t.address_u, u, l.width_number), y = texel_coordinate(t.address_v, v, l.height_number);
  const N x0 = floor(x), y0 = floor(y);
  const auto xi = to_int(x0), yi = to_int(y0);
  const auto left = texel_column<N>(t, l, xi), right = texel_column<N>(t, l, xi + 1);
  const TexelPair low = load_pair(t, left, right, texel_row<N>(t, l, yi)), high = load_pair(t, left, right, texel_row<N>(t, l, yi + 1));
  Channels<N, Count> out;
  out[0] = blend(t.precision, low.left, low.right, high.left, high.right, x - x0, y - y0);
  return out;
}
#endif
/// For a texture without readable bytes after it: the pair ends at the last column.
template <int First, int Count, class N, class T>
requires(std::same_as<N, Lanes>&& std::same_as<typename T::Stored, float> && !Pitched<T> && T::channels == 1 &&
         (T::address_u == Address::clamp || T::address_u == Address::repeat) && T::address_v != Address::border && Count == 1 &&
         First == 0) RAINREF_FN Channels<N, Count> sample_level(const T& t, const Level<N>& l, N u, N v) {
  const N x = texel_coordinate(t.address_u, u, l.width_number), y = texel_coordinate(t.address_v, v, l.height_number);
  const N x0 = floor(x), y0 = floor(y), fx = x - x0, fy = y - y0;
  const auto xi = to_int(x0), yi = to_int(y0);
  const auto low = texel_row<N>(t, l, yi), high = texel_row<N>(t, l, yi + 1);
  Channels<N, Count> out;
  if (t.levels == 1 && t.width[0] >= 2) {
    const auto column = texel_column<N>(t, l, xi).place, before_last = l.width + -2;
    const auto first = hn::Min(column.i, before_last.i);
    const Lanes::Mask at_last{hn::RebindMask(Lanes::D(), hn::Gt(column.i, before_last.i))};
    const bool wraps = T::address_u == Address::repeat && any(at_last);
    const auto pair = [&](const auto& row) RAINREF_LAMBDA {
      const WordPair words = gather_words(t.texels, hn::ShiftLeft<2>(hn::Add(row.place.i, first)));
      const Lanes second(hn::BitCast(Lanes::D(), words.second));
      // The neighbour of the last column is itself or, for repeat, the first column.
      const Lanes right = wraps ? select(at_last, fetch(t.texels, row.place, N()), second) : second;
      return TexelPair{select(at_last, second, Lanes(hn::BitCast(Lanes::D(), words.first))), right};
    };
    const TexelPair a = pair(low), b = pair(high);
    out[0] = blend(t.precision, a.left, a.right, b.left, b.right, fx, fy);
  } else {
    const auto left = texel_column<N>(t, l, xi), right = texel_column<N>(t, l, xi + 1);
    const auto texel = [&](const auto& column, const auto& row) RAINREF_LAMBDA { return load_texel<0, 1, N>(t, column, row)[0]; };
    out[0] = blend(t.precision, texel(left, low), texel(right, low), texel(left, high), texel(right, high), fx, fy);
  }
  return out;
}

/// With a border: values outside are not read from a texel.
template <int First, int Count, class N, class T>
requires(std::same_as<N, Lanes>&& std::same_as<typename T::Stored, float> && !Pitched<T> && T::channels == 1 &&
         T::address_u == Address::border && T::address_v == Address::border && Count == 1 &&
         First == 0) RAINREF_FN Channels<N, Count> sample_level(const T& t, const Level<N>& l, N u, N v) {
  const N x = texel_coordinate(t.address_u, u, l.width_number), y = texel_coordinate(t.address_v, v, l.height_number);
  const N x0 = floor(x), y0 = floor(y), fx = x - x0, fy = y - y0, border(t.border[0]), zero(0.0f), one(1.0f);
  // For texel x0 and the next one; the coordinate lies in [-1, size].
  const N last_x = l.width_number - one, last_y = l.height_number - one;
  const auto left = (x0 >= zero) & (x0 <= last_x), right = x0 < last_x, low = (y0 >= zero) & (y0 <= last_y), high = y0 < last_y;
  Channels<N, Count> out;
  TexelPair a{border, border}, b = a;
  if (any((left | right) & (low | high))) {
    const auto xi = to_int(x0), yi = to_int(y0);
    const auto first = texel_column<N>(t, l, xi), second = texel_column<N>(t, l, xi + 1);
    const auto row = texel_row<N>(t, l, yi), next = texel_row<N>(t, l, yi + 1);
    if (t.levels == 1 && t.width[0] >= 2) {
      const auto column = hn::Min(first.place.i, (l.width + -2).i);
      const Lanes::Mask at_last{hn::RebindMask(Lanes::D(), hn::Gt(first.place.i, column))};
      const auto pair = [&](const auto& line) RAINREF_LAMBDA {
        const WordPair words = gather_words(t.texels, hn::ShiftLeft<2>(hn::Add(line.place.i, column)));
        const Lanes here(hn::BitCast(Lanes::D(), words.first)), there(hn::BitCast(Lanes::D(), words.second));
        return TexelPair{select(at_last, there, here), select(x0 < zero, here, there)};
      };
      a = pair(row);
      b = pair(next);
    } else {
      a = {fetch(t.texels, row.place + first.place, N()), fetch(t.texels, row.place + second.place, N())};
      b = {fetch(t.texels, next.place + first.place, N()), fetch(t.texels, next.place + second.place, N())};
    }
    a = {select(left & low, a.left, border), select(right & low, a.right, border)};
    b = {select(left & high, b.left, border), select(right & high, b.right, border)};
  }
  out[0] = blend(t.precision, a.left, a.right, b.left, b.right, fx, fy);
  return out;
}
/// The twelve texels are four from each of two rows and two from each of two more rows, unless a lane reads over an edge.
template <int Channel, class N, class T>
requires(std::same_as<N, Lanes>&& std::same_as<typename T::Stored, float> && !Pitched<T> && T::channels == 1 && Channel == 0 &&
         T::address_u == Address::clamp &&
         T::address_v == Address::clamp) RAINREF_FN Neighbours<N> sample_neighbours(const T& t, N u, N v) {
  const Level<N> l = uniform_level<N>(t, 0);
  const N x = texel_coordinate(t.address_u, u, l.width_number), y = texel_coordinate(t.address_v, v, l.height_number);
  const N x0 = floor(x), y0 = floor(y), fx = x - x0, fy = y - y0, one(1.0f), two(2.0f);
  const auto xi = to_int(x0), yi = to_int(y0);
  // Rows p q r s, columns 0 to 3.
  N p1, p2, q0, q1, q2, q3, r0, r1, r2, r3, s1, s2;
  const auto within = (x0 >= one) & (x0 + two < l.width_number) & (y0 >= one) & (y0 + two < l.height_number);
  if (any(!within)) {
    const auto a = texel_column<N>(t, l, xi + -1), b = texel_column<N>(t, l, xi), c = texel_column<N>(t, l, xi + 1),
               d = texel_column<N>(t, l, xi + 2);
    const auto p = texel_row<N>(t, l, yi + -1), q = texel_row<N>(t, l, yi), r = texel_row<N>(t, l, yi + 1), s = texel_row<N>(t, l, yi + 2);
    const auto texel = [&](const auto& column, const auto& row) RAINREF_LAMBDA { return load_texel<0, 1, N>(t, column, row)[0]; };
    p1 = texel(b, p), p2 = texel(c, p);
    q0 = texel(a, q), q1 = texel(b, q), q2 = texel(c, q), q3 = texel(d, q);
    r0 = texel(a, r), r1 = texel(b, r), r2 = texel(c, r), r3 = texel(d, r);
    s1 = texel(b, s), s2 = texel(c, s);
  } else {
    const auto pitch = hn::ShiftLeft<2>(l.width.i);
    const auto q = hn::Add(hn::Mul(yi.i, pitch), hn::ShiftLeft<2>(xi.i)), r = hn::Add(q, pitch);
    const auto number = [](hn::Vec<Lanes::DI> word) RAINREF_LAMBDA { return Lanes(hn::BitCast(Lanes::D(), word)); };
    const auto two_of = [&](N& first, N& second, hn::Vec<Lanes::DI> place) RAINREF_LAMBDA {
      const WordPair w = gather_words(t.texels, place);
      first = number(w.first), second = number(w.second);
    };
    const auto four_of = [&](N& a, N& b, N& c, N& d, hn::Vec<Lanes::DI> place) RAINREF_LAMBDA {
      const FourWords w = load_words(t.texels - 1, place);
      a = number(w.word[0]), b = number(w.word[1]), c = number(w.word[2]), d = number(w.word[3]);
    };
    two_of(p1, p2, hn::Sub(q, pitch));
    four_of(q0, q1, q2, q3, q);
    four_of(r0, r1, r2, r3, r);
    two_of(s1, s2, hn::Add(r, pitch));
  }
  const auto filtered = [&](N e, N f, N g, N h) RAINREF_LAMBDA { return blend(t.precision, e, f, g, h, fx, fy); };
  return {filtered(q0, q1, r0, r1), filtered(q2, q3, r2, r3), filtered(p1, p2, q1, q2), filtered(r1, r2, s1, s2)};
}

#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
/// The same for four halves per texel.
template <int Count>
struct ColourPair {
  Channels<Lanes, Count> left, right;
  RAINREF_FN ColourPair() {}
};
template <int First, int Count, class T, class Line>
RAINREF_FN ColourPair<Count> load_colours(const T& t, const Line& left, const Line& right, const Line& row) {
  const FourWords w = load_words(t.texels, hn::ShiftLeft<1>((row.place + left.place).i));
  const auto same = hn::Eq(left.place.i, right.place.i);
  ColourPair<Count> out;
  RAINREF_UNROLL for (int k = 0; k < Count; ++k) {
    const auto first = w.word[(First + k) / 2], second = hn::IfThenElse(same, first, w.word[2 + (First + k) / 2]);
    out.left[k] = (First + k) % 2 == 0 ? widen_low(first) : widen_high(first);
    out.right[k] = (First + k) % 2 == 0 ? widen_low(second) : widen_high(second);
  }
  return out;
}
template <int First, int Count, class N, class T>
requires(std::same_as<N, Lanes>&& Pitched<T>&& std::same_as<typename T::Stored, Half>&& T::channels == 4 &&
         T::address_u == Address::clamp && Count > 1) RAINREF_FN Channels<N, Count> sample_level(const T& t, const Level<N>& l, N u, N v) {
  const N x = texel_coordinate(t.address_u, u, l.width_number), y = texel_coordinate(t.address_v, v, l.height_number);
  const N x0 = floor(x), y0 = floor(y), fx = x - x0, fy = y - y0;
  const auto xi = to_int(x0), yi = to_int(y0);
  const auto left = texel_column<N>(t, l, xi), right = texel_column<N>(t, l, xi + 1);
  const auto low = load_colours<First, Count>(t, left, right, texel_row<N>(t, l, yi));
  const auto high = load_colours<First, Count>(t, left, right, texel_row<N>(t, l, yi + 1));
  Channels<N, Count> out;
  RAINREF_UNROLL for (int k = 0; k < Count; ++k) out[k] =
      blend(t.precision, low.left[k], low.right[k], high.left[k], high.right[k], fx, fy);
  return out;
}
#endif
#endif
