#include "math/transcendental.h"

#include <algorithm>

#include "math/disabled_targets.h"

// This file is compiled once for every SIMD target: foreach_target.h includes it again and again.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "math/transcendental.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"
#include "math/real64_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rainref {
namespace HWY_NAMESPACE {

/// Runs body over whole vectors, the last one padded with ones. A padded vector is computed like any other.
template <class Body>
HWY_INLINE void for_vectors(const float* a, const float* b, float* out, std::size_t count, Body body) {
  const FloatTag d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes) hn::StoreU(body(hn::LoadU(d, a + i), hn::LoadU(d, b + i)), d, out + i);
  if (i == count) return;
  HWY_ALIGN float last_a[HWY_MAX_BYTES / sizeof(float)];
  HWY_ALIGN float last_b[HWY_MAX_BYTES / sizeof(float)];
  std::fill_n(last_a, lanes, 1.0f);
  std::fill_n(last_b, lanes, 1.0f);
  std::copy(a + i, a + count, last_a);
  std::copy(b + i, b + count, last_b);
  hn::Store(body(hn::Load(d, last_a), hn::Load(d, last_b)), d, last_a);
  std::copy_n(last_a, count - i, out + i);
}

void exp_kernel(const float* x, float* out, std::size_t count) {
  for_vectors(x, x, out, count, [](FloatVector a, FloatVector) HWY_ATTR { return exp_lanes(a); });
}
void exp2_kernel(const float* x, float* out, std::size_t count) {
  for_vectors(x, x, out, count, [](FloatVector a, FloatVector) HWY_ATTR { return exp2_lanes(a); });
}
void log_kernel(const float* x, float* out, std::size_t count) {
  for_vectors(x, x, out, count, [](FloatVector a, FloatVector) HWY_ATTR { return log_lanes(a); });
}
void sin_kernel(const float* x, float* out, std::size_t count) {
  for_vectors(x, x, out, count, [](FloatVector a, FloatVector) HWY_ATTR { return sin_lanes(a); });
}
void cos_kernel(const float* x, float* out, std::size_t count) {
  for_vectors(x, x, out, count, [](FloatVector a, FloatVector) HWY_ATTR { return cos_lanes(a); });
}
void pow_kernel(const float* x, const float* y, float* out, std::size_t count) {
  for_vectors(x, y, out, count, [](FloatVector a, FloatVector b) HWY_ATTR { return pow_lanes(a, b); });
}
void atan2_kernel(const float* y, const float* x, float* out, std::size_t count) {
  for_vectors(y, x, out, count, [](FloatVector a, FloatVector b) HWY_ATTR { return atan2_lanes(a, b); });
}

}  // namespace HWY_NAMESPACE
}  // namespace rainref
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rainref {

HWY_EXPORT(exp_kernel);
HWY_EXPORT(exp2_kernel);
HWY_EXPORT(log_kernel);
HWY_EXPORT(sin_kernel);
HWY_EXPORT(cos_kernel);
HWY_EXPORT(pow_kernel);
HWY_EXPORT(atan2_kernel);

void exp_array(const float* x, float* out, std::size_t count) { HWY_DYNAMIC_DISPATCH(exp_kernel)(x, out, count); }
void exp2_array(const float* x, float* out, std::size_t count) { HWY_DYNAMIC_DISPATCH(exp2_kernel)(x, out, count); }
void log_array(const float* x, float* out, std::size_t count) { HWY_DYNAMIC_DISPATCH(log_kernel)(x, out, count); }
void sin_array(const float* x, float* out, std::size_t count) { HWY_DYNAMIC_DISPATCH(sin_kernel)(x, out, count); }
void cos_array(const float* x, float* out, std::size_t count) { HWY_DYNAMIC_DISPATCH(cos_kernel)(x, out, count); }
void pow_array(const float* x, const float* y, float* out, std::size_t count) { HWY_DYNAMIC_DISPATCH(pow_kernel)(x, y, out, count); }
void atan2_array(const float* y, const float* x, float* out, std::size_t count) { HWY_DYNAMIC_DISPATCH(atan2_kernel)(y, x, out, count); }

}  // namespace rainref
#endif  // HWY_ONCE
