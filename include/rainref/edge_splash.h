// Rain that splashes on the upper edges of objects in the depth buffer: the effect of the article "Recreating the Rain Drop Effect in The
// Legend of Zelda: TOTK", as published and corrected. Mathematics, choices and the list of corrections: docs/effects/edge_splash.md.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "rainref/executor.h"
#include "rainref/image.h"
#include "rainref/recorder.h"
#include "rainref/variant.h"

namespace rainref::state {
class Items;  // src/state/items.h
}

namespace rainref::edge_splash {

/// How a stored depth d in [0, 1] gives the distance z along the view axis: 1 / z is affine in d.
struct DepthRange {
  double near_plane = 0.3, far_plane = 1000;  ///< [m]
  bool reversed = true;                       ///< d is 1 at the near plane and 0 at the far plane; if false, the other way round

  bool operator==(const DepthRange&) const = default;
};
/// Converts a device depth to a distance [m] and back, in double.
double distance_of(const DepthRange& range, double depth);
double depth_of(const DepthRange& range, double distance);

/// All parameters of the effect except its images. Names, units and ranges: `rainref describe edge_splash`.
struct Settings {
  Variant variant = Variant::corrected;
  std::uint64_t seed = 0;
  double fps = 60;
  int width = 1280, height = 720;

  DepthRange depth;
  std::array<double, 3> drop_color{0.34, 0.40, 0.43};
  double drop_alpha = 0.85, rain_drop_scale = 0.52;
  Rounding rounding = Rounding::rne;
  double exposure = 1.2;  ///< [EV]

  // as-published
  int thickness = 3;  ///< [texel]
  double edge_threshold = 0.166, drop_speed = 100;
  Format storage = Format::rgba16f;  ///< of colour: rgba16f, or rgba8 as the article's render feature asks for

  // corrected
  double band = 0.03;                                     ///< width of the splashes beside an edge [m]
  double smallest_band = 1.0 / 720, largest_band = 0.01;  ///< [picture heights]
  double edge_step = 0.15;                                ///< smallest step of distance at an edge [m]
  double edge_bend = 0.02;                                ///< smallest step, as a share of the distance
  double softness = 0.3;         ///< an edge's threshold t is a ramp to (1 + softness) t; those of noise and angle, to t + softness (1 - t)
  double widest_angle_deg = 62;  ///< largest angle between the normal of an edge and up
  std::array<double, 3> up{0, 1, 0};                ///< opposite to the direction of the falling rain, world axes; any length
  double noise_size = 0.3;                          ///< size of the tile [picture heights]
  std::array<double, 2> drop_velocity{0.25, -1.0};  ///< [picture heights/s]
  bool has_crowns = false;                          ///< crowns that rise and fall instead of scrolling noise

  std::array<double, 3> camera_position{0.15, 1.25, 1.2}, camera_target{-0.35, 0.75, -6}, camera_up{0, 1, 0};
  double vertical_fov_deg = 50;

  bool operator==(const Settings&) const = default;
};
/// Defaults of this variant: `rainref describe`. Settings{} holds the defaults of corrected.
Settings default_settings(Variant variant);

/// The input images of the pass splash. Row 0 is the bottom.
struct Inputs {
  Image colour;                    ///< 4 channels
  bool colour_is_encoded = false;  ///< 8-bit codes are sRGB; other formats hold linear radiance
  Image depth;                     ///< its first channel is read; same size as colour
  bool depth_is_distance = false;  ///< true: metres along the view axis, the sky at far_plane; false: device depth as in Settings::depth
  Image noise;                     ///< a tile, first channel; empty: gradient noise or crowns are generated
  Image layer;                     ///< corrected: first channel, 1 where splashes are allowed; empty: everywhere
};

/// A picture on which rain splashes. The bits of every buffer do not depend on the number of threads or the SIMD target.
class EdgeSplash {
 public:
  /// Throws Error(usage) for images of different sizes, for an invalid depth range, and for a depth outside its range (the message names
  /// the first place). The picture has the size of the colour image, not that of Settings. The executor must outlive this object.
  EdgeSplash(const Settings& settings, const Inputs& inputs, const parallel::Executor& executor);
  ~EdgeSplash();
  EdgeSplash(EdgeSplash&&) noexcept;

  /// Moves to the next frame: 0, 1, 2 ... Frame n shows time n / fps. No frame depends on an earlier one.
  void simulate(Recorder* recorder = nullptr);
  /// Runs splash and display for the last simulated frame.
  void render(Recorder* recorder = nullptr);
  /// Does both: one call for each frame of an animation.
  void next_frame(Recorder* recorder = nullptr) {
    simulate(recorder);
    render(recorder);
  }

  /// Replaces colour, depth and layer from the next render on. The noise stays. Throws as the constructor does, and if the size differs
  /// from that of the first colour image. The old pictures then stay.
  void show(const Inputs& inputs);

  /// Frames simulated so far.
  int frame() const;

  const Image& edge() const;  ///< r8 masks
  const Image& angle() const;
  const Image& noise() const;
  const Image& colour() const;   ///< linear radiance, alpha; as-published in Settings::storage, corrected rgba16f
  const Image& picture() const;  ///< rgba8: display code; row 0 = bottom
  const Image& depth() const;    ///< r32f: the device depth that splash reads

  /// Sentences about doubtful inputs, such as a noise map that does not tile.
  const std::vector<std::string>& warnings() const;

  /// Lists the state kept between frames, for Simulation::save and load. Internal.
  void list_state(state::Items& items);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Peak memory [byte] with these settings, within 10 %: the buffers, decoded textures and scratch in src/edge_splash/memory.cpp, without
/// the caller's images.
std::uint64_t memory_bytes(const Settings& settings);

}  // namespace rainref::edge_splash
