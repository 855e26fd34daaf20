// GLSL.std.450 with the functions of our models: equal mathematics gives equal bits.
#pragma once

#include <bit>

#include "math/constants.h"
#include "spirv/module.h"
#include "spirv/numbers.h"

namespace rainref::spirv::numbers {

/// The nearest integer, ties to even. SPIR-V leaves the ties of Round undefined; Round is computed like this, too.
template <class N>
N round_even(const N& x) {
  const N low = floor(x), rest = x - low, half(0.5f), one(1.0f);
  if (rest < half) return low;
  if (rest > half) return low + one;
  return fract(low * half) > N(0.0f) ? low + one : low;
}
template <class N>
N log2_of(const N& x) {
  if constexpr (is_plain<N>)
    return N(round_to_float(log_real(Real64{x.v}) * Real64{coefficients::log2_e}));
  else
    return log(x) * N(static_cast<float>(coefficients::log2_e));
}
template <class N>
N inverse_root(const N& x) {
  if constexpr (requires { inverse_sqrt(x); })
    return inverse_sqrt(x);
  else
    return N(1.0f) / sqrt(x);
}
template <class N>
N smooth(const N& low, const N& high, const N& x) {
  const N t = saturate((x - low) / (high - low));
  return t * t * (N(3.0f) - N(2.0f) * t);
}
template <class N>
N sign_of(const N& x) {
  return select(x > N(0.0f), N(1.0f), select(x < N(0.0f), N(-1.0f), N(0.0f)));
}
/// The other side of a right triangle with hypotenuse 1 and side x.
template <class N>
N other_side(const N& x) {
  return sqrt(max(N(1.0f) - square(x), N(0.0f)));
}

/// The determinant of the rows and columns of a matrix that the masks leave. The matrix is stored by columns. Expands along the first row.
template <class N>
N minor_of(const Slot<N>* a, std::uint32_t order, std::uint32_t rows_out = 0, std::uint32_t columns_out = 0) {
  const auto row = static_cast<std::uint32_t>(std::countr_one(rows_out));
  N sum(1.0f);  // the determinant of a matrix without rows
  bool is_first = true, is_negative = false;
  for (std::uint32_t column = 0; row < order && column < order; ++column) {
    if ((columns_out >> column & 1u) != 0) continue;
    const N& factor = a[column * order + row].number;
    const std::uint32_t rows = rows_out | 1u << row, columns = columns_out | 1u << column;
    const bool is_last = std::popcount(rows) == static_cast<int>(order);
    const N term = is_last ? factor : factor * minor_of(a, order, rows, columns);
    sum = is_first ? term : is_negative ? sum - term : sum + term;
    is_first = false;
    is_negative = !is_negative;
  }
  return sum;
}
template <class N>
void invert(Slot<N>* to, const Slot<N>* a, std::uint32_t order) {
  const N scale = N(1.0f) / minor_of(a, order);
  for (std::uint32_t column = 0; column < order; ++column) {
    for (std::uint32_t row = 0; row < order; ++row) {
      const N cofactor = minor_of(a, order, 1u << column, 1u << row);
      to[column * order + row].number = ((row + column) % 2 == 0 ? cofactor : -cofactor) * scale;
    }
  }
}

/// The length of a vector of n components.
template <class N>
N length_of(const N* x, std::uint32_t n) {
  if (n == 1) return abs(x[0]);
  if (n == 2) return length(x[0], x[1]);
  if (n == 3) return length(Vec3<N>(x[0], x[1], x[2]));
  return sqrt(sum_any_order(square(x[0]), square(x[1]), square(x[2]), square(x[3])));
}

/// Evaluates a function of vectors of n components (1 to 4); the third operand of Refract has one. Returns false for any other function.
template <class N>
bool vector_function(Glsl function, Slot<N>* to, const Slot<N>* a, const Slot<N>* b, const Slot<N>* c, std::uint32_t n) {
  N x[4];
  switch (function) {
    case Glsl::Length:
    case Glsl::Distance:
      for (std::uint32_t k = 0; k < n; ++k) x[k] = function == Glsl::Length ? a[k].number : a[k].number - b[k].number;
      to[0].number = length_of(x, n);
      return true;
    case Glsl::Normalize: {
      for (std::uint32_t k = 0; k < n; ++k) x[k] = a[k].number;
      if (n == 3) {
        const Vec3<N> unit = normalize(Vec3<N>(x[0], x[1], x[2]));
        to[0].number = unit.x;
        to[1].number = unit.y;
        to[2].number = unit.z;
        return true;
      }
      const N inverse = N(1.0f) / length_of(x, n);
      for (std::uint32_t k = 0; k < n; ++k) to[k].number = inverse * x[k];
      return true;
    }
    case Glsl::Determinant:
    case Glsl::MatrixInverse: {
      const std::uint32_t order = n == 4 ? 2 : n == 9 ? 3 : 4;
      if (function == Glsl::Determinant)
        to[0].number = minor_of(a, order);
      else
        invert(to, a, order);
      return true;
    }
    case Glsl::Cross:
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t i = (k + 1) % 3, j = (k + 2) % 3;
        to[k].number = a[i].number * b[j].number - a[j].number * b[i].number;
      }
      return true;
    case Glsl::FaceForward: {
      const bool is_against = dot_of(c, 1, b, n) < N(0.0f);
      for (std::uint32_t k = 0; k < n; ++k) to[k].number = is_against ? a[k].number : -a[k].number;
      return true;
    }
    case Glsl::Reflect: {
      const N twice = N(2.0f) * dot_of(b, 1, a, n);
      for (std::uint32_t k = 0; k < n; ++k) to[k].number = a[k].number - twice * b[k].number;
      return true;
    }
    case Glsl::Refract: {
      const N eta = c[0].number, cosine = dot_of(b, 1, a, n), zero(0.0f);
      const N rest = N(1.0f) - eta * eta * (N(1.0f) - square(cosine));
      const N along = eta * cosine + sqrt(max(rest, zero));
      const auto is_total = rest < zero;
      for (std::uint32_t k = 0; k < n; ++k) to[k].number = select(is_total, zero, eta * a[k].number - along * b[k].number);
      return true;
    }
    default:
      return false;
  }
}

