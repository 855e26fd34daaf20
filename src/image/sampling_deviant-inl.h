// The slips and liberties of texture lookups. Text only; include it before sampling-inl.h, whose rules it bends.

template <class N>
RAINREF_FN N texel_coordinate(Address address, N u, N size);

RAINREF_FN Address slipped(Address address) {
  switch (deviant::behaviour().slip) {
    case deviant::Slip::address_clamped: return address == Address::repeat ? Address::clamp : address;
    case deviant::Slip::address_repeated: return address == Address::clamp ? Address::repeat : address;
    case deviant::Slip::address_mirrored: return Address::mirror;
    default: return address;
  }
}
RAINREF_FN deviant::Deviant texel_coordinate(Address address, deviant::Deviant u, deviant::Deviant size) {
  const deviant::Sampler sampler;
  const deviant::Deviant x = texel_coordinate<deviant::Deviant>(slipped(address), deviant::Deviant::of(sampler.coordinate(u.v)), size);
  const auto of = [](float value) { return deviant::Deviant::of(value); };
  const auto floor_of = [](float value) { return floor(plain::Plain<float>(value)).v; };
  switch (deviant::behaviour().slip) {
    case deviant::Slip::nearest_filter: return of(floor_of(x.v + 0.5f));
    case deviant::Slip::weights_of_8_bits: return of(floor_of(x.v * 256.0f + 0.5f) / 256.0f);
    case deviant::Slip::half_texel_missing: return of(x.v + 0.5f);
    case deviant::Slip::half_texel_twice: return of(x.v - 0.5f);
    case deviant::Slip::texel_after: return of(x.v + 1.0f);
    default: return of(sampler.texel(x.v));
  }
}
template <class N>
RAINREF_FN N nearest_coordinate(Address address, N u, N size);
RAINREF_FN deviant::Deviant nearest_coordinate(Address address, deviant::Deviant u, deviant::Deviant size) {
  const deviant::Sampler sampler;
  return deviant::Deviant::of(sampler.texel(nearest_coordinate<deviant::Deviant>(address, deviant::Deviant::of(sampler.coordinate(u.v)), size).v));
}
RAINREF_FN deviant::Deviant level_of_detail(deviant::Deviant lod) { return deviant::Deviant::of(deviant::Sampler().level(lod.v)); }
/// Any integer has a texel, whatever a slip has done to it.
RAINREF_FN plain::Index<deviant::Deviant> texel_index(Address address, plain::Index<deviant::Deviant> i, plain::Index<deviant::Deviant> size) {
  if (slipped(address) == Address::repeat) return {((i.i % size.i) + size.i) % size.i};
  return clamp_index(i, size);
}
