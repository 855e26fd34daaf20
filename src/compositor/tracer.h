// First hits of rays among many surfaces. Embree finds the candidates and the surfaces decide, so the result has the same bits for every
// Embree ISA, number of threads, packet width and hierarchy.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "compositor/surface.h"

namespace rainref::compositor {

/// None of these changes a result.
struct TracerOptions {
  std::string embree_config;  ///< for rtcNewDevice, for example "isa=sse2,threads=2"
  int packet_width = 16;      ///< rays per Embree query: 1, 4, 8 or 16
  bool robust = true;         ///< Embree's robust traversal
};

class Tracer {
 public:
  /// Throws Error(usage) if Embree rejects the configuration or the width is not one of the four.
  explicit Tracer(const TracerOptions& options = {});
  ~Tracer();
  Tracer(Tracer&&) noexcept;

  /// Surfaces are numbered from 0 in this order. A surface may change between frames; `commit` updates it.
  std::uint32_t add(std::shared_ptr<const Surface> surface);
  const Surface& surface(std::uint32_t number) const;
  /// Call before the first ray, and after surfaces were added or changed. Cheap for unchanged ones.
  void commit();

  /// Sets hits[i] to the first hit of rays[i]. Any number of rays; thread-safe.
  void first_hits(std::span<const Ray> rays, std::span<Hit> hits) const;
  /// The same for hits.size() rays stored component by component, which saves the tracer their conversion.
  void first_hits(const RayArrays& rays, std::span<Hit> hits) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rainref::compositor
