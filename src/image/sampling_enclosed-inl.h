// The lookups of sampling-inl.h for enclosures. Text only: include it right after sampling-inl.h, in the same namespace, with
// image/footprint.h before both. Overload resolution prefers them for Enclosure.
//
// A filtered lookup is continuous. It returns the hull over the cells that its coordinates touch, and decides nothing. An unfiltered lookup
// and the choice of a mip level are discontinuous, so they are decided. If the profile has a sampler, the lookup allows the sampler's
// coordinate error.

/// The same number as the reference's, for points under the profile `ieee`.
template <class T>
RAINREF_FN Level<scalar::Scalar<float>> plain_level(const Level<T>& l) {
  Level<scalar::Scalar<float>> out;
  out.width = {l.width.i};
  out.height = {l.height.i};
  out.offset = {l.offset.i};
  out.pitch = {l.pitch.i};
  out.width_number = scalar::Scalar<float>(l.width_number.lo);
  out.height_number = scalar::Scalar<float>(l.height_number.lo);
  return out;
}
inline bool as_reference(enclosed::Enclosure u, enclosed::Enclosure v) {
  return enclosed::profile().reference && u.is_point() && v.is_point();
}
template <int Count>
RAINREF_FN Channels<enclosed::Enclosure, Count> points(const Channels<scalar::Scalar<float>, Count>& texel) {
  Channels<enclosed::Enclosure, Count> out;
  for (int k = 0; k < Count; ++k) out[k] = enclosed::Enclosure(texel[k].v);
  return out;
}
template <class T>
RAINREF_FN enclosed::Texels texels_of(const T& t, const Level<enclosed::Enclosure>& l) {
  const float* first = t.texels + static_cast<std::ptrdiff_t>(l.offset.i) * t.channels;
  return {first, t.channels, l.width.i, l.height.i, t.address_u, t.address_v, t.border, t.precision};
}

template <int First, int Count, class N, class T>
requires std::same_as<N, enclosed::Enclosure> RAINREF_FN Channels<N, Count> sample_nearest(const T& t, N u, N v) {
  using Single = scalar::Scalar<float>;
  if (as_reference(u, v)) return points(sample_nearest<First, Count, Single>(t, Single(u.lo), Single(v.lo)));
  const enclosed::Texels texels = texels_of(t, uniform_level<N>(t, 0));
  const enclosed::Span x = nearest_span(t.address_u, u, texels.width), y = nearest_span(t.address_v, v, texels.height);
  const enclosed::Pick choice = pick(x, y);
  Channels<N, Count> out;
  for (int k = 0; k < Count; ++k) out[k] = picked(texels, x, y, choice, First + k);
  return out;
}

template <int First, int Count, class N, class T>
requires std::same_as<N, enclosed::Enclosure> RAINREF_FN Channels<N, Count> sample_level(const T& t, const Level<N>& l, N u, N v) {
  using Single = scalar::Scalar<float>;
  if (as_reference(u, v)) {
    return points(sample_level<First, Count, Single>(t, plain_level(l), Single(u.lo), Single(v.lo)));
  }
  const enclosed::Texels texels = texels_of(t, l);
  const enclosed::Span x = filtered_span(t.address_u, u, texels.width);
  const enclosed::Span y = filtered_span(t.address_v, v, texels.height);
  Channels<N, Count> out;
  for (int k = 0; k < Count; ++k) out[k] = filtered(texels, x, y, First + k);
  return out;
}

template <int Channel, class N, class T>
requires std::same_as<N, enclosed::Enclosure> RAINREF_FN Neighbours<N> sample_neighbours(const T& t, N u, N v) {
  using Single = scalar::Scalar<float>;
  if (as_reference(u, v)) {
    const Neighbours<Single> near = sample_neighbours<Channel, Single>(t, Single(u.lo), Single(v.lo));
    return {N(near.left.v), N(near.right.v), N(near.down.v), N(near.up.v)};
  }
  const enclosed::Texels texels = texels_of(t, uniform_level<N>(t, 0));
  const enclosed::Span x = filtered_span(t.address_u, u, texels.width);
  const enclosed::Span y = filtered_span(t.address_v, v, texels.height);
  return {filtered(texels, x.moved(-1), y, Channel), filtered(texels, x.moved(1), y, Channel), filtered(texels, x, y.moved(-1), Channel),
          filtered(texels, x, y.moved(1), Channel)};
}

