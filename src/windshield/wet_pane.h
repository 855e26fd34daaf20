// One pane of the car: its drops, blades and textures, and the order of the passes on them. No arithmetic.
#pragma once

#include <vector>

#include "blur_pyramid/blur_pyramid.h"
#include "drops/wet_glass.h"
#include "rainref/windshield.h"
#include "windshield/motion/shelter.h"
#include "windshield/motion/weather.h"
#include "windshield/parameters.h"

namespace rainref::windshield {

/// Rows of a tile, for the passes whose tiles are whole rows.
inline constexpr int tile_rows = 4;

class WetPane {
 public:
  /// settings: of this pane (settings_of_pane), number: 0 for the windshield. The executor must outlive it. Throws Error(usage) for invalid
  /// blades or an invalid eye.
  WetPane(const Settings& settings, int number, const Vehicle& vehicle, const parallel::Executor& executor);

  void begin_frame() { wipers_.clear(); }
  /// Runs windshield_frame to merge: the step after n others, from time t [s].
  void step(const pass::Moment& now, std::int64_t n, double t, const VehicleState& car, const Weather& weather);
  /// Runs splat to normals of frame number `frame`.
  void draw(const pass::Moment& now, int frame);
  /// Runs only those passes that later frames need: splat to condense.
  void leave_traces(const pass::Moment& now, int frame);
  /// composite: the scene through the pane, into a picture of the camera's size. `before`: host time already spent on it [s]. If the pane
  /// does not show its drops, they are as thin as the film.
  void composite(const pass::Moment& now, const blur_pyramid::LevelTexture& pyramid, std::span<const Image> levels,
                 const Image& scene_depth, std::span<const Glint> lights, bool shows_drops, Image& colour, double before);
  /// soften, on the output of composite; for a scene with smear.
  void soften(const pass::Moment& now, const blur_pyramid::LevelTexture& pyramid, std::span<const Image> levels, Image& colour) const;
  /// mist, on that output; for panes with condensation.
  void mist(const pass::Moment& now, const blur_pyramid::LevelTexture& pyramid, std::span<const Image> levels, Image& colour) const;

  /// The state between frames. The blades are not part of it; the steps of a frame set them.
  void list_state(state::Items& items);
  /// The blades of a step like step(), without the drops; the passes on the textures use their path over the frame. For a frame that was
  /// simulated elsewhere.
  void sweep(std::int64_t n, double t, double dt);
  /// Likewise the forces on the drops in that step, which determine their lean.
  void take_forces(double t, const VehicleState& car, const Weather& weather);

  const Settings& settings() const { return settings_; }
  /// Records of the frame's steps, in order.
  std::span<const Wiper> wipers() const { return wipers_; }
  const CompositeUniforms& view() const { return view_; }
  const Glass& glass() const { return glass_; }
  std::vector<DropView> drops() const;
  MassBalance mass_balance() const;
  const Image& height() const { return height_; }
  const Image& mask() const { return mask_; }
  const Image& normal() const { return normal_; }
  const Image& smear() const { return smear_; }
  const Image& condensation() const { return condensation_; }
  const Image& film() const { return water_.film; }

 private:
  template <class P, class Body>
  void run(const pass::Moment& now, const typename P::Uniforms& uniforms, const pass::HostIo<P>& io, const Body& body) const;
  std::vector<Wiper> swept(std::int64_t n, double t, double dt) const;
  void wipe(const pass::Moment& now, std::int64_t n, double t);
  void wipe_texture(const pass::Moment& now, int frame);
  void leave_smear(const pass::Moment& now);
  void condense(const pass::Moment& now, int frame);
  drops::Exposure exposure(std::int64_t n, double t, const VehicleState& car, const Weather& weather) const;

  Settings settings_;
  const parallel::Executor& executor_;
  bool corrected_, has_blades_;  ///< a further pane may have no blades; the passes of blades then do not run on it
  Glass glass_;
  PlaneFrame plane_;
  CompositeUniforms view_;
  Shelter shelter_;
  drops::WetGlass water_;
  drops::GlassFrame forces_{};  ///< of the last step
  std::vector<Wiper> wipers_;   ///< of the frame
  Image height_, mask_, wiped_, normal_;
  Image previous_height_;            ///< if it persists
  Image laid_, smear_, profile_;     ///< with smear, for a pane with blades
  Image clear_time_, condensation_;  ///< with condensation
};

/// Distance of a glass's centre before the car's origin [m].
double middle_of(const Glass& glass);
/// The wind relative to the car, in its axes [m/s], from a wind in world axes.
Real3 apparent_wind(const VehicleState& car, const Real3& wind);
/// Its component along the outward normal of a glass; negative: onto it.
double wind_along_normal(const Glass& glass, const VehicleState& car, const Real3& wind);

}  // namespace rainref::windshield
