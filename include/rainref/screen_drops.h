// Rain drops on a window, per pixel: after "Rain drops on screen" by Élie Michel, as published and corrected. Mathematics, choices and the
// list of corrections: docs/effects/screen_drops.md.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "rainref/executor.h"
#include "rainref/image.h"
#include "rainref/recorder.h"
#include "rainref/scene_text.h"
#include "rainref/texture.h"
#include "rainref/variant.h"

namespace rainref::state {
class Items;  // src/state/items.h
}

namespace rainref::screen_drops {

/// The mip level of the scene in a published drop: the finest, a fixed one, or one that follows from the gradient of the drop's normal.
enum class Lod : std::uint8_t { finest, fixed, gradient };

/// All parameters of the effect except its images. Names, units and ranges: `rainref describe screen_drops`.
struct Settings {
  Variant variant = Variant::corrected;
  std::uint64_t seed = 0;
  double fps = 60;
  int width = 1280, height = 720;
  Rounding rounding = Rounding::rne;
  double exposure = 0.5;  ///< [EV]

  std::array<double, 3> camera_position{2.2, 1.7, 12}, camera_target{0.6, 1.9, -20}, camera_up{0, 1, 0};  ///< world, y up [m]
  double vertical_fov_deg = 30;

  // as-published
  double grid = 0.015;                   ///< cells of the coarsest layer per pixel
  int layers = 4;                        ///< grids of cells; layer r has r times the cells of layer 1
  double cell_angle = 6.28;              ///< phase of the sine over a cell [rad]
  double noise_middle = 0.5;             ///< value of the noise that displaces nothing
  double displacement = 2;               ///< displacement of the grid per unit of noise [rad]
  double keep = 0.08;                    ///< with uniform noise: the share of the cells of layer keep_from - 1 that hold a drop
  double keep_from = 5;                  ///< a cell of layer r holds a drop if its noise is below (keep_from - r) keep
  double threshold = 0.5;                ///< a drop covers a pixel if the sum of the two sines, faded, is above this
  double refraction = 0.3;               ///< offset of the lookup if the unit normal lies across the view [pictures]
  double blur_level = 2.5;               ///< mip level of the scene behind the drops
  Lod lod = Lod::finest;                 ///< mip level of the scene in the drops
  double lod_level = 0;                  ///< that level if it is fixed
  Address wrap = Address::clamp;         ///< the scene beyond its edge: clamp, repeat or mirror
  bool printed_misprint = false;         ///< the displacement as the report prints it
  bool printed_normal = false;           ///< the normal as the report prints it, with the cosine of a sine
  int noise_size = 256;                  ///< texels a side of the generated noise
  Filter noise_filter = Filter::linear;  ///< for every lookup of the noise: linear or nearest

  // corrected
  double pane_height = 0.12;                      ///< height of the glass that the picture shows [m]
  double largest_radius = 4;                      ///< of the base of a drop [mm]
  double share = 0.6;                             ///< share of the cells that hold a drop
  double contact_angle_deg = 50;                  ///< of the caps of the drops
  double shortest_cycle = 8, longest_cycle = 30;  ///< duration of a cell's cycle [s]
  double impact = 0.02;                           ///< share of the cycle during which a drop spreads
  double water_ior = 1.333, inner = 0.3;
  double defocus = 0.02;      ///< radius of the blur disc of a far point [picture heights]
  double scene_margin = 2.2;  ///< tangent of half the field of view: the scene's picture over the picture

  bool operator==(const Settings&) const = default;
};
/// Defaults of this variant: `rainref describe`. Settings{} holds the defaults of corrected.
Settings default_settings(Variant variant);

/// The images of the scene. Row 0 is v = 0, the bottom; colours are linear radiance.
struct Inputs {
  Image colour;  ///< width x height, four channels; corrected: its field of view is scene_margin times the picture's
  Image noise;   ///< as-published: four channels, any size, a tile; empty: generated from the seed
};

struct FlowSettings;  ///< settings of drops that slide and merge; internal: users set them as keys of a SceneText

/// A wet window before a still scene. The bits of every buffer do not depend on the number of threads or the SIMD target.
class ScreenDrops {
 public:
  /// Makes a scene of this effect, with flowing water if flow.on is set. Throws Error(usage) with place and key for an invalid scene, for
  /// settings or images that cannot run, for keys of traced pictures, and if the scene names pictures, which `inputs` must hold.
  ScreenDrops(const SceneText& scene, const Inputs& inputs, const parallel::Executor& executor);
  /// Does the same without a text. Throws Error(usage) for settings or images that cannot run. The message names the key, what was expected
  /// and what was found. The executor must outlive this object. flow: corrected only; null: no water flows. Water flows on a pane that is
  /// pane_height high and as wide as the picture.
  ScreenDrops(const Settings& settings, const Inputs& inputs, const parallel::Executor& executor, const FlowSettings* flow = nullptr);
  ~ScreenDrops();
  ScreenDrops(ScreenDrops&&) noexcept;

  /// Moves to the next frame: 0, 1, 2 ... Frame n shows time n / fps. Runs spawn to merge if water flows.
  void simulate(Recorder* recorder = nullptr);
  /// Runs cells, drops and display for the last simulated frame. The first call makes the background, and so does the first call after
  /// show().
  void render(Recorder* recorder = nullptr);
  /// Does both: one call for each frame of an animation.
  void next_frame(Recorder* recorder = nullptr) {
    simulate(recorder);
    render(recorder);
  }

  /// Replaces the scene behind the glass from the next render on. The image has width x height texels and four channels. Throws
  /// Error(usage) for another shape.
  void show(const Image& colour);
  /// Does the same after a state was loaded, for the scene that was behind the glass when the state was saved. If the background of that
  /// scene was recorded before, it is not recorded again.
  void show_again(const Image& colour);

  /// Frames simulated so far.
  int frame() const;

  const Image& background() const;  ///< rgba16f: the scene out of focus
  const Image& cells() const;       ///< corrected: rgba32f, see docs/effects/screen_drops.md
  const Image& height() const;      ///< corrected: r16f, flowing water [mm]; 1 x 1 without flow
  const Image& water() const;       ///< r8: as-published layer / layers of the drop at the pixel, corrected coverage by water
  const Image& colour() const;      ///< rgba16f: linear radiance
  const Image& picture() const;     ///< rgba8: display code; row 0 = bottom

  /// Lists the state kept between frames, for Simulation::save and load. Internal.
  void list_state(state::Items& items);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Peak memory [byte] with these settings, within 10 %: the buffers, levels and scratch in src/screen_drops/memory.cpp, without the
/// caller's images and without flowing water.
std::uint64_t memory_bytes(const Settings& settings);

}  // namespace rainref::screen_drops
