// Descriptions of the passes and records of this room, for the effects that use them.
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
/// The passes, with the passes of the effect that write their inputs. spawn takes the drops of the previous step, from the last writer of
/// as-published and of corrected.
capture::PassInfo spawn_info(const std::array<std::string, 2>& last_writers);
capture::PassInfo integrate_info(const std::string& glass_frame_pass);
/// before: the pass that wrote the drops. film_from: the pass that wrote the film earlier in the same step, or "merge" of the previous
/// step.
capture::PassInfo merge_info(const std::string& before, const std::string& film_from);
/// before: as for merge.
capture::PassInfo necks_info(const std::string& before);
/// drops_from: as-published first.
capture::PassInfo splat_info(const std::array<std::string, 2>& drops_from);
/// The buffers that splat writes.
std::vector<capture::BufferInfo> splat_buffers();

/// Only the corrected part, for an effect whose as-published variant has no such drops.
capture::PassInfo corrected_only(capture::PassInfo pass);
std::vector<capture::BufferInfo> corrected_only(std::vector<capture::BufferInfo> buffers);

/// A profile that allows more than every other, so that a decision settled under it is settled under all. It is used to find groups of
/// drops that share decisions.
const enclosed::Profile& loosest_profile();

/// The order in which drops take others: by mass, for equal masses the lower id is larger.
inline bool is_larger(const Drop& a, const Drop& b) { return a.mass != b.mass ? a.mass > b.mass : a.id < b.id; }

/// A circle that contains a drop's base on every device, rearranged or not.
struct Surroundings {
  double x, y, radius;  ///< in the plane [m]

  /// frame: from the uniforms; base: the reference's radius of the drop [m].
  Surroundings(const float (&frame)[3], const Drop& drop, double base);
  /// Whether the drops may touch; drops that do not meet touch on no device.
  bool meets(const Surroundings& other) const;
};
/// The pairs that meet by their numbers, the lower one first, ascending. Drops of like sizes cost their neighbours, however many there are.
std::vector<std::pair<std::size_t, std::size_t>> meeting_ones(const std::vector<Surroundings>& all);

std::unique_ptr<capture::PassModel> bind_merge(const capture::PassCase& c);
std::unique_ptr<capture::PassModel> bind_necks(const capture::PassCase& c);
std::unique_ptr<capture::PassModel> bind_integrate(const capture::PassCase& c);
std::unique_ptr<capture::PassModel> bind_splat(const capture::PassCase& c);
/// spawn: the previous drops and the arrivals.
std::vector<capture::Array> recompute_spawn(const capture::PassCase& c);
/// Evaluation of an effect's spawn. The live drops determine the free ids and the number of arrivals that fit.
capture::PassEvaluations spawn_evaluations();

}  // namespace rainref::drops
