#include "compositor/tracer.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "base/floating_point.h"
#include "compositor/embree_api.h"
#include "compositor/float_rays.h"
#include "compositor/packet.h"
#include "rainref/error.h"

namespace rainref::compositor {

namespace {

/// Data of a surface for Embree's callbacks. Boxes are kept in a table, because Embree runs the bounds callback with subnormals flushed, so
/// nothing may be computed there.
struct Entry {
  std::shared_ptr<const Surface> surface;
  std::uint32_t number = 0;
  RTCGeometry geometry = nullptr;
  bool committed = false;
  std::uint64_t revision = 0;
  std::vector<Box> boxes;
  std::vector<RTCBounds> padded;
  Box all;
};

struct PacketQuery : embree::Query {
  FloatRayKernels kernels = float_ray_kernels();
  Packet packet;
  FloatPacket floats;
  double slack = 0;
};

void bounds_from_table(const RTCBoundsFunctionArguments* a) {
  *a->bounds_o = static_cast<const Entry*>(a->geometryUserPtr)->padded[a->primID];
}

/// Embree passes a packet whole or in parts of N lanes, component by component; a lane's id is its slot.
void find_first(const RTCIntersectFunctionNArguments* a) {
  RTCRayN* rays = RTCRayHitN_RayN(a->rayhit, a->N);
  const Entry& entry = *static_cast<const Entry*>(a->geometryUserPtr);
  PacketQuery& query = static_cast<PacketQuery&>(embree::query_of(a->context));
  const EmbreeLanes lanes{a->valid, &RTCRayN_id(rays, a->N, 0), &RTCRayN_tfar(rays, a->N, 0), static_cast<int>(a->N)};
  const std::uint32_t changed =
      entry.surface->meet_packet(entry.number, a->primID, query.kernels.slots_of(lanes) & query.floats.enters, query.packet);
  if (changed != 0) query.kernels.put_ends(query.packet, query.floats, query.slack, changed, lanes);
}

using Arrays = std::array<float*, 8>;  // origin, direction, nearest, farthest

template <int width>
Arrays arrays_of(embree::RayHit<width>& rays) {
  auto& r = rays.ray;
  if constexpr (width == 1)
    return {&r.org_x, &r.org_y, &r.org_z, &r.dir_x, &r.dir_y, &r.dir_z, &r.tnear, &r.tfar};
  else
    return {r.org_x, r.org_y, r.org_z, r.dir_x, r.dir_y, r.dir_z, r.tnear, r.tfar};
}
void lend(const Arrays& arrays, FloatPacket& floats) {
  std::copy_n(arrays.begin(), 3, floats.origin);
  std::copy_n(arrays.begin() + 3, 3, floats.direction);
  floats.nearest = arrays[6];
  floats.farthest = arrays[7];
}

/// Data that are the same for all packets. Embree does not write them, because the surfaces keep the hits, and does not read the rest.
template <int width>
void prepare(embree::RayHit<width>& rays) {
  if constexpr (width == 1) {
    std::memset(&rays, 0, sizeof rays);
    rays.ray.mask = ~0u;
    rays.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  } else {
    for (unsigned i = 0; i < width; ++i) {
      rays.ray.time[i] = 0;
      rays.ray.flags[i] = 0;
      rays.ray.mask[i] = ~0u;
      rays.ray.id[i] = i;
      rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
  }
}

/// One packet at a time. take(begin, count, packet) lends the components of its rays to the packet.
template <int width, class Take>
void trace(RTCScene scene, const SceneExtent& extent, const Take& take, std::span<Hit> hits) {
  PacketQuery query;
  query.slack = extent.slack();
  alignas(64) embree::RayHit<width> rays;
  prepare<width>(rays);
  // Floats are made 16 at a time; in Embree's own memory if it takes 16 rays.
  constexpr bool is_whole = width == Packet::slots;
  const Arrays to = arrays_of<width>(rays);
  [[maybe_unused]] float room[to.size()][Packet::slots];
  if constexpr (is_whole)
    lend(to, query.floats);
  else
    lend({room[0], room[1], room[2], room[3], room[4], room[5], room[6], room[7]}, query.floats);
  alignas(64) int valid[width];
  std::uint32_t traced = (1u << width) - 1;  // the slots marked by `valid`
  std::fill(valid, valid + width, -1);
  const auto trace_packet = [&](std::size_t begin, int count, Hit* first) {
    Packet& packet = query.packet;
    take(begin, count, packet);
    packet.first = first;
    make_floats(query.kernels, count, extent, packet, query.floats);
    if (query.floats.enters == 0) return;
    if constexpr (!is_whole) {
      for (std::size_t c = 0; c < to.size(); ++c) std::copy_n(room[c], width, to[c]);
    }
    if (query.floats.enters != traced) {
      traced = query.floats.enters;
      for (int slot = 0; slot < width; ++slot) valid[slot] = -static_cast<int>(traced >> slot & 1);
    }
    embree::intersect<width>(valid, scene, query, rays);
  };
  std::size_t begin = 0;
  if constexpr (is_whole) {
    for (; begin + width <= hits.size(); begin += width) trace_packet(begin, width, hits.data() + begin);
  }
  for (; begin < hits.size(); begin += width) {
    const int count = static_cast<int>(std::min<std::size_t>(width, hits.size() - begin));
    Hit spare[Packet::slots];
    trace_packet(begin, count, spare);
    std::copy_n(spare, count, hits.data() + begin);
  }
}

/// For rays stored one after the other.
auto spreading(std::span<const Ray> rays, PacketRoom& room) {
  return [rays, &room, spread = float_ray_kernels().spread](std::size_t begin, int count, Packet& packet) {
    spread(rays.data() + begin, count, room);
    room.lend_to(packet);
  };
}
/// For rays in arrays, which are used in place, except for the last packet, which is padded with its last ray.
auto lending(const RayArrays& rays, PacketRoom& room) {
  const std::array<const double*, 8> from{rays.origin[0],    rays.origin[1],    rays.origin[2], rays.direction[0],
                                          rays.direction[1], rays.direction[2], rays.nearest,   rays.farthest};
  return [from, &room](std::size_t begin, int count, Packet& packet) {
    if (count == Packet::slots) {
      for (std::size_t k = 0; k < 3; ++k) {
        packet.origin[k] = from[k] + begin;
        packet.direction[k] = from[3 + k] + begin;
      }
      packet.nearest = from[6] + begin;
      packet.farthest = from[7] + begin;
      return;
    }
    for (std::size_t c = 0; c < from.size(); ++c) {
      for (int slot = 0; slot < Packet::slots; ++slot)
        room.component[c][slot] = from[c][begin + static_cast<std::size_t>(std::min(slot, count - 1))];
    }
    room.lend_to(packet);
  };
}

// The thread sanitizer does not see how the threads of Embree, which are oneTBB's, synchronize; so with it one thread builds.
#if defined(__SANITIZE_THREAD__)
const std::string building_threads = "threads=1,";
#else
const std::string building_threads;
#endif

[[noreturn]] void refuse(const std::string& config, const std::string& why) {
  throw Error(ExitCode::usage, fmt::format("compositor.embree_config = \"{}\": {}", config, why));
}

/// Embree silently replaces an unknown instruction set by its default.
void check_isa(const std::string& config) {
  static const std::vector<std::string> known{"sse", "sse2", "sse3", "ssse3", "sse4.1", "sse4.2", "avx", "avxi", "avx2", "avx512", "neon"};
  for (std::size_t at = config.find("isa="); at != std::string::npos; at = config.find("isa=", at + 4)) {
    const std::string name = config.substr(at + 4, config.find_first_of(", ", at) - at - 4);
    if (std::find(known.begin(), known.end(), name) == known.end())
      refuse(config, fmt::format("no instruction set is called \"{}\"{}", name, did_you_mean(name, known)));
  }
}

void include(Box& box, const Box& other) {
  for (int k = 0; k < 3; ++k) {
    box.low[k] = std::min(box.low[k], other.low[k]);
    box.high[k] = std::max(box.high[k], other.high[k]);
  }
}
Box nothing() {
  constexpr double inf = std::numeric_limits<double>::infinity();
  return {Vec(inf), Vec(-inf)};
}

/// The box, enlarged by at least the margin, in floats.
RTCBounds padded(const Box& box, double margin) {
  const auto low = [&](int k) { return static_cast<float>(box.low[k] - margin); };
  const auto high = [&](int k) { return static_cast<float>(box.high[k] + margin); };
  return {low(0), low(1), low(2), 0, high(0), high(1), high(2), 0};
}

}  // namespace

struct Tracer::State {
  TracerOptions options;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<std::unique_ptr<Entry>> entries;
  SceneExtent extent;

