// What differs between Embree 3 and 4: the folder of the headers, and how a query is handed over.
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

/// Callbacks find their own query by the address of this, its base.
struct Query {
  RTCIntersectContext context;
  Query() { rtcInitIntersectContext(&context); }
};
inline Query& query_of(RTCIntersectContext* context) { return *reinterpret_cast<Query*>(context); }
#define RAINREF_EMBREE_ASK(verb, width, ...)                 \
  if constexpr (width == 1)                                  \
    rtc##verb##1(scene, &query.context, __VA_ARGS__);        \
  else if constexpr (width == 4)                             \
    rtc##verb##4(valid, scene, &query.context, __VA_ARGS__); \
  else if constexpr (width == 8)                             \
    rtc##verb##8(valid, scene, &query.context, __VA_ARGS__); \
  else                                                       \
    rtc##verb##16(valid, scene, &query.context, __VA_ARGS__);

#else

struct Query {
  RTCRayQueryContext context;
  RTCIntersectArguments intersect;
  RTCOccludedArguments occluded;
  Query() {
    rtcInitRayQueryContext(&context);
    rtcInitIntersectArguments(&intersect);
    rtcInitOccludedArguments(&occluded);
    intersect.context = occluded.context = &context;
  }
  Query(const Query&) = delete;
};
inline Query& query_of(RTCRayQueryContext* context) { return *reinterpret_cast<Query*>(context); }
#define RAINREF_EMBREE_ASK(verb, width, ...)             \
  if constexpr (width == 1)                              \
    rtc##verb##1(scene, __VA_ARGS__, &arguments);        \
  else if constexpr (width == 4)                         \
    rtc##verb##4(valid, scene, __VA_ARGS__, &arguments); \
  else if constexpr (width == 8)                         \
    rtc##verb##8(valid, scene, __VA_ARGS__, &arguments); \
  else                                                   \
    rtc##verb##16(valid, scene, __VA_ARGS__, &arguments);

#endif

/// Lanes with valid[i] == -1 are traced; with one ray there is no such array.
template <int width>
void intersect([[maybe_unused]] const int* valid, RTCScene scene, Query& query, RayHit<width>& rays) {
#if RAINREF_EMBREE == 4
  RTCIntersectArguments& arguments = query.intersect;
#endif
  RAINREF_EMBREE_ASK(Intersect, width, &rays)
}
template <int width>
void occluded([[maybe_unused]] const int* valid, RTCScene scene, Query& query, RayHit<width>& rays) {
#if RAINREF_EMBREE == 4
  RTCOccludedArguments& arguments = query.occluded;
#endif
  RAINREF_EMBREE_ASK(Occluded, width, &rays.ray)
}
#undef RAINREF_EMBREE_ASK

}  // namespace rainref::compositor::embree
