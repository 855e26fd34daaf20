// The blades and their arms in the scene's picture, which the passes read: an input of theirs, not one of them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "rainref/executor.h"
#include "scene/camera.h"
#include "windshield/motion/glass.h"
#include "windshield/scene/street.h"
#include "windshield/uniforms.h"

namespace rainref::windshield {

/// A blade before the camera, in its axes: right, up, forward [m].
struct SeenBlade {
  scene::Vector3 pivot;          ///< on the glass
  scene::Vector3 along, across;  ///< unit, in the glass: from the pivot to the ends, and beside
  scene::Vector3 out;            ///< the glass' normal, out of the car
  double inner, outer, half_width;

  bool operator==(const SeenBlade&) const = default;
};

/// The blades where the last of their records has them; those of a pane's frame.
void add_seen(std::vector<SeenBlade>& seen, std::span<const Wiper> wipers, const Glass& glass, const scene::Camera& camera);

/// Draws them, dark: the blade 12 mm before the glass and, 25 mm before it, an arm from the pivot to the blade's middle that narrows. Who
/// looks at the street has the eye's pupil, 5 mm, as the width of their edges. A texel that they hide by more than half gets their depth.
/// half_size: of the picture at distance 1.
void draw_blades(std::span<const SeenBlade> blades, const std::array<double, 2>& half_size, SceneView& view,
                 const parallel::Executor& executor);

}  // namespace rainref::windshield
