// Differences between Embree 3 and 4: the folder of the headers, and how a query is passed.
#pragma once

#include <type_traits>

#if RAINREF_EMBREE == 3
#include <embree3/rtcore.h>
#elif RAINREF_EMBREE == 4
#include <embree4/rtcore.h>
#else
#error "RAINREF_EMBREE must be 3 or 4: CMake sets it from the Embree that it found"
#endif

namespace rainref::compositor::embree {

template <int width>
using RayHit = std::conditional_t<width == 1, RTCRayHit,
                                  std::conditional_t<width == 4, RTCRayHit4, std::conditional_t<width == 8, RTCRayHit8, RTCRayHit16>>>;

#if RAINREF_EMBREE == 3

/// Callbacks find their query from the address of this base.
struct Query {
  RTCIntersectContext context;
  Query() { rtcInitIntersectContext(&context); }
};
inline Query& query_of(RTCIntersectContext* context) { return *reinterpret_cast<Query*>(context); }
#define RAINREF_EMBREE_INTERSECT(width, ...) rtcIntersect##width(__VA_ARGS__ scene, &query.context, &rays)

#else

struct Query {
  RTCRayQueryContext context;
  RTCIntersectArguments intersect;
  Query() {
    rtcInitRayQueryContext(&context);
    rtcInitIntersectArguments(&intersect);
    intersect.context = &context;
  }
  Query(const Query&) = delete;
};
inline Query& query_of(RTCRayQueryContext* context) { return *reinterpret_cast<Query*>(context); }
#define RAINREF_EMBREE_INTERSECT(width, ...) rtcIntersect##width(__VA_ARGS__ scene, &rays, &query.intersect)

#endif

/// Lanes with valid[i] == -1 are traced; for a single ray there is no such array.
template <int width>
void intersect([[maybe_unused]] const int* valid, RTCScene scene, Query& query, RayHit<width>& rays) {
  if constexpr (width == 1)
    RAINREF_EMBREE_INTERSECT(1, );
  else if constexpr (width == 4)
    RAINREF_EMBREE_INTERSECT(4, valid, );
  else if constexpr (width == 8)
    RAINREF_EMBREE_INTERSECT(8, valid, );
  else
    RAINREF_EMBREE_INTERSECT(16, valid, );
}
#undef RAINREF_EMBREE_INTERSECT

}  // namespace rainref::compositor::embree
