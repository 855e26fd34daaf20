// The same world as Embree's own robust triangles and quads: what tests compare with and benchmarks race against.
#pragma once

#if RAINREF_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

#include <vector>

#include "compositor/world.h"

namespace rainref::compositor::test {

/// 16 rays component by component, as rtcIntersect16 takes them.
struct NativePacket {
  alignas(64) float origin[3][16], direction[3][16];
  /// Rays come from memory: asks for the packet 16 further on, should there be one, so that it is in the caches when its turn comes.
  void ask_for_a_later_one() const {
    const auto later = reinterpret_cast<std::uintptr_t>(this) + 16 * sizeof(NativePacket);
    for (std::size_t line = 0; line < sizeof(NativePacket); line += 64) __builtin_prefetch(reinterpret_cast<const void*>(later + line));
  }
  Ray ray(std::size_t k) const { return {{origin[0][k], origin[1][k], origin[2][k]}, {direction[0][k], direction[1][k], direction[2][k]}}; }
};
inline std::vector<NativePacket> native_packets(const std::vector<Ray>& rays) {
  std::vector<NativePacket> out(rays.size() / 16);
  for (std::size_t i = 0; i < out.size() * 16; ++i) {
    for (int k = 0; k < 3; ++k) {
      out[i / 16].origin[k][i % 16] = static_cast<float>(rays[i].origin[k]);
      out[i / 16].direction[k][i % 16] = static_cast<float>(rays[i].direction[k]);
    }
  }
  return out;
}
struct NativeHit {
  float t;
  std::uint32_t geometry, primitive;
  bool is_surface() const { return geometry != RTC_INVALID_GEOMETRY_ID; }
};

/// Geometry 0 is the water, two triangles for each cell in the order of Heightfield's parts; 1 the boxes' and the pane's quads.
class NativeWorld {
 public:
  NativeWorld(const World& world, const char* config) : device_(rtcNewDevice(config)), scene_(rtcNewScene(device_)) {
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_LOW);  // or a commit rebuilds what was to be refitted
    rtcSetSceneFlags(scene_, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST));
    constexpr unsigned across = water_cells + 1;
    water_ = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    positions_ = static_cast<float*>(rtcSetNewGeometryBuffer(water_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, across * across));
    auto* triangles = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(water_, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, 2 * water_cells * water_cells));
    for (unsigned j = 0; j < water_cells; ++j) {
      for (unsigned i = 0; i < water_cells; ++i) {
        const unsigned a = j * across + i;
        for (const unsigned v : {a, a + 1, a + across, a + across + 1, a + across, a + 1}) *triangles++ = v;
      }
    }
    set_positions(world.water->heights());
    rtcSetGeometryBuildQuality(water_, RTC_BUILD_QUALITY_REFIT);
    rtcCommitGeometry(water_);
    rtcAttachGeometryByID(scene_, water_, 0);
    add_quads(world);
    rtcCommitScene(scene_);
  }
  ~NativeWorld() {
    rtcReleaseGeometry(water_);
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  NativeWorld(const NativeWorld&) = delete;
  NativeWorld& operator=(const NativeWorld&) = delete;

  /// The per-frame update: new heights, boxes of the hierarchy refitted.
  void update(std::span<const float> heights) {
    for (std::size_t i = 0; i < heights.size(); ++i) positions_[3 * i + 1] = heights[i];
    rtcUpdateGeometryBuffer(water_, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(water_);
    rtcCommitScene(scene_);
  }

  void trace(std::span<const NativePacket> packets, bool coherent, NativeHit* hits) const {
    alignas(64) int valid[16];
    std::fill(valid, valid + 16, -1);
    alignas(64) RTCRayHit16 q;
    for (const NativePacket& p : packets) {
      p.ask_for_a_later_one();
      std::copy_n(p.origin[0], 16, q.ray.org_x);
      std::copy_n(p.origin[1], 16, q.ray.org_y);
      std::copy_n(p.origin[2], 16, q.ray.org_z);
      std::copy_n(p.direction[0], 16, q.ray.dir_x);
      std::copy_n(p.direction[1], 16, q.ray.dir_y);
      std::copy_n(p.direction[2], 16, q.ray.dir_z);
      for (int k = 0; k < 16; ++k) {
        q.ray.tnear[k] = q.ray.time[k] = 0;
        q.ray.tfar[k] = std::numeric_limits<float>::infinity();
        q.ray.mask[k] = ~0u;
        q.ray.id[k] = q.ray.flags[k] = 0;
        q.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
      }
#if RAINREF_EMBREE == 3
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
      rtcIntersect16(valid, scene_, &context, &q);
#else
      RTCIntersectArguments arguments;
      rtcInitIntersectArguments(&arguments);
      arguments.flags = coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
      rtcIntersect16(valid, scene_, &q, &arguments);
#endif
      for (int k = 0; k < 16; ++k) *hits++ = {q.ray.tfar[k], q.hit.geomID[k], q.hit.primID[k]};
    }
  }

 private:
  void set_positions(std::span<const float> heights) {
    float* to = positions_;
    for (int j = 0; j <= water_cells; ++j) {
      for (int i = 0; i <= water_cells; ++i) {
        *to++ = static_cast<float>(i * water_cell - water_half_side);
        *to++ = heights[static_cast<std::size_t>(j) * (water_cells + 1) + i];
        *to++ = static_cast<float>(j * water_cell - water_half_side);
      }
    }
  }
  void add_quads(const World& world) {
    RTCGeometry quads = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_QUAD);
    const std::size_t boxes = world.boxes.size();
    auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(quads, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, boxes * 8 + 4));
    auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(quads, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 16, boxes * 6 + 1));
    for (std::size_t b = 0; b < boxes; ++b) {
      for (unsigned corner = 0; corner < 8; ++corner) {
        for (int k = 0; k < 3; ++k) *v++ = static_cast<float>((corner >> k & 1 ? world.boxes[b].high : world.boxes[b].low)[k]);
      }
      for (const unsigned corner : {0, 1, 3, 2, 4, 5, 7, 6, 0, 1, 5, 4, 2, 3, 7, 6, 0, 2, 6, 4, 1, 3, 7, 5})
        *index++ = static_cast<unsigned>(b) * 8 + corner;
    }
    for (unsigned corner = 0; corner < 4; ++corner) {
      const Vec p =
          world.pane.origin + (corner == 1 || corner == 2 ? 1.0 : 0.0) * world.pane.edge_u + (corner >= 2 ? 1.0 : 0.0) * world.pane.edge_v;
      for (int k = 0; k < 3; ++k) *v++ = static_cast<float>(p[k]);
      *index++ = static_cast<unsigned>(boxes) * 8 + corner;
    }
    rtcCommitGeometry(quads);
    rtcAttachGeometryByID(scene_, quads, 1);
    rtcReleaseGeometry(quads);
  }

  RTCDevice device_;
  RTCScene scene_;
  RTCGeometry water_ = nullptr;
  float* positions_ = nullptr;
};

}  // namespace rainref::compositor::test
