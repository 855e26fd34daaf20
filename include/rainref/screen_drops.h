// Rain drops on a window, per pixel: after "Rain drops on screen" by Élie Michel, as published and corrected. Mathematics,
// choices and the list of what is corrected: docs/effects/screen_drops.md.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "rainref/executor.h"
#include "rainref/image.h"
#include "rainref/recorder.h"
#include "rainref/scene_text.h"
#include "rainref/variant.h"

namespace rainref::state {
class Items;  // src/state/items.h
}

namespace rainref::screen_drops {

/// Everything that the effect depends on besides its images. Names, units and ranges: `rainref describe screen_drops`.
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
  double grid = 0.015;                   ///< cells of the coarsest layer in a pixel
  int layers = 4;                        ///< grids of cells; layer r has r times the cells of layer 1
  double cell_angle = 6.28;              ///< of the sine over a cell [rad]
  double noise_middle = 0.5;             ///< noise that displaces nothing
  double displacement = 2;               ///< of the grid per unit of noise [rad]
  double keep = 0.08;                    ///< share of the cells of layer keep_from - 1 that hold a drop, for noise that is uniform
  double keep_from = 5;                  ///< a cell of layer r holds a drop where its noise is below (keep_from - r) keep
  double threshold = 0.5;                ///< a drop is where the sum of the sines, faded, is above this
  double refraction = 0.3;               ///< pictures that a unit normal across the view moves the lookup
  double blur_level = 2.5;               ///< mip level behind the drops
  bool printed_misprint = false;         ///< the displacement as the report prints it
  bool printed_normal = false;           ///< the normal as the report prints it, of the cosine of a sine
  int noise_size = 256;                  ///< texels a side of the noise made here
  Filter noise_filter = Filter::linear;  ///< of every lookup of the noise: linear or nearest

  // corrected
  double pane_height = 0.12;                      ///< of glass in the picture's height [m]
  double largest_radius = 4;                      ///< of a drop's base [mm]
  double share = 0.6;                             ///< of cells that hold a drop
  double contact_angle_deg = 50;                  ///< of the drops' caps
  double shortest_cycle = 8, longest_cycle = 30;  ///< of a cell [s]
  double impact = 0.02;                           ///< share of its cycle in which a drop spreads
  double water_ior = 1.333, inner = 0.3;
  double defocus = 0.02;      ///< radius of a far point's disc [picture heights]
  double scene_margin = 2.2;  ///< field of view of the scene's picture over the picture's, as tangents

  bool operator==(const Settings&) const = default;
};
/// What a scene of this variant that says nothing gives: `rainref describe`. Settings{} are those of corrected.
Settings default_settings(Variant variant);

/// The images of the scene. Row 0 is v = 0, the bottom; colours are linear radiance.
struct Inputs {
  Image colour;  ///< width x height, four channels; corrected: of scene_margin times the picture's field of view
  Image noise;   ///< as-published: four channels, any size, a tile; empty: made from the seed
};

struct FlowSettings;  ///< of drops that slide and merge, within rainref; others say it as keys of a SceneText

/// A wet window before a still scene. Every buffer has the same bits whatever the executor's threads and the SIMD target.
class ScreenDrops {
 public:
  /// A scene of this effect, flowing water included (flow.on). Throws Error(usage), naming place and key, for what no scene may say, for
  /// settings or images that cannot run, for pictures named in the scene rather than given here, and for keys of traced pictures.
  ScreenDrops(const SceneText& scene, const Inputs& inputs, const parallel::Executor& executor);
  /// The same without a text. Throws Error(usage) for settings or images that cannot run, naming key, expected and found. The executor must
  /// outlive this. flow: corrected only; null: no water flows. Its pane is pane_height high and as wide as the picture.
  ScreenDrops(const Settings& settings, const Inputs& inputs, const parallel::Executor& executor, const FlowSettings* flow = nullptr);
  ~ScreenDrops();
  ScreenDrops(ScreenDrops&&) noexcept;

  /// To the next frame: 0, 1, 2 ... Frame n shows time n / fps. Flowing water, if there is any: spawn to merge.
  void simulate(Recorder* recorder = nullptr);
  /// cells, drops and display of the frame that was simulated last. The background is made the first
  /// time, and again when another scene is shown.
  void render(Recorder* recorder = nullptr);
  /// Both: one call for each frame of a film.
  void next_frame(Recorder* recorder = nullptr) {
    simulate(recorder);
    render(recorder);
  }

  /// From the next render on, another scene behind the glass: width x height, four channels. Throws Error(usage) for another shape.
  void show(const Image& colour);
  /// The same of the scene that was behind the glass when a state was saved that is loaded now: its background, if it was recorded then, is
  /// not recorded once more.
  void show_again(const Image& colour);

  /// Frames simulated so far.
  int frame() const;

  const Image& background() const;  ///< rgba16f: the scene out of focus
  const Image& cells() const;       ///< corrected: rgba32f, see docs/effects/screen_drops.md
  const Image& height() const;      ///< corrected: r16f, flowing water [mm]; 1 x 1 without flow
  const Image& water() const;       ///< r8: as-published layer / 4 of the drop that the pixel shows, corrected its coverage
  const Image& colour() const;      ///< rgba16f: linear radiance
  const Image& picture() const;     ///< rgba8: display code; row 0 = bottom

  /// Lists what it holds between frames, to be saved and loaded (Simulation::save); within rainref.
  void list_state(state::Items& items);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Bytes that settings take at their peak, within 10 %: every buffer, level and scratch of src/screen_drops/memory.cpp. The caller's images
/// and flowing water are not counted.
std::uint64_t memory_bytes(const Settings& settings);

}  // namespace rainref::screen_drops
