// Rain on a puddle: the ripples of seed article "Rain drops on a puddle" (Nikolaos Papadopoulos, 4rknova.com), as
// published and corrected. Mathematics, choices and the list of what is corrected: docs/effects/puddle.md.
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
  reflecting,  ///< edge texels repeat outside (clamp): waves reflect upright
  periodic,    ///< opposite edges join (repeat)
  fixed        ///< the rest value outside: waves reflect inverted
};
enum class Shape : std::uint8_t {
  natural,  ///< an irregular shore inside the rectangle, wet ground around it
  basin     ///< water of constant depth all over
};

/// Everything that a puddle depends on besides its images. Names, units and ranges: `rainref describe puddle`.
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
  double step = 1;  ///< offset of the neighbours [texels]

  // corrected
  std::array<int, 2> grid{768, 512};
  double cell_size = 0.004, wave_speed = 0.25, step_rate = 240, rim_width = 0, shore_width = 0.004, ground_reach = 0.3, exposure = 0.7;
  Shape shape = Shape::natural;
  int bed_columns = 768;  ///< of the image of a natural bed; its rows follow the grid
  bool exact_fresnel = true;
  double rain_rate = 5, smallest_drop = 1.6;
  std::string shelter;  ///< roofs over the water, "x0 z0 x1 z1; ..." [m]
  std::string objects;  ///< that move through it, "radius depth: time x z, ...; ..." [m, s]

  std::array<double, 3> camera_position{0.25, 0.36, 1.8}, camera_target{0.0, 0.0, 0.1}, camera_up{0, 1, 0};  ///< world, y up [m]
  double vertical_fov_deg = 36;

  bool operator==(const Settings&) const = default;
};
/// What a scene of this variant that says nothing gives: `rainref describe`. Settings{} are those of corrected.
Settings default_settings(Variant variant);

/// The images that shade takes. Row 0 is v = 0.
struct Surroundings {
  Image environment;  ///< 4 channels; latitude/longitude, or six stacked faces
  bool environment_is_cube = false;
  bool environment_is_encoded = false;  ///< display-encoded rather than linear
  Image ground;                         ///< 4 channels, a tile; empty: asphalt made here
  bool ground_is_encoded = false;
  Image shelter;  ///< corrected: over the water's rectangle, in its first channel the share of the rain that falls; empty: all of it
};

/// A puddle and its water. Advance it frame by frame; every buffer has the same bits whatever the executor's threads
/// and the SIMD target.
class Puddle {
 public:
  /// Throws Error(usage) for settings that cannot run: an unstable Courant number names the limit, sizes that need too
  /// much memory name the need; and without an environment. The executor must outlive the puddle.
  Puddle(const Settings& settings, const Surroundings& surroundings, const parallel::Executor& executor);
  ~Puddle();
  Puddle(Puddle&&) noexcept;

  /// raindrops and wave_step from time frame / fps to (frame + 1) / fps. Frames are 0, 1, 2 ... in this order.
  void simulate(Recorder* recorder = nullptr);
  /// surface_hit, shade and display of the present water.
  void render(Recorder* recorder = nullptr);
  /// Both: one call for each frame of a film.
  void next_frame(Recorder* recorder = nullptr) {
    simulate(recorder);
    render(recorder);
  }

  /// Frames simulated so far.
  int frame() const;
  /// Wave steps made so far.
  std::int64_t steps() const;
  /// c dt / dx; as-published sqrt(1/2) times the offset of the neighbours.
  double courant() const;

  /// Water: the newest and the previous level, in the storage type; single-channel planes.
  const Image& newest() const;
  const Image& previous() const;
  /// As `wave` is captured: newest and previous as channels of the storage format.
  BufferView wave() const;
  /// Overwrites both levels with heights (corrected: metres; as-published: decoded units), row-major, rounded to the
  /// storage type.
  void set_water(const std::vector<float>& newest, const std::vector<float>& previous);

  const Image& hit() const;      ///< rgba32f: position, iterations
  const Image& normal() const;   ///< rgba16f: normal, hit flag
  const Image& colour() const;   ///< rgba16f: linear radiance
  const Image& picture() const;  ///< rgba8: display code values; row 0 = bottom

  /// Lists what it holds between frames, to be saved and loaded (Simulation::save); within rainref.
  void list_state(state::Items& items);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Bytes that a puddle of these settings takes at its peak, within 10 %: every buffer, decoded texture, mip and scratch of
/// src/puddle/memory.cpp. The caller's images are not counted.
std::uint64_t memory_bytes(const Settings& settings);

}  // namespace rainref::puddle
