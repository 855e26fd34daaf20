// A procedural city street at night in the rain: the picture that every effect can use with no asset.
//
// World: right-handed, y up, metres. The road (y = 0, 9 m wide, centred on x = 0) runs along z both ways; kerbs are
// 0.12 m high, pavements 3 m wide, facades stand beyond |x| = 7.5. Traffic keeps right: a driver who looks along -z
// has x > 0. Radiance is linear, relative: 1 displays as white at exposure 0. The same seed gives the same bits on
// every machine, compiler and number of threads.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "rainref/executor.h"
#include "rainref/image.h"
#include "scene/camera.h"

namespace rainref::night_street {

struct Options {
  std::uint64_t seed = 1;
  bool clear_lane = false;  ///< no car stands in the lane x > 0, for one that drives along it
};

/// An emissive sphere: street lamp, headlight, tail light or traffic signal. For glints.
struct Lamp {
  scene::Vector3 position;        ///< centre, metres
  std::array<float, 3> radiance;  ///< linear RGB, relative
  double radius;                  ///< metres
};

struct City;

/// Rays of a texel where its neighbours differ.
enum class Parts : std::uint8_t { nine, three };

/// One street. Immutable; its members may be called from several threads at once.
class Street {
 public:
  explicit Street(const Options& options = {});
  ~Street();
  Street(Street&&) noexcept;
  Street& operator=(Street&&) noexcept;

  /// Every emissive sphere, in a fixed order: street lamps first.
  const std::vector<Lamp>& lamps() const;

  /// Linear radiance that arrives at `origin` (metres, on the road or above it) along a ray toward `direction` (not zero): what lies
  /// there, mirrored in wet surfaces, dimmed by haze. One ray, not a texel: sharp lamps, no filtering.
  scene::Vector3 radiance(const scene::Vector3& origin, const scene::Vector3& direction) const;

  /// Latitude/longitude panorama seen from `eye` (metres), rgba32f linear radiance, alpha 1.
  /// Row 0 = v 0 = straight DOWN (-y) ... last row = straight up (+y); u = 0.5 + atan2(z, x) / (2 pi).
  /// A puddle on the road sees it from (0, 0.05, 0).
  Image panorama(int width, int height, const scene::Vector3& eye, const parallel::Executor& executor) const;

  struct View {
    Image colour;  ///< rgba32f, linear radiance, alpha 1, antialiased
    Image depth;   ///< r32f, metres along the view axis at the texel centre; `far` for sky and whatever lies beyond
    Image normal;  ///< rgba32f, world normal at the texel centre, alpha 1 on surfaces; 0 0 0 0 where depth is `far`
  };
  /// The street seen by a camera; row 0 = bottom (v = 0). Kept for other runs, as a panorama is (cache/kept_images.h), when it has nine
  /// parts: other views pass. Throws Error(usage) when `far` is not positive and finite.
  View view(const scene::Camera& camera, int width, int height, double far, const parallel::Executor& executor,
            Parts parts = Parts::nine) const;

  /// What one ray sees. `direction` is unit. From several threads at once, each with a FloatingPointGuard.
  struct Sight {
    scene::Vector3 radiance;  ///< linear
    double distance;          ///< metres to the surface that it met; infinite for the sky
  };
  Sight look(const scene::Vector3& origin, const scene::Vector3& direction) const;

 private:
  View rendered(const scene::Camera& camera, int width, int height, double far, const parallel::Executor& executor, Parts parts) const;
  Image traced(int width, int height, const scene::Vector3& eye, const parallel::Executor& executor) const;
  Options options_;
  std::shared_ptr<const City> city_;  // which the streets of a process that remembers share
  std::vector<Lamp> lamps_;
};

}  // namespace rainref::night_street
