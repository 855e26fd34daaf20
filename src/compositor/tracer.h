// First hits of rays among many surfaces. Embree finds the candidates, the surfaces decide: the answer has the same bits
// for every Embree ISA, number of threads, packet width and build of the hierarchy.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "compositor/surface.h"

namespace rainref::compositor {

/// None of these changes a bit of any answer.
struct TracerOptions {
  std::string embree_config;  ///< as rtcNewDevice takes it, for example "isa=sse2,threads=2"
  int packet_width = 16;      ///< rays that Embree takes at once: 1, 4, 8 or 16
  bool robust = true;         ///< Embree's robust traversal
};

class Tracer {
 public:
  /// Throws Error(usage) when Embree does not take the configuration or the width is none of the four.
  explicit Tracer(const TracerOptions& options = {});
  ~Tracer();
  Tracer(Tracer&&) noexcept;

  /// Numbers count from 0 in this order. The surface may be altered between frames; `commit` takes notice.
  std::uint32_t add(std::shared_ptr<const Surface> surface);
  const Surface& surface(std::uint32_t number) const;
  /// Before the first ray, and after surfaces were added or altered. Cheap for those that did not change.
  void commit();

  /// hits[i] is the first hit of rays[i]. Any number of rays; may be called from several threads at once.
  void first_hits(std::span<const Ray> rays, std::span<Hit> hits) const;
  /// The same of as many rays as hits that lie component by component, which spares the tracer from spreading them.
  void first_hits(const RayArrays& rays, std::span<Hit> hits) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace rainref::compositor
