// A procedural city street at night in the rain, which every effect can use without an asset.
//
// World: right-handed, y up, metres. The road (y = 0, 9 m wide, centred on x = 0) runs along z both ways; kerbs are 0.12 m high, pavements
// 3 m wide, facades stand beyond |x| = 7.5. Traffic keeps right: a driver who looks along -z has x > 0. Radiance is linear, relative: 1
// displays as white at exposure 0. The same seed gives the same bits on every machine, compiler and number of threads.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scene/scenery.h"

namespace rainref::night_street {

using Options = scene::SceneryOptions;
using scene::Lamp;
using Parts = scene::Scenery::Parts;

struct City;

/// One street.
class Street final : public scene::Scenery {
 public:
  static std::shared_ptr<const Scenery> make(const Options& options);
  explicit Street(const Options& options = {});
  ~Street() override;
  Street(Street&&) noexcept;
  Street& operator=(Street&&) noexcept;

  std::string identity() const override;
  /// Street lamps first.
  const std::vector<Lamp>& lamps() const override { return lamps_; }

  /// View of a puddle on the road, from (0, 0.05, 0). Antialiased, and kept for other runs (cache/kept_images.h).
  Image panorama(int width, int height, const scene::Vector3& eye, const parallel::Executor& executor) const override;
  /// The same; kept only with nine parts, because other views are transient.
  View view(const scene::Camera& camera, int width, int height, double far, const parallel::Executor& executor,
            Parts parts = Parts::nine) const override;
  /// Sharp lamps, no filtering, dimmed by haze.
  Sight look(const scene::Vector3& origin, const scene::Vector3& direction) const override;

 private:
  View rendered(const scene::Camera& camera, int width, int height, double far, const parallel::Executor& executor, Parts parts) const;
  Image traced(int width, int height, const scene::Vector3& eye, const parallel::Executor& executor) const;
  Options options_;
  std::shared_ptr<const City> city_;  // shared by equal streets of a process that caches
  std::vector<Lamp> lamps_;
};

}  // namespace rainref::night_street
