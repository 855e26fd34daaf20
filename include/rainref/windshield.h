// Rain on a windshield that moves with the car: "Building a windshield rain system that moves with the car", as published
// and corrected. Mathematics, choices and the list of what is corrected: docs/effects/windshield.md.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "rainref/executor.h"
#include "rainref/image.h"
#include "rainref/recorder.h"
#include "rainref/scene_text.h"

namespace rainref {
namespace scene {
class Config;
class Scenery;  // src/scene/scenery.h
}  // namespace scene
namespace state {
class Items;  // src/state/items.h
}

namespace windshield {

/// What lies before the car: pictures, or a street.
struct Surroundings {
  Image colour;  ///< rgba16f, linear radiance, in the camera's view widened by scene.margin; row 0 = bottom
  Image depth;   ///< r32f along the view axis [m], finite, the sky far away; of the same size
  std::shared_ptr<const scene::Scenery> street = nullptr;  ///< where there are no pictures: street_at_night() of rainref/simulation.h
};

/// A drop as passes exchange it; see src/drops/records.h.
struct DropView {
  float u, v, velocity_u, velocity_v, mass, life;
  std::uint32_t id;
};

/// A drop in the air behind the glass, in car axes: x forward, y left, z up.
struct FallingDropView {
  std::array<double, 3> from, to;  ///< its middle when the shutter opens and when it closes [m]
  double radius;                   ///< [m]
  double time_share;               ///< of the exposure in which it covers a point of its way: above 0, at most 1
  std::array<double, 3> radiance;  ///< linear RGB
};

/// Water since the start, in whole mass units of 2e-11 kg (as-published: in drops).
struct MassBalance {
  std::int64_t spawned, evaporated, removed, film, drops;
  /// corrected: exactly 0.
  std::int64_t residual() const { return spawned - evaporated - removed - film - drops; }
};

/// A windshield and further panes of a car, the wipers, the drops, the car. Advance it frame by frame; every buffer has the same bits
/// whatever the executor's threads and the SIMD target.
class Windshield {
 public:
  /// A scene of this effect, `Windshield({}, {{}, {}, street_at_night()}, executor)` the default one. Throws Error(usage), naming place and
  /// key, for what no scene may say and for one that cannot run: corners on a line, a blade longer than the glass, a drive cycle that is
  /// none, pictures named in the scene rather than given here, neither pictures nor a street, keys of traced pictures. The executor must
  /// outlive the windshield.
  Windshield(const SceneText& scene, Surroundings surroundings, const parallel::Executor& executor);
  /// The same of a scene that rainref's own programs have read and checked.
  Windshield(const scene::Config& config, Surroundings surroundings, const parallel::Executor& executor);
  ~Windshield();
  Windshield(Windshield&&) noexcept;

  /// The pictures that later frames show, where the windshield was made with pictures. Throws Error(usage) for others than of that size and
  /// format, and where it shows the street.
  void show(Surroundings scene);

  /// windshield_frame to merge, from time frame / fps to (frame + 1) / fps. Frames are 0, 1, 2 ... in this order.
  void simulate(Recorder* recorder = nullptr);
  /// splat to display of the frame that was simulated last. Once for each frame: the wiped textures have a past.
  void render(Recorder* recorder = nullptr);
  /// In place of render, where the picture of the frame is not wanted: the passes that leave something for later frames, splat to
  /// wipe_texture. Later pictures are the same.
  void skip(Recorder* recorder = nullptr);
  /// Both: one call for each frame of a film.
  void next_frame(Recorder* recorder = nullptr) {
    simulate(recorder);
    render(recorder);
  }

  /// Frames simulated so far.
  int frame() const;
  /// Panes of the car: the windshield, number 0, and those of windshield.panes. The members below throw Error(usage) for another number.
  int panes() const;
  /// The live drops of a pane, in slot order.
  std::vector<DropView> drops(int pane = 0) const;
  MassBalance mass_balance(int pane = 0) const;
  const Image& height(int pane = 0) const;  ///< r16f [mm]
  const Image& mask(int pane = 0) const;    ///< r16f: 1 just wiped; 0 everywhere on a further pane without wipers
  const Image& film(int pane = 0) const;    ///< corrected: r32f, whole mass units in a texel
  /// corrected, with smear.on, of a pane with blades: rgba16f, x, y along the blade that left the film, z its thickness, 1 the thickest
  const Image& smear(int pane = 0) const;
  const Image& condensation(int pane = 0) const;  ///< corrected, with condensation.on: r16f, share of the light that the mist scatters
  const Image& normal(int pane = 0) const;        ///< rgba16f: normal in the axes of the glass
  // Of the picture:
  /// The rain behind the glass of the frame that was rendered last, far drops first; empty where falling_rain.on is false.
  std::vector<FallingDropView> falling() const;
  const Image& scene_colour() const;  ///< rgba16f: linear radiance of what lies before the car, in the widened view, without fog
  const Image& scene_depth() const;   ///< r32f: along the view axis [m], there
  const Image& colour() const;        ///< rgba16f: linear radiance
  const Image& picture() const;       ///< rgba8: display code values; row 0 = bottom

  /// colour() as it would be if no drop were to be seen on the windshield: its film, mist and smear, further panes and the interior stay.
  /// Of the frame that was rendered last.
  Image without_drops() const;

  /// Lists what it holds between frames, to be saved and loaded (Simulation::save); within rainref.
  void list_state(state::Items& items);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Bytes that a windshield of this scene takes at its peak in run.frames frames, within 10 %: every buffer, the drops and what their passes
/// work with, the street's pictures while they are rendered; src/windshield/memory.cpp. Pictures given instead of the street are not
/// counted.
std::uint64_t memory_bytes(const scene::Config& config);

}  // namespace windshield
}  // namespace rainref
