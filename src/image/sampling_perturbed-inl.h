// Faults and variations of texture lookups. Text only; include it before sampling-inl.h, whose rules it changes.

template <class N>
RAINREF_FN N address_coordinate(Address address, N u);
template <class N>
RAINREF_FN N texel_coordinate(Address address, N u, N size);

RAINREF_FN Address altered(Address address) {
  switch (perturbed::behaviour().fault) {
    case perturbed::Fault::address_clamped:
      return address == Address::repeat ? Address::clamp : address;
    case perturbed::Fault::address_repeated:
      return address == Address::clamp ? Address::repeat : address;
    case perturbed::Fault::address_mirrored:
      return Address::mirror;
    default:
      return address;
  }
}
/// Records on which side of the texels a lookup's coordinate or a texel's index lies, where the address rule decides.
RAINREF_FN void address_decided(Address address, perturbed::DecisionKind kind, int side) {
  static constexpr const char* rules[] = {"clamp", "repeat", "mirror", "border"};
  if (perturbed::Coverage* coverage = perturbed::behaviour().coverage) coverage->addressed(rules[static_cast<int>(address)], kind, side);
}
RAINREF_FN void address_decided(Address address, float u, float size) {
  address_decided(address, perturbed::DecisionKind::address, u * size < 0.5f ? 0 : u * size > size - 0.5f ? 2 : 1);
}
/// The coordinate of a filtered lookup in the current sampler; `in_float` as computed by arithmetic.
RAINREF_FN float by_filter(Address address, float u, float size, float in_float) {
  if (perturbed::behaviour().filter == perturbed::Filter::arithmetic) return in_float;
  const bool is_held = address == Address::clamp || address == Address::mirror;
  const float reduced = address_coordinate<scalar::Scalar<float>>(address, u).v;
  return fixed_point::texel_coordinate(reduced, size, in_float, is_held ? 0.0f : -1.0f, is_held ? size - 1 : size);
}
RAINREF_FN perturbed::Perturbed texel_coordinate(Address address, perturbed::Perturbed u, perturbed::Perturbed size) {
  if (perturbed::detail::is_reference)
    return perturbed::Perturbed::of(
        by_filter(address, u.v, size.v,
                  texel_coordinate<scalar::Scalar<float>>(address, scalar::Scalar<float>(u.v), scalar::Scalar<float>(size.v)).v));
  address_decided(address, u.v, size.v);
  const auto result = [&] {
    const perturbed::Unseen parts;
    const perturbed::Sampler sampler;
    const perturbed::Perturbed x =
        texel_coordinate<perturbed::Perturbed>(altered(address), perturbed::Perturbed::of(sampler.coordinate(u.v)), size);
    const auto of = [](float value) { return perturbed::Perturbed::of(value); };
    const auto floor_of = [](float value) { return floor(scalar::Scalar<float>(value)).v; };
    switch (perturbed::behaviour().fault) {
      case perturbed::Fault::nearest_filter:
        return of(floor_of(x.v + 0.5f));
      case perturbed::Fault::weights_of_8_bits:
        return of(floor_of(x.v * 256.0f + 0.5f) / 256.0f);
      case perturbed::Fault::half_texel_missing:
        return of(x.v + 0.5f);
      case perturbed::Fault::half_texel_twice:
        return of(x.v - 0.5f);
      case perturbed::Fault::texel_after:
        return of(x.v + 1.0f);
      default:
        return of(by_filter(address, u.v, size.v, sampler.texel(x.v)));
    }
  };
  return perturbed::Perturbed::met(perturbed::Op::coordinate, result(), u);
}
template <class N>
RAINREF_FN N nearest_coordinate(Address address, N u, N size);
RAINREF_FN perturbed::Perturbed nearest_coordinate(Address address, perturbed::Perturbed u, perturbed::Perturbed size) {
  address_decided(address, perturbed::DecisionKind::address, u.v < 0 ? 0 : u.v >= 1 ? 2 : 1);
  const auto result = [&] {
    const perturbed::Unseen parts;
    const perturbed::Sampler sampler;
    return perturbed::Perturbed::of(
        sampler.texel(nearest_coordinate<perturbed::Perturbed>(address, perturbed::Perturbed::of(sampler.coordinate(u.v)), size).v));
  };
  return perturbed::Perturbed::met(perturbed::Op::coordinate, result(), u);
}
RAINREF_FN perturbed::Perturbed level_of_detail(perturbed::Perturbed lod) {
  if (perturbed::detail::is_reference && perturbed::behaviour().filter == perturbed::Filter::arithmetic) return lod;
  return perturbed::Perturbed::met(perturbed::Op::level, perturbed::Perturbed::of(perturbed::Sampler().level(lod.v)), lod);
}
template <class N>
RAINREF_FN N blend(TexelPrecision, N a, N b, N c, N d, N fx, N fy);
RAINREF_FN int filtered_bits(TexelPrecision precision) {
  return precision == TexelPrecision::float32 ? 24 : precision == TexelPrecision::unorm8 ? 0 : 11;
}
RAINREF_FN perturbed::Perturbed blend(TexelPrecision precision, perturbed::Perturbed a, perturbed::Perturbed b, perturbed::Perturbed c,
                                      perturbed::Perturbed d, perturbed::Perturbed fx, perturbed::Perturbed fy) {
  if (perturbed::detail::is_reference && perturbed::behaviour().filter == perturbed::Filter::arithmetic)
    return blend<perturbed::Perturbed>(precision, a, b, c, d, fx, fy);
  const auto result = [&] {
    const perturbed::Unseen parts;
    const perturbed::Sampler sampler;
    if (const perturbed::Share& s = perturbed::share(); s.of_level > 0)
      return perturbed::Perturbed::of(sampler.weighted(a.v, b.v, c.v, d.v, fx.v, fy.v, s.of_level, s.x_first));
    if (perturbed::behaviour().filter == perturbed::Filter::fixed_point)
      return perturbed::Perturbed::of(sampler.stored(sampler.weighted(a.v, b.v, c.v, d.v, fx.v, fy.v, 1, true), filtered_bits(precision)));
    const perturbed::Perturbed in_float = blend<perturbed::Perturbed>(precision, a, b, c, d, fx, fy);
    // A texel of weight 0 adds nothing, so the result need not lie between it and the others.
    const bool right = fx.v != 0, above = fy.v != 0;
    const float beside = right ? b.v : a.v, over = above ? c.v : a.v, across = right && above ? d.v : right ? beside : over;
    return perturbed::Perturbed::of(sampler.blend(in_float.v, a.v, beside, over, across, right && above, filtered_bits(precision)));
  };
  return perturbed::Perturbed::met(perturbed::Op::lookup, result(), fx, fy, a);
}
/// Every integer has a texel, also after a fault has changed it.
RAINREF_FN scalar::Index<perturbed::Perturbed> texel_index(Address address, scalar::Index<perturbed::Perturbed> i,
                                                           scalar::Index<perturbed::Perturbed> size) {
  address_decided(address, perturbed::DecisionKind::load, i.i < 0 ? 0 : i.i < size.i ? 1 : 2);
  if (altered(address) == Address::repeat) return {((i.i % size.i) + size.i) % size.i};
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
requires std::same_as<N, perturbed::Perturbed> RAINREF_FN Channels<N, Count> sample_trilinear(const T& t, N u, N v, N lod) {
  const N last(static_cast<float>(t.levels - 1)), l = clamp(level_of_detail(lod), N(0.0f), last), l0 = floor(l), g = l - l0;
  // A fault may have changed the number; level_of clamps it to the existing levels.
  const auto level = to_int(l0), next = to_int(min(l0 + N(1.0f), last));
  if (!(g.v > 0)) return sample_level<First, Count, N>(t, level_of<N>(t, level), u, v);
  const perturbed::Sampler sampler;
  const bool jointly = sampler.rounds_jointly();
  perturbed::Share& share = perturbed::share();
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
