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

}  // namespace rainref::windshield
