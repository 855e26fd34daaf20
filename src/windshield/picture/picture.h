// The host's part of the passes of the picture, composite and display.
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

/// A light of the scene that drops reflect.
struct Light {
  std::array<double, 3> direction;  ///< toward it, car axes, any length
  std::array<double, 3> radiance;
};

struct PictureSettings {
  int width = 1280, height = 720;
  /// In car axes: x forward, y left, z up.
  std::array<double, 3> camera_position{0.6, 0, 1.21}, camera_target{10, 0, 1.6};
  double vertical_fov_deg = 22;
  double scene_margin = 1.15;  ///< field of view of the scene's picture relative to the picture's
  double blur_lod = 2, wetness = 0.35, visible_from = 0.02, visible_to = 0.2, refraction = 0.08, shininess = 80, glint_strength = 0.5;
  double water_ior = water_refractive_index, inner = 0.3, exposure = 0.5;
  std::array<double, 3> cabin{0.004, 0.004, 0.005};
  std::vector<Light> lights{{{-0.9, 0.25, 0.35}, {1, 0.92, 0.8}}};
};

/// All inputs of composite besides images. Throws Error(usage) if the eye lies in the plane of the glass or outside it; `name`: the glass.
CompositeUniforms composite_uniforms(const PictureSettings& settings, const Corners& corners, std::string_view name = "the glass");
std::vector<Glint> glints(const PictureSettings& settings);
/// The camera in car axes.
scene::Camera camera(const PictureSettings& settings);
/// Vertical field of view of the picture of the scene [deg].
double widened_fov(const PictureSettings& settings);

struct InteriorSettings {
  bool on = false;
  std::array<double, 2> pillar{0.18, 0.29};  ///< u of its inner edge at v = 0 and at v = 1; both 0: none
  double dashboard = 0.17;                   ///< v of its edge; 0: none
  double binnacle = 0.045;                   ///< height of the hood over the instruments, on the image plane at distance 1
  double light = 0.02;                       ///< radiance of its brightest parts
  double reflection = 0.25;                  ///< reflection of the dashboard in the glass, relative to its light
};

InteriorUniforms interior_uniforms(const InteriorSettings& settings);

/// rgba16f of the picture's size, premultiplied; row 0 = bottom. Alpha is 1 left of the pillar's edge and below the dashboard's. Edges are
/// as wide as the eye's pupil, 5 mm at the depth of the glass, because the eye looks at the street. Above the dashboard the glass reflects
/// it: light of alpha 0. The hood is straight ahead of the eye, along the car's x axis. glass: through which the eye looks.
Image draw_interior(const InteriorSettings& settings, const PictureSettings& picture, const Corners& glass,
                    const parallel::Executor& executor);

}  // namespace rainref::windshield
