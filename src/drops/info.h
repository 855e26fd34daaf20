// The passes and records of this room described to others, for the effects that list them.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "capture/pass_info.h"
#include "capture/pass_model.h"
#include "drops/records.h"
#include "scene/uniform_block.h"

namespace rainref::drops {

/// Drop, GlassFrame, Neck, SpawnMass, CountThreshold.
std::vector<scene::UniformBlock> records();
/// Buffers drops (both variants), glass_frame, count_thresholds, spawn_masses, necks and film.
std::vector<capture::BufferInfo> buffers();
/// The passes, and which other passes of the effect write what they read. spawn takes the drops of the step before, from the last writer
/// of as-published and of corrected.
capture::PassInfo spawn_info(const std::array<std::string, 2>& last_writers);
capture::PassInfo integrate_info(const std::string& glass_frame_pass);
/// before: the pass that wrote the drops; film_from: the pass that wrote the film before this one, in the same step, or "merge": that of
/// the step before.
capture::PassInfo merge_info(const std::string& before, const std::string& film_from);
/// before: as of merge.
capture::PassInfo necks_info(const std::string& before);
/// drops_from: of as-published first.
capture::PassInfo splat_info(const std::array<std::string, 2>& drops_from);
/// What splat writes.
std::vector<capture::BufferInfo> splat_buffers();

/// What corrected has of these, for an effect whose as-published has no such drops.
capture::PassInfo corrected_only(capture::PassInfo pass);
std::vector<capture::BufferInfo> corrected_only(std::vector<capture::BufferInfo> buffers);

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
/// The pairs that meet by their numbers, the lower one first, ascending. Drops of like sizes cost their neighbours, however many there are.
std::vector<std::pair<std::size_t, std::size_t>> meeting_ones(const std::vector<Surroundings>& all);

std::unique_ptr<capture::PassModel> bind_merge(const capture::PassCase& c);
std::unique_ptr<capture::PassModel> bind_necks(const capture::PassCase& c);
std::unique_ptr<capture::PassModel> bind_integrate(const capture::PassCase& c);
std::unique_ptr<capture::PassModel> bind_splat(const capture::PassCase& c);
/// spawn: the drops of before and the arrivals.
std::vector<capture::Array> recompute_spawn(const capture::PassCase& c);
/// How an effect offers its spawn: which ids are free and how many hangs on the drops that live.
capture::PassEvaluations spawn_evaluations();

}  // namespace rainref::drops
