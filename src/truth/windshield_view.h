// The windshield as rays see it: the driver's eye, a pane of glass, the water of a frame, the street at night behind it.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "compositor/pane_scene.h"
#include "compositor/picture.h"
#include "night_street/night_street.h"
#include "rainref/windshield.h"
#include "windshield/scene_keys.h"
#include "truth/tracer_names.h"

namespace rainref::truth {

struct WindshieldGlass {
  double thickness = 5e-3;  ///< [m]
  double radius = 0;        ///< of the bend across the car [m]; 0: flat
};

class WindshieldView {
 public:
  /// Throws Error(usage) for a pane that cannot be.
  WindshieldView(const windshield::Settings& settings, const WindshieldGlass& glass, const TracerOptions& tracer,
                 const parallel::Executor& executor);

  /// Surfaces and surroundings of the frame that was rendered last, committed. The view must outlive the scene,
  /// and the executor the view.
  std::unique_ptr<Scene> scene(const windshield::Windshield& rendered) const;
  /// The same with these height textures [mm], of the windshield and of as many further panes as there are, the car `distance` metres on
  /// from where it began.
  /// `falling` rain behind the glass must outlive the scene.
  std::unique_ptr<Scene> scene(std::span<const Image* const> heights, double distance,
                               std::span<const windshield::FallingDropView> falling = {}) const;
  /// Where the car of that frame is along the street [m].
  double distance(const windshield::Windshield& rendered) const;

  /// The windshield, and the car's further panes.
  const std::vector<Pane>& panes() const { return panes_; }
  const night_street::Street& street() const { return street_; }
  scene::Camera camera() const { return windshield::camera(settings_.picture); }
  const windshield::Settings& settings() const { return settings_; }

 private:
  windshield::Settings settings_;
  TracerOptions tracer_;
  const parallel::Executor& executor_;
  std::vector<Pane> panes_;
  windshield::Vehicle vehicle_;
  night_street::Street street_;
};

}  // namespace rainref::truth
