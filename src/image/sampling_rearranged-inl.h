// The lookups of sampling-inl.h for rearranged numbers. They use the lookups of enclosures for all possible coordinates; the results are
// leaves. Text only: include it right after sampling_enclosed-inl.h, in the same namespace.

RAINREF_FN Level<enclosed::Enclosure> enclosed_level(const Level<enclosed::Rearranged>& l) {
  Level<enclosed::Enclosure> out;
  out.width = {l.width.i};
  out.height = {l.height.i};
  out.offset = {l.offset.i};
  out.pitch = {l.pitch.i};
  out.width_number = l.width_number.settled();
  out.height_number = l.height_number.settled();
  return out;
}
template <int Count>
RAINREF_FN Channels<enclosed::Rearranged, Count> leaves(const Channels<enclosed::Enclosure, Count>& found) {
  Channels<enclosed::Rearranged, Count> out;
  for (int k = 0; k < Count; ++k) out[k] = enclosed::Rearranged(found[k]);
  return out;
}

template <int First, int Count, class N, class T>
requires std::same_as<N, enclosed::Rearranged> RAINREF_FN Channels<N, Count> sample_nearest(const T& t, N u, N v) {
  return leaves(sample_nearest<First, Count, enclosed::Enclosure>(t, u.settled(), v.settled()));
}
template <int First, int Count, class N, class T>
requires std::same_as<N, enclosed::Rearranged> RAINREF_FN Channels<N, Count> sample_level(const T& t, const Level<N>& l, N u, N v) {
  return leaves(sample_level<First, Count, enclosed::Enclosure>(t, enclosed_level(l), u.settled(), v.settled()));
}
template <int Channel, class N, class T>
requires std::same_as<N, enclosed::Rearranged> RAINREF_FN Neighbours<N> sample_neighbours(const T& t, N u, N v) {
  const auto near = sample_neighbours<Channel, enclosed::Enclosure>(t, u.settled(), v.settled());
  return {N(near.left), N(near.right), N(near.down), N(near.up)};
}
template <int First, int Count, class N, class T>
requires std::same_as<N, enclosed::Rearranged> RAINREF_FN Channels<N, Count> sample_mip(const T& t, N u, N v, N lod) {
  return leaves(sample_mip<First, Count, enclosed::Enclosure>(t, u.settled(), v.settled(), lod.settled()));
}
template <int First, int Count, class N, class T>
requires std::same_as<N, enclosed::Rearranged> RAINREF_FN Channels<N, Count> sample_trilinear(const T& t, N u, N v, N lod) {
  return leaves(sample_trilinear<First, Count, enclosed::Enclosure>(t, u.settled(), v.settled(), lod.settled()));
}
template <int First, int Count, class N, class T>
requires std::same_as<N, enclosed::Rearranged> RAINREF_FN Channels<N, Count> sample_trilinear(const T& t, N u, N v, float lod) {
  return sample_trilinear<First, Count, N>(t, u, v, N(lod));
}
