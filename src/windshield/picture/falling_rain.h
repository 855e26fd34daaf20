// The rain in the air behind the glass: where each drop is, how long the camera's exposure draws it, and what lights it.
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
  double rate = 20;          ///< as-published [mm/h]; corrected takes the rain's
  double smallest_drop = 1;  ///< diameter [mm]
  double exposure = 0.01;    ///< time that the shutter is open in a frame [s]
  double far = 8;            ///< depth of the farthest drops [m]
  double gain = 1;           ///< radiance of the drops over that by physics
};

/// A lamp that lights drops, car axes.
struct RainLamp {
  scene::Vector3 position;  ///< [m]
  double radius;            ///< [m]
  scene::Vector3 radiance;
};

/// The air at the time when the shutter opens, as the car meets it. Car axes.
struct Air {
  double time = 0;            ///< [s]
  Real3 moved{0, 0, 0};       ///< way of the air past the car since time 0 [m]
  Real3 wind{0, 0, 0};        ///< apparent wind [m/s]
  double rate = 0;            ///< of the rain [mm/h]
  scene::Vector3 ambient{0};  ///< mean radiance of the surroundings
};

/// The camera's view that is drawn on: the scene's picture.
struct RainView {
  scene::Camera camera;  ///< its field of view is that of the picture
  int width, height;     ///< [texel]
};

/// A drop, in space and on the picture.
struct FallingDrop {
  scene::Vector3 from, to;  ///< its middle while the shutter is open, car axes [m]
  double radius;            ///< [m]
  double time_share;        ///< of the exposure in which it covers a point of its way
  scene::Vector3 radiance;
  Streak streak;
};

/// The drops in view outside the panes, far ones first. Of each size class (Marshall and Palmer's numbers, Gunn and Kinzer's velocities)
/// the drops of each cubic metre of the air, which falls and blows past the car as a whole, are a Poisson number at places hashed from
/// seed, class and cell: they stay the same drops from frame to frame. A drop shines with
///   gain (ambient + sum over lamps of radiance, solid angle and phase),
/// the phase being Henyey and Greenstein's (Astrophys. J. 93, 1941) with an asymmetry of 0.75 (assumed): brightest where a lamp lies
/// behind.
std::vector<FallingDrop> falling_drops(const FallingRainSettings& settings, std::uint64_t seed, const Air& air, const RainView& view,
                                       std::span<const Glass> panes, std::span<const RainLamp> lamps);

/// The mean of some of an image's texels (rgba16f).
scene::Vector3 mean_radiance(const Image& colour);

}  // namespace rainref::windshield