template <int First, int Count, class N, class T>
requires std::same_as<N, enclosed::Enclosure> RAINREF_FN Channels<N, Count> sample_mip(const T& t, N u, N v, N lod) {
  const N range = level_range(lod, t.levels), level = floor(N(range.lo, range.hi) + N(0.5f));
  Channels<N, Count> out = sample_level<First, Count, N>(t, uniform_level<N>(t, static_cast<int>(level.lo)), u, v);
  // Too many levels to decide: the hull of all.
  for (int l = static_cast<int>(level.lo) + 1; l <= static_cast<int>(level.hi); ++l) {
    const auto other = sample_level<First, Count, N>(t, uniform_level<N>(t, l), u, v);
    for (int k = 0; k < Count; ++k) out[k] = hull(out[k], other[k]);
  }
  return out;
}

/// One of the two levels of a lookup between them.
template <int Count>
struct JointLevel {
  Channels<enclosed::Enclosure, Count> value;
  enclosed::JointRounding rounding[Count];
};
template <int First, int Count, class T>
RAINREF_FN JointLevel<Count> sample_level_jointly(const T& t, int level, enclosed::Enclosure u, enclosed::Enclosure v) {
  using N = enclosed::Enclosure;
  JointLevel<Count> out;
  if (as_reference(u, v)) {
    out.value = sample_level<First, Count, N>(t, uniform_level<N>(t, level), u, v);
    return out;
  }
  const enclosed::Texels texels = texels_of(t, uniform_level<N>(t, level));
  const enclosed::Span x = filtered_span(t.address_u, u, texels.width), y = filtered_span(t.address_v, v, texels.height);
  for (int k = 0; k < Count; ++k) out.value[k] = filtered(texels, x, y, First + k, out.rounding[k]);
  return out;
}
template <int First, int Count, class N, class T>
requires std::same_as<N, enclosed::Enclosure> RAINREF_FN Channels<N, Count> sample_trilinear(const T& t, N u, N v, N lod) {
  using Single = scalar::Scalar<float>;
  if (as_reference(u, v) && lod.is_point()) {
    return points(sample_trilinear<First, Count, Single>(t, Single(u.lo), Single(v.lo), Single(lod.lo)));
  }
  const N range = level_range(lod, t.levels);
  const int first = static_cast<int>(range.lo), last = static_cast<int>(range.hi);
  auto fine = sample_level_jointly<First, Count>(t, first, u, v);
  Channels<N, Count> out = fine.value;
  for (int l = first; l <= last; ++l) {
    const float low = range.lo > static_cast<float>(l) ? range.lo - static_cast<float>(l) : 0.0f;
    const float high = range.hi < static_cast<float>(l + 1) ? range.hi - static_cast<float>(l) : 1.0f;
    if (high == 0.0f) break;  // a whole level: only one level counts
    const auto coarse = sample_level_jointly<First, Count>(t, l + 1 < t.levels ? l + 1 : l, u, v);
    for (int k = 0; k < Count; ++k) {
      const N between = enclosed::between_levels(fine.value[k], fine.rounding[k], coarse.value[k], coarse.rounding[k], low, high);
      out[k] = l == first && low > 0.0f ? between : hull(out[k], between);
    }
    fine = coarse;
  }
  return out;
}
template <int First, int Count, class N, class T>
requires std::same_as<N, enclosed::Enclosure> RAINREF_FN Channels<N, Count> sample_trilinear(const T& t, N u, N v, float lod) {
  return sample_trilinear<First, Count, N>(t, u, v, N(lod));
}
