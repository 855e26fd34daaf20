// The slips and liberties of texture lookups. Text only; include it before sampling-inl.h, whose rules it bends.

template <class N>
RAINREF_FN N texel_coordinate(Address address, N u, N size);

RAINREF_FN Address slipped(Address address) {
  switch (deviant::behaviour().slip) {
    case deviant::Slip::address_clamped:
      return address == Address::repeat ? Address::clamp : address;
    case deviant::Slip::address_repeated:
      return address == Address::clamp ? Address::repeat : address;
    case deviant::Slip::address_mirrored:
      return Address::mirror;
    default:
      return address;
  }
}
RAINREF_FN deviant::Deviant texel_coordinate(Address address, deviant::Deviant u, deviant::Deviant size) {
  const deviant::Sampler sampler;
  const deviant::Deviant x = texel_coordinate<deviant::Deviant>(slipped(address), deviant::Deviant::of(sampler.coordinate(u.v)), size);
  const auto of = [](float value) { return deviant::Deviant::of(value); };
  const auto floor_of = [](float value) { return floor(plain::Plain<float>(value)).v; };
  switch (deviant::behaviour().slip) {
    case deviant::Slip::nearest_filter:
      return of(floor_of(x.v + 0.5f));
    case deviant::Slip::weights_of_8_bits:
      return of(floor_of(x.v * 256.0f + 0.5f) / 256.0f);
    case deviant::Slip::half_texel_missing:
      return of(x.v + 0.5f);
    case deviant::Slip::half_texel_twice:
      return of(x.v - 0.5f);
    case deviant::Slip::texel_after:
      return of(x.v + 1.0f);
    default:
      return of(sampler.texel(x.v));
  }
}
template <class N>
RAINREF_FN N nearest_coordinate(Address address, N u, N size);
RAINREF_FN deviant::Deviant nearest_coordinate(Address address, deviant::Deviant u, deviant::Deviant size) {
  const deviant::Sampler sampler;
  return deviant::Deviant::of(
      sampler.texel(nearest_coordinate<deviant::Deviant>(address, deviant::Deviant::of(sampler.coordinate(u.v)), size).v));
}
RAINREF_FN deviant::Deviant level_of_detail(deviant::Deviant lod) { return deviant::Deviant::of(deviant::Sampler().level(lod.v)); }
template <class N>
RAINREF_FN N blend(TexelPrecision, N a, N b, N c, N d, N fx, N fy);
RAINREF_FN int filtered_bits(TexelPrecision precision) {
  return precision == TexelPrecision::float32 ? 24 : precision == TexelPrecision::unorm8 ? 0 : 11;
}
RAINREF_FN deviant::Deviant blend(TexelPrecision precision, deviant::Deviant a, deviant::Deviant b, deviant::Deviant c, deviant::Deviant d,
                                  deviant::Deviant fx, deviant::Deviant fy) {
  const deviant::Sampler sampler;
  if (const deviant::Share& s = deviant::share(); s.of_level > 0)
    return deviant::Deviant::of(sampler.weighted(a.v, b.v, c.v, d.v, fx.v, fy.v, s.of_level, s.x_first));
  const deviant::Deviant in_float = blend<deviant::Deviant>(precision, a, b, c, d, fx, fy);
  return deviant::Deviant::of(sampler.blend(in_float.v, a.v, b.v, c.v, d.v, fx.v != 0 && fy.v != 0, filtered_bits(precision)));
}
/// Any integer has a texel, whatever a slip has done to it.
RAINREF_FN plain::Index<deviant::Deviant> texel_index(Address address, plain::Index<deviant::Deviant> i,
                                                      plain::Index<deviant::Deviant> size) {
  if (slipped(address) == Address::repeat) return {((i.i % size.i) + size.i) % size.i};
  return clamp_index(i, size);
}

template <class N, int Count>
struct Channels;
template <class N>
struct Level;
template <class N, class T>
RAINREF_FN Level<N> level_of(const T& t, typename N::Int wanted);
template <int First, int Count, class N, class T>
RAINREF_FN Channels<N, Count> sample_level(const T& t, const Level<N>& l, N u, N v);

/// Between two levels a sampler may round all eight weights together.
template <int First, int Count, class N, class T>
requires std::same_as<N, deviant::Deviant> RAINREF_FN Channels<N, Count> sample_trilinear(const T& t, N u, N v, N lod) {
  const N last(static_cast<float>(t.levels - 1)), l = clamp(level_of_detail(lod), N(0.0f), last), l0 = floor(l), g = l - l0;
  // A slip may have made any number of it: level_of holds it within the levels that there are.
  const auto level = to_int(l0), next = to_int(min(l0 + N(1.0f), last));
  if (!(g.v > 0)) return sample_level<First, Count, N>(t, level_of<N>(t, level), u, v);
  const deviant::Sampler sampler;
  const bool jointly = sampler.rounds_jointly();
  deviant::Share& share = deviant::share();
  if (jointly) share = {1 - g.v, sampler.takes_x_first()};
  const auto fine = sample_level<First, Count, N>(t, level_of<N>(t, level), u, v);
  if (jointly) share.of_level = g.v;
  const auto coarse = sample_level<First, Count, N>(t, level_of<N>(t, next), u, v);
  share = {};
  Channels<N, Count> out;
  for (int k = 0; k < Count; ++k)
    out[k] = jointly ? N::of(sampler.stored(fine[k].v + coarse[k].v, filtered_bits(t.precision))) : mix(fine[k], coarse[k], g);
  return out;
}
