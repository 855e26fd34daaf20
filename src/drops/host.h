// Values that follow from the settings: uniforms of the passes, in double, each rounded once.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/memory.h"
#include "drops/records.h"
#include "drops/settings.h"
#include "drops/uniforms.h"

namespace rainref::drops {

/// Plane coordinates of the glass [m]: x = f[0] u + f[1] v, y = f[2] v.
using PlaneFrame = std::array<double, 3>;

/// dt [s] of one run of the pass. as-published ignores the frame.
IntegrateUniforms integrate_uniforms(const Settings& settings, const PlaneFrame& frame, double dt);
/// columns, rows: of the film; drying: film_loss of the step.
MergeUniforms merge_uniforms(const Settings& settings, const PlaneFrame& frame, double dt, int columns, int rows, std::int64_t drying);
/// For settings with neck_time > 0.
NecksUniforms necks_uniforms(const Settings& settings, const PlaneFrame& frame, double dt);
/// Base radius [m] divided by the cube root of the mass in mass units, for the mean contact angle.
double radius_of_mass_unit(const Settings& settings);
/// Mass units that a texel of the film, of this area [m^2], loses in step n at this number of steps per second: whole, exact in the long
/// run, and at most most_mass.
std::int64_t film_loss(const Settings& settings, double texel_area, std::int64_t n, double steps_per_second);

/// The glass's exposure to the rain, in the axes of the car.
struct Exposure {
  double area;         ///< of the glass [m^2]
  double normal_z;     ///< upward component of its outward normal
  double normal_wind;  ///< apparent wind along that normal [m/s]; negative: onto the glass
  // If the rain changes:
  double rain_rate = -1;       ///< corrected: rate in this step [mm/h]; negative: rain.rate
  std::int64_t arrivals = -1;  ///< as-published: drops in this step; negative: by spawn_rate
  bool operator==(const Exposure&) const = default;
};

/// Inputs of spawn besides the drops.
struct SpawnPlan {
  SpawnUniforms uniforms;
  std::vector<CountThreshold> thresholds;  ///< for one draw, ascending
  std::vector<SpawnMass> masses;           ///< 1024 size classes, lightest first
  double mean = 0;                         ///< expected arrivals
};

/// A cell of the distribution of drop sizes in the air.
struct SizeCell {
  double diameter;  ///< [mm]
  double number;    ///< drops of this cell in the air [1/m^3]
  double fall;      ///< terminal velocity [m/s]
};

/// The arrivals of an effect. Caches the tables of the last exposure.
class Arrivals {
 public:
  explicit Arrivals(const Settings& settings);
  /// The arrivals of step n at this number of steps per second. first_id: DropArrays::next_id(); room: its free slots.
  /// corrected: drops of diameter D [mm] arrive at N(D) max(0, v(D) normal_z - normal_wind) on each m^2, Marshall and Palmer's N(D), Gunn
  /// and Kinzer's v(D); a Poisson number of them. as-published (the source is silent): the count floor(rate (n + 1) / steps_per_second) -
  /// floor(rate n / steps_per_second), masses evenly from mass_min to mass_max.
  const SpawnPlan& plan(const Exposure& exposure, std::int64_t n, double steps_per_second, std::uint32_t first_id, std::int64_t room);

 private:
  void make_tables(const Exposure& exposure, double steps_per_second);
  Settings settings_;
  std::vector<SizeCell> sizes_;  // smallest first, for rate_
  double rate_;                  // [mm/h]
  Exposure made_for_{-1, 0, 0};
  double made_rate_ = 0;
  SpawnPlan plan_;
};

/// corrected: arrivals [1/m^2/s] of drops of at least rain.smallest_drop, and their water [kg/m^2/s].
struct Flux {
  double drops, water;
};
Flux flux(const Settings& settings, double normal_z, double normal_wind);

/// Memory of WetGlass and the scratch of its passes, with a film of columns x rows texels and at most `live` drops; lean: whether drops may
/// lean.
MemoryPeak memory(const Settings& settings, int columns, int rows, std::int64_t live, bool lean);

}  // namespace rainref::drops
