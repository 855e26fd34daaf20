// Rain on a puddle: the ripples of the article "Rain drops on a puddle" (Nikolaos Papadopoulos, 4rknova.com), as published and corrected.
// Mathematics, choices and the list of corrections: docs/effects/puddle.md.
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

namespace rainref::puddle {

enum class Boundary : std::uint8_t {
  reflecting,  ///< the edge texels continue outside (clamp): waves reflect upright
  periodic,    ///< opposite edges join (repeat)
  fixed        ///< the rest value lies outside: waves reflect inverted
};
enum class Shape : std::uint8_t {
  natural,  ///< an irregular shore inside the rectangle, with wet ground around it
  basin     ///< water of constant depth everywhere
};

/// All parameters of a puddle except its images. Names, units and ranges: `rainref describe puddle`.
struct Settings {
  Variant variant = Variant::corrected;
  std::uint64_t seed = 0;
  double fps = 60;
  int width = 1280, height = 720;  ///< of the picture; as-published also of the wave buffer

  // The thirteen published parameters.
  int drop_count = 5;
  double drop_intensity = 1, rain_speed = 1.5, damping = 0.96, reflectivity = 1, vignette = 0.2, fog_depth = 0.02, env_rotation = 0;
  bool use_checkerboard = false;
  double ground_scale = 1.6, water_turbidity = 6, puddle_depth = 0.03;
  std::array<double, 3> tint{0.05, 0.045, 0.04};

  Format storage = Format::rg16f;  ///< rg16f, rg32f or rgba8
  Rounding rounding = Rounding::rne;
  Boundary boundary = Boundary::reflecting;
  int max_steps = 256;

  // as-published
  double step = 1;  ///< distance of the four neighbours [texel]

  // corrected
  std::array<int, 2> grid{768, 512};
  double cell_size = 0.004, wave_speed = 0.25, step_rate = 240, rim_width = 0, shore_width = 0.004, ground_reach = 0.3, exposure = 0.7;
  Shape shape = Shape::natural;
  int bed_columns = 768;  ///< columns of the image of a natural bed; its rows follow from the grid
  bool exact_fresnel = true;
  double rain_rate = 5, smallest_drop = 1.6;
  std::string shelter;  ///< roofs over the water, "x0 z0 x1 z1; ..." [m]
  std::string objects;  ///< objects that move through the water, "radius depth: time x z, ...; ..." [m, s]

  std::array<double, 3> camera_position{0.25, 0.36, 1.8}, camera_target{0.0, 0.0, 0.1}, camera_up{0, 1, 0};  ///< world, y up [m]
  double vertical_fov_deg = 36;

  bool operator==(const Settings&) const = default;
};
/// Defaults of this variant: `rainref describe`. Settings{} holds the defaults of corrected.
Settings default_settings(Variant variant);

/// The input images of the pass shade. Row 0 is v = 0.
struct Surroundings {
  Image environment;  ///< 4 channels; latitude/longitude panorama, or six stacked cube faces
  bool environment_is_cube = false;
  bool environment_is_encoded = false;  ///< display-encoded instead of linear
  Image ground;                         ///< 4 channels, a tile; empty: asphalt is generated
  bool ground_is_encoded = false;
  Image shelter;  ///< corrected: the first channel is the share of the rain that falls, over the water's rectangle; empty: all of it
};

/// A puddle and its water, advanced frame by frame. The bits of every buffer do not depend on the number of threads or the SIMD target.
class Puddle {
 public:
  /// Throws Error(usage) for settings that cannot run, and without an environment. The message names the limit of the Courant number if it
  /// is unstable, or the memory needed if the sizes need too much. The executor must outlive the puddle.
  Puddle(const Settings& settings, const Surroundings& surroundings, const parallel::Executor& executor);
  ~Puddle();
  Puddle(Puddle&&) noexcept;

  /// Runs raindrops and wave_step from time frame / fps to (frame + 1) / fps. Frames run in the order 0, 1, 2 ...
  void simulate(Recorder* recorder = nullptr);
  /// Runs surface_hit, shade and display for the current water.
  void render(Recorder* recorder = nullptr);
  /// Does both: one call for each frame of an animation.
  void next_frame(Recorder* recorder = nullptr) {
    simulate(recorder);
    render(recorder);
  }

  /// Frames simulated so far.
  int frame() const;
  /// Wave steps run so far.
  std::int64_t steps() const;
  /// Courant number c dt / dx; as-published: sqrt(1/2) times the distance of the neighbours.
  double courant() const;

  /// The newest and the previous level of the water: single-channel planes in the storage type.
  const Image& newest() const;
  const Image& previous() const;
  /// The buffer `wave` of captures: both levels as channels of the storage format.
  BufferView wave() const;
  /// Overwrites both levels with heights (corrected: metres; as-published: decoded units), row-major, rounded to the
  /// storage type.
  void set_water(const std::vector<float>& newest, const std::vector<float>& previous);

  const Image& hit() const;      ///< rgba32f: position, iterations
  const Image& normal() const;   ///< rgba16f: normal, hit flag
  const Image& colour() const;   ///< rgba16f: linear radiance
  const Image& picture() const;  ///< rgba8: display code values; row 0 = bottom

  /// Lists the state kept between frames, for Simulation::save and load. Internal.
  void list_state(state::Items& items);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Peak memory [byte] with these settings, within 10 %: the buffers, decoded textures, mips and scratch in src/puddle/memory.cpp, without
/// the caller's images.
std::uint64_t memory_bytes(const Settings& settings);

}  // namespace rainref::puddle
