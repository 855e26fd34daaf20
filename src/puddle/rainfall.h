// Pass raindrops, corrected: the drops that fall in a wave step. It uses integers and host tables, so all machines agree.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "puddle/uniforms.h"
#include "rainref/puddle.h"
#include "random/poisson.h"
#include "random/words.h"

namespace rainref::puddle {

/// A roof over [x0, x1] x [z0, z1], world [m].
struct Roof {
  double x0, z0, x1, z1;
};
/// "x0 z0 x1 z1; ..." Throws Error(usage) with the roof and the key rain.shelter for any other text, more than 64 roofs, and corners in the
/// wrong order or beyond 10 km.
std::vector<Roof> parse_roofs(std::string_view text);

/// The number of drops out of 65536 over a cell that fall; row-major, row 0 = lowest z. Empty: all of them everywhere.
struct Shelter {
  int columns = 0, rows = 0;
  std::vector<ShelterCell> cells;
};
/// From rain.shelter: for each cell of the wave's grid the share that no roof covers (too low if several roofs cover parts of one cell).
/// From a picture (Surroundings::shelter): its texels, rounded to nearest. Throws Error(usage) if both are given.
Shelter shelter_of(const Settings& settings, const Image& picture);

/// [texels]; a smaller crater would not be resolved, so its energy is spread over this radius
inline constexpr double least_crater_radius = 3;

/// The water's rectangle, as used for drops.
struct WaterEdges {
  std::uint32_t columns, rows;
  std::int32_t boundary;  ///< see RainfallUniforms::boundary
};
WaterEdges edges_of(const Settings& settings);
/// Appends a drop in the rectangle and its images beyond the edges, as Rainfall::drops says.
void add_with_images(const Drop& drop, const WaterEdges& edges, std::vector<Drop>& out);

/// Inputs of raindrops besides its uniforms.
struct RainTables {
  std::span<const Drop> craters;
  std::span<const std::uint32_t> thresholds;
  std::span<const ShelterCell> shelter;  ///< row-major; empty: none
  std::span<const Drop> objects;         ///< effect of the objects in this step
};
/// The drops of a step, from the inputs of the GPU. The count comes from ascending thresholds; position, size and shelter come from a hash
/// of (seed, step, i). The records of objects follow. Throws Error(port_files) if the uniforms name more thresholds, size classes, drops or
/// objects than possible, or another shelter. W: random::Words or PerturbedWords.
template <class W = random::Words>
std::vector<Drop> drops_of(const RainfallUniforms& uniforms, const RainTables& tables);

/// Drops of step k are a function of (seed, k): the count by a Poisson table, position and size from a hash of (seed, k, i).
class Rainfall {
 public:
  /// stored_per_metre: stored units per metre of height.
  Rainfall(const Settings& settings, double stored_per_metre, Shelter shelter = {});

  /// Positions are multiples of 1/256 texel: x = ((word >> 16) * width >> 8) / 256, exact in float. A crater that reaches over an edge is
  /// followed by its mirror images (reflecting) or its copies on the other side (periodic), so that no water is lost at the edge. The
  /// records of objects in this step follow.
  std::vector<Drop> drops(std::int64_t step, std::span<const Drop> objects = {}) const;

  /// Expected number of drops in a step.
  double mean() const { return mean_; }
  static constexpr int sizes = 1024;
  /// Crater amplitude (stored units) and radius (texels) of the size class; class 0 holds the smallest drops.
  const Drop& crater(int size_class) const { return craters_[static_cast<std::size_t>(size_class)]; }

  /// The inputs of drops(step), for callers who draw the drops elsewhere.
  RainfallUniforms uniforms(std::int64_t step, std::size_t objects = 0) const;
  const std::vector<Drop>& craters() const { return craters_; }
  const std::vector<std::uint32_t>& count_thresholds() const { return count_.thresholds(); }
  const std::vector<ShelterCell>& shelter() const { return shelter_.cells; }

 private:
  std::uint64_t seed_;
  WaterEdges edges_;
  Shelter shelter_;
  double mean_ = 0;
  random::PoissonTable count_;
  std::vector<Drop> craters_;
};

/// Depth of the crater at its centre [m] of a drop of this diameter [m] that hits at this speed [m/s]: the potential
/// energy of the crater shape of wave_step, radius R [m], is 1 % of the drop's kinetic energy.
///   rho g A^2 pi R^2 (3/35) / 2 = 0.01 * (rho pi D^3 / 6) v^2 / 2
double crater_depth(double diameter, double speed, double radius);

}  // namespace rainref::puddle
