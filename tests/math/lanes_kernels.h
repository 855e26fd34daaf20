// The number interface by the SIMD target in use, for comparison with the scalar evaluation.
#pragma once

#include <cstddef>
#include <cstdint>

#include "math/lanes_operations.h"
#include "math/scalar.h"
#include "rainref/image.h"

namespace rainref::test {

/// out[i] = operation(a[i], b[i], c[i]), all bits kept. The arrays hold a multiple of padded_count numbers.
void apply_by_lanes(Operation operation, const float* a, const float* b, const float* c, float* out, std::size_t count);
inline constexpr std::size_t padded_count = 16;

/// Lanes of the target in use; at most padded_count.
int lane_count();
/// out[i] = index(first) for i in [0, lane_count()).
void index_by_lanes(int first, float* out);
/// The lanes' own any(): whether a[i] < b[i] for some i in [0, lane_count()).
bool any_less_by_lanes(const float* a, const float* b);

/// out[i] = load(in + i) for i in [0, lane_count()).
template <class Storage>
void load_by_lanes(const Storage* in, float* out);
/// Stores the first `count` of lane_count() numbers.
template <class Storage>
void store_by_lanes(Storage* out, const float* in, Rounding rounding, int count);
/// out[c * padded_count + i] = channel c of texel i.
template <class Storage>
void load4_by_lanes(const Storage* in, float* out);
/// The inverse: in holds four channels, padded_count apart.
template <class Storage>
void store4_by_lanes(Storage* out, const float* in, Rounding rounding);

namespace plain_reading {
using namespace rainref::scalar;
#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "math/optics-inl.h"
#include "math/half_turn-inl.h"
#include "math/cube_root-inl.h"
#include "math/lanes_operations-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA
}  // namespace plain_reading

inline float apply_by_plain(Operation operation, float a, float b, float c) {
  using N = scalar::Scalar<float>;
  return plain_reading::apply_operation<N>(operation, N(a), N(b), N(c)).v;
}

}  // namespace rainref::test
