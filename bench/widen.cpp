// Compiled once for each SIMD target, as is what the bench measures; the bench itself is compiled for the oldest.
#include "widen.h"

#define RAINREF_KERNELS "widen.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(bench)

void WidenPacket(const float (&origin)[3][16], const float (&direction)[3][16], double* to, std::size_t stride) {
  const Real64Lanes::D d;
  const NarrowTag narrow;
  for (const float* from : {origin[0], origin[1], origin[2], direction[0], direction[1], direction[2]}) {
    for (std::size_t k = 0; k < 16; k += hn::MaxLanes(d)) hn::StoreU(hn::PromoteTo(d, hn::LoadU(narrow, from + k)), d, to + k);
    to += stride;
  }
}

RAINREF_TARGET_END(bench)

#if RAINREF_ONCE
namespace rainref::bench {

RAINREF_EXPORT(WidenPacket);

void widen_packet(const float (&origin)[3][16], const float (&direction)[3][16], double* to, std::size_t stride) {
  RAINREF_DISPATCH(WidenPacket)(origin, direction, to, stride);
}

}  // namespace rainref::bench
#endif
