// The passes and records of this room described to others, for the effects that list them.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "capture/pass_info.h"
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

}  // namespace rainref::drops
