// Passes that take lists of drops, as conformance takes them.
#pragma once

#include <memory>
#include <vector>

#include "capture/pass_model.h"
#include "drops/records.h"

namespace rainref::drops {

/// Allows more than every profile: what is settled under it is settled under each of them. Groups of drops that share
/// decisions are found by it.
const enclosed::Profile& loosest_profile();

/// Of two drops that touch the larger takes the other: by mass, of equal ones that of lower id.
inline bool is_larger(const Drop& a, const Drop& b) { return a.mass != b.mass ? a.mass > b.mass : a.id < b.id; }

/// A circle that holds a drop's base as every device has it, rearranged or not.
struct Surroundings {
  double x, y, radius;  ///< in the plane [m]

  /// frame: of the uniforms; base: the drop's radius as the reference has it [m].
  Surroundings(const float (&frame)[3], const Drop& drop, double base);
  /// Whether the drops may touch: those that do not meet touch on no device.
  bool meets(const Surroundings& other) const;
};

std::unique_ptr<capture::PassModel> bind_merge(const capture::PassCase& c);
std::unique_ptr<capture::PassModel> bind_necks(const capture::PassCase& c);
std::unique_ptr<capture::PassModel> bind_integrate(const capture::PassCase& c);
std::unique_ptr<capture::PassModel> bind_splat(const capture::PassCase& c);
/// spawn: the drops of before and the arrivals.
std::vector<capture::Array> recompute_spawn(const capture::PassCase& c);
/// How an effect offers its spawn: which ids are free and how many hangs on the drops that live.
capture::PassEvaluations spawn_evaluations();

}  // namespace rainref::drops
