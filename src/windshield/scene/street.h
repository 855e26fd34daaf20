// The scene before the car: a street, seen by a camera that drives along it. It is an input of the effect, not a pass.
#pragma once

#include <cstdint>
#include <memory>

#include "cache/prepared.h"
#include "image/stored_texture.h"
#include "rainref/executor.h"
#include "rainref/image.h"
#include "scene/scenery.h"
#include "windshield/picture/falling_rain.h"

namespace rainref::windshield {

/// Colour and depth of the scene in the camera's view; row 0 = bottom.
struct SceneView {
  Image colour;  ///< rgba16f, linear radiance
  Image depth;   ///< r32f, along the view axis [m]; `street_far` if nothing is hit
};
constexpr double street_far = 1000;

/// Converts a vector from car axes to the axes of the street, for a car that drives straight along it in the right lane.
scene::Vector3 in_street(const scene::Vector3& car);
/// Position of the car's origin in the street of StreetDrive, `distance` metres after it began at `start`.
scene::Vector3 place_in_street(double start, double distance);

/// The street's lamps in the axes of a car at this position.
std::vector<RainLamp> lamps_from(const scene::Scenery& street, const scene::Vector3& place);

struct StreetOptions {
  double start = 0;      ///< position of the car at the beginning [m]
  int keyframes = 1;     ///< number of pictures in `spacing` metres of way
  bool at_rest = false;  ///< it begins at rest, so its first view is worth more rays
};

/// Views of the street for a car that drives straight along it; after street_length metres it starts again. The street is rendered
/// `keyframes` times in `spacing` metres. Views in between are made from the pictures behind and ahead, by their depths. The bits are the
/// same on every machine.
class StreetDrive {
 public:
  static constexpr double street_length = 396, spacing = 12;

  /// camera: car axes (x forward, y left, z up, origin on the road under the driver's seat), with the field of view of the views, which
  /// have width x height texels. The executor must outlive this object.
  StreetDrive(std::shared_ptr<const scene::Scenery> street, const scene::Camera& camera, int width, int height,
              const StreetOptions& options, const parallel::Executor& executor);
  ~StreetDrive();
  StreetDrive(StreetDrive&&) noexcept;

  /// Sets the view after `distance` metres, which must not decrease; returns whether the view changed. `moves` must be the same in every
  /// call; if it is false, the first view stays.
  bool look(double distance, bool moves, SceneView& view);
  const scene::Scenery& street() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

struct ReprojectUniforms {
  float half_size[2];         ///< on the image plane at distance 1
  float pixel[2];             ///< extent of a pixel there
  float forward[3];           ///< motion of the car, camera axes: right, up, forward
  float behind_by, ahead_by;  ///< distance since each picture was taken [m]; ahead: not above 0
  float share;                ///< share of the distance between them, [0, 1]: the weight of the one ahead
};
struct Keyframe {
  Image colour;  ///< rgba16f
  Image depth;   ///< r32f
  std::size_t bytes() const { return cache::bytes_of(colour) + cache::bytes_of(depth); }
};
/// Rows of the view between two keyframes.
void reproject_rows(const ReprojectUniforms& uniforms, const Keyframe& behind, const Keyframe& ahead, SceneView& view,
                    const parallel::Tile& tile);

}  // namespace rainref::windshield
