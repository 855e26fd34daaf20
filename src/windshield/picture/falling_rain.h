// The rain in the air behind the glass: the position of each drop, its streak during the camera's exposure, and its light.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rainref/image.h"
#include "scene/camera.h"
#include "windshield/motion/glass.h"
#include "windshield/uniforms.h"

namespace rainref::windshield {

struct FallingRainSettings {
  bool on = false;
  double rate = 20;          ///< as-published [mm/h]; corrected uses the rain's rate
  double smallest_drop = 1;  ///< diameter [mm]
  double exposure = 0.01;    ///< time that the shutter is open in a frame [s]
  double far = 8;            ///< depth of the farthest drops [m]
  double gain = 1;           ///< radiance of the drops relative to the physical value
};

/// A lamp that lights drops, car axes.
struct RainLamp {
  scene::Vector3 position;  ///< [m]
  double radius;            ///< [m]
  scene::Vector3 radiance;
};

/// The air when the shutter opens, relative to the car. Car axes.
struct Air {
  double time = 0;            ///< [s]
  Real3 moved{0, 0, 0};       ///< distance that the air has moved past the car since time 0 [m]
  Real3 wind{0, 0, 0};        ///< apparent wind [m/s]
  double rate = 0;            ///< of the rain [mm/h]
  scene::Vector3 ambient{0};  ///< mean radiance of the surroundings
};

/// The camera's view on which the rain is drawn: the scene's picture.
struct RainView {
  scene::Camera camera;  ///< its field of view is that of the picture
  int width, height;     ///< [texel]
};

/// A drop, in space and on the picture.
struct FallingDrop {
  scene::Vector3 from, to;  ///< its centre while the shutter is open, car axes [m]
  double radius;            ///< [m]
  double time_share;        ///< share of the exposure during which it covers a point of its path
  scene::Vector3 radiance;
  Streak streak;
};

/// The drops in view outside the panes, farthest first. For each size class (Marshall and Palmer's numbers, Gunn and Kinzer's velocities)
/// each cubic metre of the air holds a Poisson number of drops at positions hashed from seed, class and cell. The air falls and moves past
/// the car as a whole, so the drops stay the same from frame to frame. The radiance of a drop is
///   gain (ambient + sum over lamps of radiance, solid angle and phase),
/// with the phase function of Henyey and Greenstein (Astrophys. J. 93, 1941) and an asymmetry of 0.75 (assumed): brightest before a lamp.
std::vector<FallingDrop> falling_drops(const FallingRainSettings& settings, std::uint64_t seed, const Air& air, const RainView& view,
                                       std::span<const Glass> panes, std::span<const RainLamp> lamps);

/// The mean of a sample of an image's texels (rgba16f).
scene::Vector3 mean_radiance(const Image& colour);

}  // namespace rainref::windshield
