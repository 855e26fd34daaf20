// Rain that splashes on the upper edges of what the depth buffer shows: the effect of the article "Recreating the Rain Drop
// Effect in The Legend of Zelda: TOTK", as published and corrected. Mathematics, choices and the list of what is corrected:
// docs/effects/edge_splash.md.
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

/// What a stored depth d in [0, 1] means: 1 / z is affine in d, with z along the view axis.
struct DepthRange {
  double near_plane = 0.3, far_plane = 1000;  ///< [m]
  bool reversed = true;                       ///< 1 at the near plane and 0 at the far one; else 0 and 1

  bool operator==(const DepthRange&) const = default;
};
/// The distance [m] of a device depth, and back; in double.
double distance_of(const DepthRange& range, double depth);
double depth_of(const DepthRange& range, double distance);

/// Everything that the effect depends on besides its images. Names, units and ranges: `rainref describe edge_splash`.
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

  // corrected
  double band = 0.03;                                     ///< of the splashes beside an edge [m]
  double smallest_band = 1.0 / 720, largest_band = 0.01;  ///< [picture heights]
  double edge_step = 0.15;                                ///< smallest step of distance at an edge [m]
  double edge_bend = 0.02;                                ///< smallest share of the distance that the step is
  double softness = 0.3;                                  ///< of every threshold: it ends at (1 + softness) times its beginning
  double widest_angle_deg = 62;                           ///< between an edge's normal and up
  std::array<double, 3> up{0, 1, 0};                      ///< against the fall of the rain, world axes; any length
  double noise_size = 0.3;                                ///< of the tile [picture heights]
  std::array<double, 2> drop_velocity{0.25, -1.0};        ///< [picture heights/s]
  bool has_crowns = false;                                ///< crowns that rise and fall in place of the scrolling noise

  std::array<double, 3> camera_position{0.15, 1.25, 1.2}, camera_target{-0.35, 0.75, -6}, camera_up{0, 1, 0};
  double vertical_fov_deg = 50;

  bool operator==(const Settings&) const = default;
};
/// What a scene of this variant that says nothing gives: `rainref describe`. Settings{} are those of corrected.
Settings default_settings(Variant variant);

/// The images that splash takes. Row 0 is the bottom.
struct Inputs {
  Image colour;                    ///< 4 channels
  bool colour_is_encoded = false;  ///< 8-bit codes are sRGB; else every number is linear radiance
  Image depth;                     ///< the first channel, of the colour's size
  bool depth_is_distance = false;  ///< metres along the view axis, the sky at far_plane; else device depth in Settings::depth
  Image noise;                     ///< the first channel, a tile; empty: gradient noise or crowns made here
  Image layer;                     ///< corrected: the first channel, 1 where splashes may be; empty: everywhere
};

/// A picture on which rain splashes. Every buffer has the same bits whatever the executor's threads and the SIMD target.
class EdgeSplash {
 public:
  /// Throws Error(usage) for images of different size, for a depth outside its range (the first place is named) and for
  /// planes that are no range. The size of the colour is the picture's, whatever Settings say. The executor must outlive this.
  EdgeSplash(const Settings& settings, const Inputs& inputs, const parallel::Executor& executor);
  ~EdgeSplash();
  EdgeSplash(EdgeSplash&&) noexcept;

  /// To the next frame: 0, 1, 2 ... Frame n shows time n / fps; nothing is computed from one frame to the next.
  void simulate(Recorder* recorder = nullptr);
  /// splash and display of the frame that was simulated last.
  void render(Recorder* recorder = nullptr);
  /// Both: one call for each frame of a film.
  void next_frame(Recorder* recorder = nullptr) {
    simulate(recorder);
    render(recorder);
  }

  /// From the next render on, other pictures: colour, depth and layer, of the sizes and kinds that the constructor takes; the noise
  /// stays. Throws as the constructor, and for another size than the first colour's; the old pictures then stay.
  void show(const Inputs& inputs);

  /// Frames simulated so far.
  int frame() const;

  const Image& edge() const;  ///< r8 masks
  const Image& angle() const;
  const Image& noise() const;
  const Image& colour() const;   ///< rgba16f: linear radiance, the scene's alpha
  const Image& picture() const;  ///< rgba8: display code; row 0 = bottom
  const Image& depth() const;    ///< r32f: device depth as splash reads it

  /// What is doubtful about the inputs, a sentence each: a noise map that does not tile.
  const std::vector<std::string>& warnings() const;

  /// Lists what it holds between frames, to be saved and loaded (Simulation::save); within rainref.
  void list_state(state::Items& items);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Bytes that these settings take at their peak, within 10 %: every buffer, decoded texture and scratch of src/edge_splash/memory.cpp. The
/// caller's images are not counted.
std::uint64_t memory_bytes(const Settings& settings);

}  // namespace rainref::edge_splash
