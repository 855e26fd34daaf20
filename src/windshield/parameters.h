// The settings of all parts of a windshield, and their parameters.
#pragma once

#include <array>
#include <span>

#include "base/memory.h"
#include "blur_pyramid/blur_pyramid.h"
#include "drops/settings.h"
#include "drops/splat/splat.h"
#include "scene/config.h"
#include "scene/parameter.h"
#include "windshield/motion/parameters.h"
#include "windshield/picture/falling_rain.h"
#include "windshield/picture/picture.h"
#include "windshield/surface/surface.h"

namespace rainref::windshield {

struct Settings : MotionSettings {
  bool corrected = true;
  std::uint64_t seed = 1;
  double fps = 60;
  int substeps = 1;
  double drops_share = 1;  ///< for a pane as published: its new drops relative to the windshield's
  drops::Settings drops;
  drops::SplatSettings splat;
  SurfaceSettings surface;
  blur_pyramid::BlurSettings blur;
  PictureSettings picture;
  std::array<int, 2> scene_size{1280, 720};
  FallingRainSettings falling;
  SmearSettings smear;
  CondensationSettings condensation;
  InteriorSettings interior;
  double street_start = 0;
  bool clear_lane = false;
  int keyframes = 1;
  bool scene_moves = true;
  bool shows_blades = false;
};

std::span<const scene::Parameter> parameters();
/// Throws Error(usage) for a value that is invalid, alone or with others.
Settings settings_from(const scene::Config& config);
/// The settings of one pane. For number 0, the windshield, they are unchanged. The others have their own corners, textures with texels of
/// the windshield's size, and their own wipers and drops; as published the windshield's new drops are scaled by area.
Settings settings_of_pane(const Settings& car, int number);

/// Memory of the constructor and of this many frames. scene: columns and rows of a picture that replaces the street, which the windshield
/// then owns; 0: the street.
MemoryPeak memory(const Settings& settings, int frames, std::array<int, 2> scene = {0, 0});

/// Largest number of drops of falling_rain in view within this many seconds.
double most_falling(const Settings& settings, double seconds);

}  // namespace rainref::windshield
