// Rain that streaks down glass: impacts of raindrops and rivulets from two baked maps, after Toadstorm's conservatory shader, as published
// and corrected. Mathematics, choices and the list of corrections: docs/effects/rainy_glass.md.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "rainref/executor.h"
#include "rainref/image.h"
#include "rainref/recorder.h"
#include "rainref/variant.h"

namespace rainref::state {
class Items;  // src/state/items.h
}

namespace rainref::rainy_glass {

enum class Shape : std::uint8_t {
  pane,    ///< an upright plane across the view
  sphere,  ///< a ball of glass
  image    ///< world normals and coverage per pixel: Surroundings::normals
};

/// All parameters of the effect except its images. Names, units and ranges: `rainref describe rainy_glass`.
struct Settings {
  Variant variant = Variant::corrected;
  std::uint64_t seed = 0;
  double fps = 60;
  int width = 1280, height = 720;

  // The maps.
  int map_size = 512;                    ///< texels a side
  Format map_storage = Format::rgba16f;  ///< rgba8 or rgba16f
  Rounding rounding = Rounding::rne;
  int droplet_count = 2200, trail_count = 22;
  double largest_droplet = 0.028, smallest_droplet = 0.0035;  ///< radius [tile]
  double trail_half_width = 0.011;                            ///< half width of the widest trail's head [tile]
  double contact_angle_deg = 45;
  int flow_cells = 8;
  double flow_gain = 1.2;

  // The glass.
  Shape shape = Shape::pane;
  double distance = 0.5;  ///< from the eye to the pane along the level view, or to the sphere's centre along the view [m]
  double yaw_deg = 0;     ///< rotation of the pane about the vertical
  double radius = 0.2;    ///< of the sphere [m]
  double drop_tile = 0.36, rivulet_tile = 0.4;  ///< side of a map on the glass [m]

  // The rain.
  double rain_amount = 0.9;
  double drop_period = 9, flow_period = 3;  ///< [s]
  double flow_strength = 0.015;             ///< distance that a rivulet moves in a cycle at full flow [tile]
  bool use_probe = false;
  double probe_level = 1;

  double rivulet_speed = 0.03;  ///< speed of the rivulet map down the glass [m/s]
  double rivulet_amount = 1;    ///< weight of the rivulets

  // as-published. The first value of each is the article's; docs/effects/rainy_glass.md has those of the shader that its author ships.
  double distortion = 0.02;                 ///< picture sizes per unit of the summed channels
  bool remap_first = false;                 ///< channels are remapped to [-1, 1] before they are masked, not after
  bool signed_offset = false;               ///< the timer takes 2 B - 1 for the time offset B
  bool squared_weight = false;              ///< the second phase of the flow weighs (1 - 2 p)^2, not |1 - 2 p|
  std::array<double, 2> flow_across{0, 1};  ///< flow for B = 0 and for B = 1, times flow_strength [tile]
  std::array<double, 2> flow_along{0, 1};   ///< the same for A, along the glass [tile]
  double fade_from = 0;                     ///< rivulets fade above this |n.y| of the glass; level glass has none
  double map_turn_deg = 0;                  ///< rotation of both maps on the glass
  double rivulet_turn_deg = 0;              ///< rotation of the rivulet map, added to that of both
  std::array<double, 3> tint{1, 1, 1};      ///< factor of the light through the glass, linear RGB

  // corrected
  double run = 0.9;  ///< share of rivulet_speed by which rivulets become slower and faster
  double impact = 0.04, rim = 0.06, water_ior = 1.333;
  double wind = 6, fall_speed = 6;  ///< speed of the rain toward the glass, and downward [m/s]

  double exposure = 1;  ///< [EV]

  std::array<double, 3> camera_position{2.2, 1.7, 12}, camera_target{0.6, 1.9, -20}, camera_up{0, 1, 0};  ///< world, y up [m]
  double vertical_fov_deg = 40;

  bool operator==(const Settings&) const = default;
};
/// Defaults of this variant: `rainref describe`. Settings{} holds the defaults of corrected.
Settings default_settings(Variant variant);

/// The images of the scene. Row 0 is v = 0, the bottom; colours are linear radiance.
struct Surroundings {
  Image colour;               ///< width x height, 4 channels
  Image depth;                ///< r32f of the same size, along the view axis [m], finite, the sky far away; only for corrected
  Image normals;              ///< for Shape::image: 4 channels of that size, world normal and coverage
  Image raindrops, rivulets;  ///< maps instead of the baked ones, 4 channels, any size; empty: baked
  Image probe;                ///< latitude/longitude panorama, read if use_probe is set, 4 channels
};

/// Wet glass before a still scene. The bits of every buffer do not depend on the number of threads or the SIMD target.
class RainyGlass {
 public:
  /// Throws Error(usage) for settings or images that cannot run. The message names the key, what was expected and what was found. The
  /// executor must outlive this object.
  RainyGlass(const Settings& settings, const Surroundings& surroundings, const parallel::Executor& executor);
  ~RainyGlass();
  RainyGlass(RainyGlass&&) noexcept;

  /// Moves to the next frame: 0, 1, 2 ... Frame n shows time n / fps. No frame depends on an earlier one.
  void simulate(Recorder* recorder = nullptr);
  /// Runs rain_on_glass and display for the last simulated frame. The first call bakes the maps.
  void render(Recorder* recorder = nullptr);
  /// Does both: one call for each frame of an animation.
  void next_frame(Recorder* recorder = nullptr) {
    simulate(recorder);
    render(recorder);
  }

  /// Replaces the scene behind the glass from the next render on: Surroundings::colour and, for corrected, depth. Throws as the constructor
  /// does.
  void show(const Image& colour, const Image& depth);

  /// Frames simulated so far.
  int frame() const;

  const Image& raindrops() const;    ///< map_storage: normal x, y, time offset, height
  const Image& rivulets() const;     ///< map_storage: normal x, y, flow across, flow along
  const Image& surface() const;      ///< rgba32f: position on the glass u, v [m], distance along the view axis [m], 0
  const Image& orientation() const;  ///< rgba16f: world normal toward the rain, coverage
  const Image& colour() const;       ///< rgba16f: linear radiance
  const Image& picture() const;      ///< rgba8: display code; row 0 = bottom

  /// Lists the state kept between frames, for Simulation::save and load. Internal.
  void list_state(state::Items& items);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Measures how badly a map tiles: the mean step of its channels across opposite edges, divided by the mean step between neighbours inside.
/// It is about 1 for a tile, and 0 for a constant.
double seam(const Image& map);
/// A map with a larger seam() does not tile.
inline constexpr double worst_seam = 4;

/// Peak memory [byte] with these settings, within 10 %: the buffers, decoded maps, mips and scratch in src/rainy_glass/memory.cpp, without
/// the caller's images.
std::uint64_t memory_bytes(const Settings& settings);

}  // namespace rainref::rainy_glass
