// The flowing layer described to others: its scene keys; its passes, buffers and records, of corrected alone; and its passes
// as conformance takes them.
#pragma once

#include <vector>

#include "capture/pass_info.h"
#include "capture/pass_model.h"
#include "scene/parameter.h"

namespace rainref::screen_drops {

/// Of corrected alone: flow.capacity, flow.height_size, ..., rain.rate, rain.smallest_drop, rain.wind, world.gravity. Size
/// of the pane and rounding are keys of the effect.
std::vector<scene::Parameter> flow_parameters();

/// In the order of execution: spawn, integrate, merge, splat.
std::vector<capture::PassInfo> flow_passes();
/// What they exchange: drops, glass_frame, count_thresholds, spawn_masses, film, height.
std::vector<capture::BufferInfo> flow_buffers();
std::vector<scene::UniformBlock> flow_records();

/// Each of the four passes bound to captured cases.
std::vector<capture::PassEvaluations> flow_evaluations();

}  // namespace rainref::screen_drops
