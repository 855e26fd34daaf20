// The blades and their arms in the scene's picture, which is an input of the passes.
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

/// A blade in the view of the camera, in its axes: right, up, forward [m].
struct SeenBlade {
  scene::Vector3 pivot;          ///< on the glass
  scene::Vector3 along, across;  ///< unit, in the glass: from the pivot to the ends, and across
  scene::Vector3 out;            ///< the glass' normal, out of the car
  double inner, outer, half_width;

  bool operator==(const SeenBlade&) const = default;
};

/// Adds the blades of a pane's frame at the position of their last record.
void add_seen(std::vector<SeenBlade>& seen, std::span<const Wiper> wipers, const Glass& glass, const scene::Camera& camera);

/// Draws them dark: the blade 12 mm before the glass, and 25 mm before it an arm that narrows from the pivot to the blade's centre. Their
/// edges are as wide as the eye's pupil, 5 mm, because the eye looks at the street. A texel that they hide by more than half gets their
/// depth. half_size: of the picture at distance 1.
void draw_blades(std::span<const SeenBlade> blades, const std::array<double, 2>& half_size, SceneView& view,
                 const parallel::Executor& executor);

}  // namespace rainref::windshield
