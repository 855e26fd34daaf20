#include "math/half_array.h"

#include <algorithm>
#include <cstring>

#define RAINREF_KERNELS "math/half_array.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(half_array)
// The last block goes through a buffer, so that nothing is read beyond the array.
void ToHalfArray(const float* x, Half* half, std::size_t count, Rounding rounding) {
  const auto n = static_cast<std::size_t>(Lanes::size());
  std::size_t i = 0;
  for (; i + n <= count; i += n) {
    hn::StoreU(Lanes::load(x + i).half_codes(rounding), Lanes::DH(), reinterpret_cast<std::uint16_t*>(half + i));
  }
  if (i == count) return;
  float rest[HWY_MAX_BYTES / sizeof(float)] = {};
  std::memcpy(rest, x + i, (count - i) * sizeof(float));
  std::uint16_t codes[HWY_MAX_BYTES / sizeof(std::uint16_t)];
  hn::StoreU(Lanes::load(rest).half_codes(rounding), Lanes::DH(), codes);
  std::memcpy(half + i, codes, (count - i) * sizeof(Half));
}
void ToFloatArray(const Half* half, float* x, std::size_t count) {
  const auto n = static_cast<std::size_t>(Lanes::size());
  std::size_t i = 0;
  for (; i + n <= count; i += n) hn::StoreU(Lanes::load(half + i).v, Lanes::D(), x + i);
  if (i == count) return;
  Half rest[HWY_MAX_BYTES / sizeof(float)] = {};
  std::memcpy(rest, half + i, (count - i) * sizeof(Half));
  float out[HWY_MAX_BYTES / sizeof(float)];
  hn::StoreU(Lanes::load(rest).v, Lanes::D(), out);
  std::memcpy(x + i, out, (count - i) * sizeof(float));
}
RAINREF_TARGET_END(half_array)

#if RAINREF_ONCE
namespace rainref {
namespace half_array {
RAINREF_EXPORT(ToHalfArray);
RAINREF_EXPORT(ToFloatArray);
// Inside this namespace, so that the target's name refers to this file.
void encode(const float* x, Half* half, std::size_t count, Rounding rounding) { RAINREF_DISPATCH(ToHalfArray)(x, half, count, rounding); }
void decode(const Half* half, float* x, std::size_t count) { RAINREF_DISPATCH(ToFloatArray)(half, x, count); }
}  // namespace half_array

void to_half_array(const float* x, Half* half, std::size_t count, Rounding rounding) { half_array::encode(x, half, count, rounding); }
void to_float_array(const Half* half, float* x, std::size_t count) { half_array::decode(half, x, count); }

}  // namespace rainref
#endif
