// Shadow lockstep judges each dumped run of a pass as one step from the port's own inputs.
//
// The run is recomputed from these inputs and uniforms, so errors do not grow, however long the port ran freely. Each input must equal, bit
// for bit, the output of the run that it comes from. So the steps together cover the whole simulation.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "judge/judge_pass.h"
#include "judge/shadow_plan.h"
#include "judge/validate.h"

namespace rainref::judge {

/// Judges the dumps in `folder`, laid out as a pack: in.*, uniforms.bin and out.* of each run in `dumped`.
///
/// A run fails if an output lies outside what the profile allows for its inputs, or if an input is not the output that the graph names. It
/// fails if its uniforms cannot be its own (NaN, another frame's time, another run's counter), or if other uniforms, the host's inputs or
/// the initial state differ from the plan by more than host_values.h allows, unless ValidateOptions::foreign_host permits that. A planned
/// run that was not dumped is not judged. Outputs of Judge::input_only are taken as they are.
///
/// Missing or unusable files are listed in PortJudgement::files; runs that need them are not judged, all others are. Throws
/// Error(port_files) for a run that is not in the plan.
PortJudgement shadow(const ShadowPlan& plan, const std::filesystem::path& folder, const std::vector<DumpedRun>& dumped,
                     const ValidateOptions& options);

/// Loads one dumped run again, with the reference's outputs for its inputs; sets `untested` if that is impossible. Does not check links to
/// other runs.
PortRun shadow_run(const ShadowPlan& plan, const std::filesystem::path& folder, const std::vector<DumpedRun>& dumped,
                   const ValidateOptions& options, const std::string& id);

}  // namespace rainref::judge
