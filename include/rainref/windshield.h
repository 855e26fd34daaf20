// Rain on a windshield that moves with the car: "Building a windshield rain system that moves with the car", as published and corrected.
// Mathematics, choices and the list of corrections: docs/effects/windshield.md.
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

/// The scene before the car: pictures, or a street.
struct Surroundings {
  Image colour;  ///< rgba16f: linear radiance in the camera's view widened by scene.margin; row 0 = bottom
  Image depth;   ///< r32f: distance along the view axis [m], finite, the sky far away; same size
  std::shared_ptr<const scene::Scenery> street = nullptr;  ///< instead of pictures: street_at_night() of rainref/simulation.h
};

/// A drop as passes exchange it; see src/drops/records.h.
struct DropView {
  float u, v, velocity_u, velocity_v, mass, life;
  std::uint32_t id;
};

/// A drop in the air behind the glass, in car axes: x forward, y left, z up.
struct FallingDropView {
  std::array<double, 3> from, to;  ///< centre when the shutter opens and when it closes [m]
  double radius;                   ///< [m]
  double time_share;               ///< share of the exposure for which it covers a point of its path: above 0, at most 1
  std::array<double, 3> radiance;  ///< linear RGB
};

/// Water since the start, in whole mass units of 2e-11 kg (as-published: in drops).
struct MassBalance {
  std::int64_t spawned, evaporated, removed, film, drops;
  /// corrected: exactly 0.
  std::int64_t residual() const { return spawned - evaporated - removed - film - drops; }
};

/// A car with its windshield, further panes, wipers and drops, advanced frame by frame. The bits of every buffer do not depend on the
/// number of threads or the SIMD target.
class Windshield {
 public:
  /// Makes a scene of this effect; `Windshield({}, {{}, {}, street_at_night()}, executor)` makes the default one. Throws Error(usage) with
  /// place and key for an invalid scene and for one that cannot run: corners on a line, a blade longer than the glass, an invalid drive
  /// cycle, pictures that the scene names (`surroundings` must hold them), neither pictures nor a street, keys of traced pictures. The
  /// executor must outlive the windshield.
  Windshield(const SceneText& scene, Surroundings surroundings, const parallel::Executor& executor);
  /// The same for a scene that rainref has already read and checked.
  Windshield(const scene::Config& config, Surroundings surroundings, const parallel::Executor& executor);
  ~Windshield();
  Windshield(Windshield&&) noexcept;

  /// Replaces the pictures for later frames. Throws Error(usage) if size or format differs, or if the windshield shows the street.
  void show(Surroundings scene);

  /// Runs windshield_frame to merge, from time frame / fps to (frame + 1) / fps. Frames run in the order 0, 1, 2 ...
  void simulate(Recorder* recorder = nullptr);
  /// Runs splat to display for the last simulated frame. Call it once for each frame, because later frames use the wiped textures.
  void render(Recorder* recorder = nullptr);
  /// Call it instead of render for a frame whose picture is not needed. It runs only the passes that later frames need, splat to
  /// wipe_texture, so later pictures stay the same.
  void skip(Recorder* recorder = nullptr);
  /// Does both: one call for each frame of an animation.
  void next_frame(Recorder* recorder = nullptr) {
    simulate(recorder);
    render(recorder);
  }

  /// Frames simulated so far.
  int frame() const;
  /// Number of panes: the windshield, which is pane 0, and those of windshield.panes. The functions below throw Error(usage) for another
  /// pane.
  int panes() const;
  /// The live drops of a pane, in slot order.
  std::vector<DropView> drops(int pane = 0) const;
  MassBalance mass_balance(int pane = 0) const;
  const Image& height(int pane = 0) const;  ///< r16f [mm]
  const Image& mask(int pane = 0) const;    ///< r16f: 1 where just wiped; 0 everywhere on a pane without wipers
  const Image& film(int pane = 0) const;    ///< corrected: r32f, whole mass units per texel
  /// corrected, with smear.on, on a pane with blades: rgba16f. x, y: direction of the blade that left the film; z: thickness of the film, 1
  /// the thickest
  const Image& smear(int pane = 0) const;
  const Image& condensation(int pane = 0) const;  ///< corrected, with condensation.on: r16f, the share of the light that the mist scatters
  const Image& normal(int pane = 0) const;        ///< rgba16f: normal in the axes of the glass
  // What the picture is made of:
  /// The rain behind the glass in the last rendered frame, the farthest drops first; empty if falling_rain.on is false.
  std::vector<FallingDropView> falling() const;
  const Image& scene_colour() const;  ///< rgba16f: linear radiance of the scene before the car, in the widened view, without fog
  const Image& scene_depth() const;   ///< r32f: depth of that scene along the view axis [m]
  const Image& colour() const;        ///< rgba16f: linear radiance
  const Image& picture() const;       ///< rgba8: display code values; row 0 = bottom

  /// Returns colour() of the last rendered frame without the drops on the windshield. The windshield's film, mist and smear, the further
  /// panes and the interior stay.
  Image without_drops() const;

  /// Lists the state kept between frames, for Simulation::save and load. Internal.
  void list_state(state::Items& items);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Peak memory [byte] of this scene in run.frames frames, within 10 % (src/windshield/memory.cpp): the buffers, the drops, the scratch of
/// their passes, and the street's pictures during rendering. Pictures given instead of the street are not counted.
std::uint64_t memory_bytes(const scene::Config& config);

}  // namespace windshield
}  // namespace rainref