  ~State() {
    for (const auto& entry : entries) rtcReleaseGeometry(entry->geometry);
    if (scene) rtcReleaseScene(scene);
    if (device) rtcReleaseDevice(device);
  }
  template <class Take>
  void find_first_hits(const Take& take, std::span<Hit> hits) const {
    switch (options.packet_width) {
      case 1:
        return trace<1>(scene, extent, take, hits);
      case 4:
        return trace<4>(scene, extent, take, hits);
      case 8:
        return trace<8>(scene, extent, take, hits);
      default:
        return trace<16>(scene, extent, take, hits);
    }
  }
};

Tracer::Tracer(const TracerOptions& options) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.options = options;
  if (constexpr std::array widths{1, 4, 8, 16}; std::find(widths.begin(), widths.end(), options.packet_width) == widths.end()) {
    throw Error(ExitCode::usage, fmt::format("the packet width {} is none of 1, 4, 8, 16", options.packet_width));
  }
  check_isa(options.embree_config);
  s.device = rtcNewDevice((building_threads + options.embree_config).c_str());
  if (!s.device)
    refuse(options.embree_config,
           fmt::format("Embree {} does not take it (its error {})", RTC_VERSION_STRING, static_cast<int>(rtcGetDeviceError(nullptr))));
  s.scene = rtcNewScene(s.device);
  rtcSetSceneFlags(s.scene, options.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
}
Tracer::~Tracer() = default;
Tracer::Tracer(Tracer&&) noexcept = default;

std::uint32_t Tracer::add(std::shared_ptr<const Surface> surface) {
  State& s = *state_;
  const auto number = static_cast<std::uint32_t>(s.entries.size());
  Entry& entry = *s.entries.emplace_back(std::make_unique<Entry>());
  entry.surface = std::move(surface);
  entry.number = number;
  entry.geometry = rtcNewGeometry(s.device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserData(entry.geometry, &entry);
  rtcSetGeometryBoundsFunction(entry.geometry, bounds_from_table, nullptr);
  rtcSetGeometryIntersectFunction(entry.geometry, find_first);
  rtcAttachGeometryByID(s.scene, entry.geometry, number);
  return number;
}

const Surface& Tracer::surface(std::uint32_t number) const { return *state_->entries.at(number)->surface; }

void Tracer::commit() {
  const FloatingPointGuard guard;
  State& s = *state_;
  SceneExtent extent;
  extent.box = nothing();
  std::vector<bool> changed;
  for (const auto& entry : s.entries) {
    const std::uint64_t revision = entry->surface->revision();
    changed.push_back(!entry->committed || entry->revision != revision);
    if (changed.back()) {
      entry->revision = revision;
      entry->boxes.resize(entry->surface->primitives());
      entry->all = nothing();
      for (std::uint32_t i = 0; i < entry->boxes.size(); ++i) include(entry->all, entry->boxes[i] = entry->surface->bounds(i));
    }
    if (!entry->boxes.empty()) include(extent.box, entry->all);
  }
  // A power of two, because otherwise every ripple would change the margin, and with it all boxes.
  if (extent.box.low.x <= extent.box.high.x) {
    double largest = 0;
    for (int k = 0; k < 3; ++k) largest = std::max({largest, -extent.box.low[k], extent.box.high[k]});
    while (extent.largest < largest) extent.largest *= 2;
    while (extent.largest > 0x1p-60 && 0.5 * extent.largest >= largest) extent.largest *= 0.5;
  }
  const bool all_new = extent.largest != s.extent.largest;
  for (std::size_t i = 0; i < s.entries.size(); ++i) {
    Entry& entry = *s.entries[i];
    if (!all_new && !changed[i]) continue;
    entry.padded.resize(entry.boxes.size());
    for (std::size_t k = 0; k < entry.boxes.size(); ++k) entry.padded[k] = padded(entry.boxes[k], extent.margin());
    rtcSetGeometryUserPrimitiveCount(entry.geometry, static_cast<unsigned>(entry.boxes.size()));
    rtcCommitGeometry(entry.geometry);
    entry.committed = true;
  }
  for (int k = 0; k < 3; ++k) {
    extent.box.low[k] -= extent.margin();
    extent.box.high[k] += extent.margin();
  }
  s.extent = extent;
  rtcCommitScene(s.scene);
  if (const RTCError code = rtcGetDeviceError(s.device); code != RTC_ERROR_NONE) {
    throw Error(ExitCode::internal, fmt::format("Embree cannot build the scene (its error {})", static_cast<int>(code)));
  }
}

void Tracer::first_hits(std::span<const Ray> rays, std::span<Hit> hits) const {
  const FloatingPointGuard guard;
  PacketRoom room;
  state_->find_first_hits(spreading(rays, room), hits.first(rays.size()));
}

void Tracer::first_hits(const RayArrays& rays, std::span<Hit> hits) const {
  const FloatingPointGuard guard;
  PacketRoom room;
  state_->find_first_hits(lending(rays, room), hits);
}

}  // namespace rainref::compositor
