// A place that pictures can be rendered of, for scenes that name no pictures.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "rainref/executor.h"
#include "rainref/image.h"
#include "scene/camera.h"

namespace rainref::scene {

/// An emissive sphere: street lamp, headlight, tail light or traffic signal. For glints.
struct Lamp {
  Vector3 position;               ///< centre, metres
  std::array<float, 3> radiance;  ///< linear RGB, relative
  double radius;                  ///< metres
};

/// A place to render. Right-handed, y up, metres: a road (y = 0) along z around x = 0. Radiance is linear and relative: 1 displays as white
/// at exposure 0. Immutable; the members are thread-safe and give the same bits for any number of threads.
class Scenery {
 public:
  /// Result of one ray.
  struct Sight {
    Vector3 radiance;  ///< linear
    double distance;   ///< metres to the hit surface; infinite for the sky
  };
  struct View {
    Image colour;  ///< rgba32f, linear radiance, alpha 1
    Image depth;   ///< r32f, metres along the view axis at the texel centre; `far` for the sky and for everything beyond it
  };
  /// Rays of a texel that differs from its neighbours.
  enum class Parts : std::uint8_t { nine, three };

  virtual ~Scenery() = default;
  /// A unique name for cached results.
  virtual std::string identity() const = 0;
  /// Every emissive sphere, in a fixed order.
  virtual const std::vector<Lamp>& lamps() const = 0;
  /// Traces one ray from `origin` along the unit vector `direction`. Needs a FloatingPointGuard.
  virtual Sight look(const Vector3& origin, const Vector3& direction) const = 0;
  /// Latitude/longitude panorama seen from `eye`, rgba32f linear radiance, alpha 1. Row 0 = v 0 = straight down (-y) ... last row =
  /// straight up (+y); u = 0.5 + atan2(z, x) / (2 pi).
  virtual Image panorama(int width, int height, const Vector3& eye, const parallel::Executor& executor) const = 0;
  /// The view of a camera; row 0 = bottom (v = 0). Throws Error(usage) if `far` is not positive and finite.
  virtual View view(const Camera& camera, int width, int height, double far, const parallel::Executor& executor,
                    Parts parts = Parts::nine) const = 0;
};

struct SceneryOptions {
  std::uint64_t seed = 1;
  bool clear_lane = false;  ///< no car stands in the lane x > 0, where the camera's car drives
};
/// Makes a scenery, or returns a cached one.
using MakeScenery = std::shared_ptr<const Scenery> (*)(const SceneryOptions& options);

}  // namespace rainref::scene
