// Arithmetic of SPIR-V with any number type of the passes. Floats give the bits of our models.
#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>

#include "image/footprint.h"
#include "image/texture.h"
#include "math/numbers.h"
#include "spirv/integers.h"
#include "spirv/resources.h"

// A namespace of its own, so that the vocabulary and the lookups of scalar numbers are found.
namespace rainref::spirv::numbers {
using namespace rainref::scalar;

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "image/sampling_numbers-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

/// A number of an invocation. Its type says which member is used: `number` for a float, `word` for all else.
template <class N>
struct Slot {
  N number{};
  std::uint32_t word = 0;
};

/// True if a number is one float or double, and so has bits.
template <class N>
inline constexpr bool is_plain = std::is_same_v<N, Scalar<float>> || std::is_same_v<N, Scalar<double>>;

/// The bits of a float. An interval of more than one value has none: the invocation is given up, as for an index that is not determined.
template <class N>
std::uint32_t bits_of(const N& x) {
  if constexpr (requires { x.v; }) {
    return std::bit_cast<std::uint32_t>(static_cast<float>(x.v));
  } else {
    if constexpr (requires { x.is_point(); })
      if (x.is_point()) return std::bit_cast<std::uint32_t>(x.lo);
    enclosed::give_up();
    return 0;
  }
}

template <class N>
N truncated(const N& x) {
  return select(x < N(0.0f), -floor(-x), floor(x));
}
/// Rounds toward zero. Out of range, which SPIR-V leaves undefined: the nearest integer; 0 for NaN.
template <class N>
std::uint32_t to_word(const N& x, bool is_signed) {
  if constexpr (is_plain<N>) {
    const double least = is_signed ? -0x1p31 : 0.0, most = is_signed ? 0x1p31 - 1 : 0x1p32 - 1, v = x.v;
    if (!(v == v)) return 0;
    return word_of(static_cast<std::int64_t>(v < least ? least : v > most ? most : v));
  } else {
    return static_cast<std::uint32_t>(to_int(truncated(x)).i);
  }
}

/// a * b. If both are one value: the square, for which some number types have a tighter result.
template <class N>
N product(const N& a, const N& b) {
  return &a == &b ? square(a) : a * b;
}

/// Sums 1 to 4 terms from left to right, if the order matters.
template <class N>
N sum_of(const N* x, std::uint32_t n) {
  if (n == 1) return x[0];
  if (n == 2) return x[0] + x[1];
  return n == 3 ? sum_any_order(x[0], x[1], x[2]) : sum_any_order(x[0], x[1], x[2], x[3]);
}
/// a[0] b[0] + a[step] b[1] + ...
template <class N>
N dot_of(const Slot<N>* a, std::uint32_t step, const Slot<N>* b, std::uint32_t n) {
  N products[4];
  for (std::uint32_t k = 0; k < n && k < 4; ++k) products[k] = product(a[k * step].number, b[k].number);
  return sum_of(products, n);
}

/// Filtered lookup as the pack declares, with an offset in whole texels. Channels that the image lacks are green 0, blue 0, alpha 1.
template <int Count, class N>
void sample_channels(const SampledImage& image, const N& u, const N& v, const N& lod, int dx, int dy, N* out) {
  const Texture& t = image.texture;
  Channels<N, Count> texel;
  if (dx == 0 && dy == 0) {
    texel = !image.is_linear                      ? sample_nearest<0, Count, N>(t, u, v)
            : image.mip_filter == Filter::linear  ? sample_trilinear<0, Count, N>(t, u, v, lod)
            : image.mip_filter == Filter::nearest ? sample_mip<0, Count, N>(t, u, v, lod)
                                                  : sample_bilinear<0, Count, N>(t, u, v);
  } else {
    const Level<N> l = uniform_level<N>(t, 0);
    const bool linear = image.is_linear;
    const N x = linear ? texel_coordinate(t.address_u, u, l.width_number) : nearest_coordinate(t.address_u, u, l.width_number);
    const N y = linear ? texel_coordinate(t.address_v, v, l.height_number) : nearest_coordinate(t.address_v, v, l.height_number);
    const N x0 = floor(x), y0 = floor(y);
    const auto xi = to_int(x0) + dx, yi = to_int(y0) + dy;
    const auto column = [&](auto i) { return texel_column<N>(t, l, i); };
    const auto row = [&](auto i) { return texel_row<N>(t, l, i); };
    texel = load_texel<0, Count, N>(t, column(xi), row(yi));
    if (linear) {
      const auto b = load_texel<0, Count, N>(t, column(xi + 1), row(yi)), c = load_texel<0, Count, N>(t, column(xi), row(yi + 1));
      const auto d = load_texel<0, Count, N>(t, column(xi + 1), row(yi + 1));
      for (int k = 0; k < Count; ++k) texel[k] = blend(t.precision, texel[k], b[k], c[k], d[k], x - x0, y - y0);
    }
  }
  for (int k = 0; k < 4; ++k) out[k] = k < Count ? texel[k] : N(k == 3 ? 1.0f : 0.0f);
}
template <class N>
void sample(const SampledImage& image, const N& u, const N& v, const N& lod, int dx, int dy, N* out) {
  switch (image.texture.channels) {
    case 1:
      return sample_channels<1>(image, u, v, lod, dx, dy, out);
    case 2:
      return sample_channels<2>(image, u, v, lod, dx, dy, out);
    case 3:
      return sample_channels<3>(image, u, v, lod, dx, dy, out);
    default:
      return sample_channels<4>(image, u, v, lod, dx, dy, out);
  }
}
/// A texel by integer coordinates; zeros outside, as with robust access.
template <class N>
void fetch_texel(const SampledImage& image, std::int64_t x, std::int64_t y, std::int64_t level, N* out) {
  const Texture& t = image.texture;
  const bool is_inside = level >= 0 && level < t.levels && x >= 0 && y >= 0 && x < t.width[level] && y < t.height[level];
  for (int k = 0; k < 4; ++k) out[k] = N(k == 3 && is_inside ? 1.0f : 0.0f);
  if (!is_inside) return;
  const auto place = static_cast<std::int32_t>((t.offset[level] + y * t.width[level] + x) * t.channels);
  for (int k = 0; k < t.channels; ++k) {
    out[k] = fetch(t.texels + k, N::uniform_int(place), N());
    // An 8-bit code is loaded with the accuracy that the profile allows for it.
    const Unorm8 code = to_unorm8(t.texels[place + k]);
    if (t.precision == TexelPrecision::unorm8 && to_float(code) == t.texels[place + k]) out[k] = N::load(&code);
  }
}

}  // namespace rainref::spirv::numbers
