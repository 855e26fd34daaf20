// Compiled once for each SIMD target.
#include "image/sampling_kernels.h"

#include "math/scalar.h"

#define RAINREF_KERNELS "image/sampling_kernels.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(test)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "image/sampling-inl.h"
#include "image/sampling_lanes-inl.h"
#include "image/environment-inl.h"
#include "image/sampling_lookup-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

void LookUp(Lookup lookup, const Texture& texture, const Place* places, Texel* out, std::size_t count) {
  for (std::size_t i = 0; i < count; i += static_cast<std::size_t>(Lanes::size())) {
    Lanes place[4], texel[4];
    load4(&places[i].u, place);
    look_up<Lanes>(lookup, texture, place[0], place[1], place[2], place[3], texel);
    hn::StoreInterleaved4(texel[0].v, texel[1].v, texel[2].v, texel[3].v, Lanes::D(), out[i].c);
  }
}
RAINREF_TARGET_END(test)

#if RAINREF_ONCE
namespace rainref::test {
namespace plain_reading {
using namespace rainref::scalar;
#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "image/sampling-inl.h"
#include "image/environment-inl.h"
#include "image/sampling_lookup-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA
}  // namespace plain_reading

RAINREF_EXPORT(LookUp);

void look_up_by_lanes(Lookup lookup, const Texture& texture, const Place* places, Texel* out, std::size_t count) {
  RAINREF_DISPATCH(LookUp)(lookup, texture, places, out, count);
}
Texel look_up_by_plain(Lookup lookup, const Texture& texture, const Place& place) {
  using N = scalar::Scalar<float>;
  N texel[4];
  plain_reading::look_up<N>(lookup, texture, N(place.u), N(place.v), N(place.w), N(place.lod), texel);
  return {{texel[0].v, texel[1].v, texel[2].v, texel[3].v}};
}

}  // namespace rainref::test
#endif