/// Packs numbers into the parts of a word, and unpacks them.
template <class N>
void packing_function(Glsl function, Slot<N>* to, const Slot<N>* a) {
  const bool is_half = function == Glsl::PackHalf2x16 || function == Glsl::UnpackHalf2x16;
  const std::uint32_t parts = is_half ? 2 : 4, bits = 32 / parts;
  if (function == Glsl::UnpackHalf2x16 || function == Glsl::UnpackUnorm4x8) {
    for (std::uint32_t k = 0; k < parts; ++k) {
      const std::uint32_t part = a[0].word >> (k * bits) & ((1u << bits) - 1u);
      to[k].number = N(is_half ? rainref::to_float(Half{static_cast<std::uint16_t>(part)})
                               : rainref::to_float(Unorm8{static_cast<std::uint8_t>(part)}));
    }
    return;
  }
  std::uint32_t word = 0;
  for (std::uint32_t k = 0; k < parts; ++k) {
    const float value = std::bit_cast<float>(bits_of(a[k].number));
    word |= (is_half ? std::uint32_t{to_half(value).bits} : std::uint32_t{to_unorm8(value).code}) << (k * bits);
  }
  to[0].word = word;
}

/// Evaluates a componentwise function from glsl.inc. Returns false for any other function.
template <class N>
bool each_function(const Code& code, Slot<N>* to, const Slot<N>* in_a, const Slot<N>* in_b, const Slot<N>* in_c) {
  const auto for_each = [&](const auto& f) {
    for (std::uint32_t k = 0; k < code.n; ++k) f(to[k], in_a[k], in_b[k], in_c[k]);
    return true;
  };
  using S = const Slot<N>&;
  switch (static_cast<Glsl>(code.sub)) {
#define RAINREF_GLSL_NUMBERS(name, glsl_number, operands, value)            \
  case Glsl::name:                                                          \
    return for_each([](Slot<N>& result, S x, S y, S z) {                    \
      [[maybe_unused]] const N &a = x.number, &b = y.number, &c = z.number; \
      result.number = value;                                                \
    });
#define RAINREF_GLSL_WORDS(name, glsl_number, operands, value)                                           \
  case Glsl::name:                                                                                       \
    return for_each([](Slot<N>& result, S x, S y, S z) {                                                 \
      [[maybe_unused]] const std::uint32_t a = x.word, b = y.word, c = z.word;                           \
      [[maybe_unused]] const std::int64_t sa = signed_word(a), sb = signed_word(b), sc = signed_word(c); \
      result.word = value;                                                                               \
    });
#include "spirv/glsl.inc"
    default:
      return false;
  }
}

/// Evaluates any of these functions.
template <class N>
void glsl_function(const Code& code, Slot<N>* to, const Slot<N>* a, const Slot<N>* b, const Slot<N>* c) {
  const auto function = static_cast<Glsl>(code.sub);
  if (!each_function(code, to, a, b, c) && !vector_function(function, to, a, b, c, code.m)) packing_function(function, to, a);
}

}  // namespace rainref::spirv::numbers
