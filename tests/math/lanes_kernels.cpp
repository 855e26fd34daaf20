// Compiled once for each SIMD target.
#include "math/lanes_kernels.h"

#include <algorithm>

#define RAINREF_KERNELS "math/lanes_kernels.cpp"
#include "math/foreach_target.h"
#include "math/lane_pair-inl.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(test)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR
#include "math/optics-inl.h"
#include "math/half_turn-inl.h"
#include "math/half_turn_lanes-inl.h"
#include "math/cube_root_lanes-inl.h"
#include "math/cube_root-inl.h"
#include "math/lanes_operations-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

static_assert(Lanes::size() <= static_cast<int>(padded_count));

void Apply(Operation operation, const float* a, const float* b, const float* c, float* out, std::size_t count) {
  for (std::size_t i = 0; i < count; i += static_cast<std::size_t>(Lanes::size())) {
    // Not by store(), which makes -0 positive.
    hn::StoreU(apply_operation<Lanes>(operation, Lanes::load(a + i), Lanes::load(b + i), Lanes::load(c + i)).v, Lanes::D(), out + i);
  }
}
int LaneCount() { return Lanes::size(); }
void Index(int first, float* out) { hn::StoreU(Lanes::index(first).v, Lanes::D(), out); }
bool AnyLess(const float* a, const float* b) { return any(Lanes::load(a) < Lanes::load(b)); }

template <class Storage>
void load_one(const Storage* in, float* out) {
  hn::StoreU(Lanes::load(in).v, Lanes::D(), out);
}
template <class Storage>
void load_four(const Storage* in, float* out) {
  Lanes channel[4];
  load4(in, channel);
  for (std::size_t c = 0; c < 4; ++c) hn::StoreU(channel[c].v, Lanes::D(), out + c * padded_count);
}
template <class Storage>
void store_four(Storage* out, const float* in, Rounding rounding) {
  Lanes channel[4];
  for (std::size_t c = 0; c < 4; ++c) channel[c] = Lanes::load(in + c * padded_count);
  store4(out, channel, rounding);
}
void LoadFloat(const float* in, float* out) { load_one(in, out); }
void LoadHalf(const Half* in, float* out) { load_one(in, out); }
void LoadUnorm8(const Unorm8* in, float* out) { load_one(in, out); }
template <class Storage>
void store_one(Storage* out, const float* in, Rounding rounding, int count) {
  store(out, Lanes::load(in), rounding, std::min(count, Lanes::size()));
}
void StoreFloat(float* out, const float* in, Rounding rounding, int count) { store_one(out, in, rounding, count); }
void StoreHalf(Half* out, const float* in, Rounding rounding, int count) { store_one(out, in, rounding, count); }
void StoreUnorm8(Unorm8* out, const float* in, Rounding rounding, int count) { store_one(out, in, rounding, count); }
void Load4Float(const float* in, float* out) { load_four(in, out); }
void Load4Half(const Half* in, float* out) { load_four(in, out); }
void Load4Unorm8(const Unorm8* in, float* out) { load_four(in, out); }
void Store4Float(float* out, const float* in, Rounding rounding) { store_four(out, in, rounding); }
void Store4Half(Half* out, const float* in, Rounding rounding) { store_four(out, in, rounding); }
void Store4Unorm8(Unorm8* out, const float* in, Rounding rounding) { store_four(out, in, rounding); }
RAINREF_TARGET_END(test)

#if RAINREF_ONCE
namespace rainref::test {

RAINREF_EXPORT(Apply);
RAINREF_EXPORT(LaneCount);
RAINREF_EXPORT(Index);
RAINREF_EXPORT(AnyLess);
RAINREF_EXPORT(LoadFloat);
RAINREF_EXPORT(LoadHalf);
RAINREF_EXPORT(LoadUnorm8);
RAINREF_EXPORT(StoreFloat);
RAINREF_EXPORT(StoreHalf);
RAINREF_EXPORT(StoreUnorm8);
RAINREF_EXPORT(Load4Float);
RAINREF_EXPORT(Load4Half);
RAINREF_EXPORT(Load4Unorm8);
RAINREF_EXPORT(Store4Float);
RAINREF_EXPORT(Store4Half);
RAINREF_EXPORT(Store4Unorm8);

void apply_by_lanes(Operation operation, const float* a, const float* b, const float* c, float* out, std::size_t count) {
  RAINREF_DISPATCH(Apply)(operation, a, b, c, out, count);
}
int lane_count() { return RAINREF_DISPATCH(LaneCount)(); }
void index_by_lanes(int first, float* out) { RAINREF_DISPATCH(Index)(first, out); }
bool any_less_by_lanes(const float* a, const float* b) { return RAINREF_DISPATCH(AnyLess)(a, b); }

template <>
void load_by_lanes(const float* in, float* out) {
  RAINREF_DISPATCH(LoadFloat)(in, out);
}
template <>
void load_by_lanes(const Half* in, float* out) {
  RAINREF_DISPATCH(LoadHalf)(in, out);
}
template <>
void load_by_lanes(const Unorm8* in, float* out) {
  RAINREF_DISPATCH(LoadUnorm8)(in, out);
}
template <>
void store_by_lanes(float* out, const float* in, Rounding r, int count) {
  RAINREF_DISPATCH(StoreFloat)(out, in, r, count);
}
template <>
void store_by_lanes(Half* out, const float* in, Rounding r, int count) {
  RAINREF_DISPATCH(StoreHalf)(out, in, r, count);
}
template <>
void store_by_lanes(Unorm8* out, const float* in, Rounding r, int count) {
  RAINREF_DISPATCH(StoreUnorm8)(out, in, r, count);
}
template <>
void load4_by_lanes(const float* in, float* out) {
  RAINREF_DISPATCH(Load4Float)(in, out);
}
template <>
void load4_by_lanes(const Half* in, float* out) {
  RAINREF_DISPATCH(Load4Half)(in, out);
}
template <>
void load4_by_lanes(const Unorm8* in, float* out) {
  RAINREF_DISPATCH(Load4Unorm8)(in, out);
}
template <>
void store4_by_lanes(float* out, const float* in, Rounding r) {
  RAINREF_DISPATCH(Store4Float)(out, in, r);
}
template <>
void store4_by_lanes(Half* out, const float* in, Rounding r) {
  RAINREF_DISPATCH(Store4Half)(out, in, r);
}
template <>
void store4_by_lanes(Unorm8* out, const float* in, Rounding r) {
  RAINREF_DISPATCH(Store4Unorm8)(out, in, r);
}

}  // namespace rainref::test
#endif
