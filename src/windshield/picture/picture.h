// The host's part of the picture's passes, composite and display.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "math/constants.h"
#include "rainref/executor.h"
#include "rainref/image.h"
#include "rainref/storage.h"
#include "scene/camera.h"
#include "windshield/motion/glass.h"
#include "windshield/picture/composite.pass.h"
#include "windshield/picture/interior.pass.h"

namespace rainref::windshield {

/// A light of the scene that drops mirror.
struct Light {
  std::array<double, 3> direction;  ///< toward it, car axes, any length
  std::array<double, 3> radiance;
};

struct PictureSettings {
  int width = 1280, height = 720;
  /// In car axes: x forward, y left, z up.
  std::array<double, 3> camera_position{0.6, 0, 1.21}, camera_target{10, 0, 1.6};
  double vertical_fov_deg = 22;
  double scene_margin = 1.15;  ///< picture of the scene over the picture, in view
  double blur_lod = 2, wetness = 0.35, visible_from = 0.02, visible_to = 0.2, refraction = 0.08, shininess = 80, glint_strength = 0.5;
  double water_ior = water_refractive_index, inner = 0.3, exposure = 0.5;
  std::array<double, 3> cabin{0.004, 0.004, 0.005};
  std::vector<Light> lights{{{-0.9, 0.25, 0.35}, {1, 0.92, 0.8}}};
};

/// Everything that composite takes besides images. Throws Error(usage) when the eye lies in the plane of the glass or before its outer
/// side; `name`: which glass.
CompositeUniforms composite_uniforms(const PictureSettings& settings, const Corners& corners, std::string_view name = "the glass");
std::vector<Glint> glints(const PictureSettings& settings);
/// The camera in car axes.
scene::Camera camera(const PictureSettings& settings);
/// Vertical field of view of the picture of the scene [deg].
double widened_fov(const PictureSettings& settings);

struct InteriorSettings {
  bool on = false;
  std::array<double, 2> pillar{0.18, 0.29};  ///< u of its inner edge where v is 0 and where it is 1; both 0: none
  double dashboard = 0.17;                   ///< v of its edge; 0: none
  double binnacle = 0.045;                   ///< height of the hood over the instruments, on the image plane at distance 1
  double light = 0.02;                       ///< radiance of its lightest parts
  double reflection = 0.25;                  ///< what the glass mirrors of the dashboard, over its light
};

InteriorUniforms interior_uniforms(const InteriorSettings& settings);

/// rgba16f of the picture's size, premultiplied; row 0 = bottom. Left of the pillar's edge and under the dashboard's alpha is 1; between,
/// an edge is as wide as the eye's pupil, 5 mm at the depth of the glass, for who looks at the street. Over the dashboard the glass mirrors
/// it: light of alpha 0. The hood stands straight ahead of the eye, along the car's x axis. glass: through which the eye looks.
Image draw_interior(const InteriorSettings& settings, const PictureSettings& picture, const Corners& glass,
                    const parallel::Executor& executor);

}  // namespace rainref::windshield
