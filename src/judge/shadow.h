// Shadow lockstep: each run of a pass that a port dumped, judged as one step from the inputs that the port itself gave it.
//
// The run is recomputed from the port's own inputs and uniforms, so that nothing explodes, however long the port ran
// freely; and each input must be, bit for bit, the output of the run that it comes from. Step by step, that covers all.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "judge/judge_pass.h"
#include "judge/shadow_plan.h"
#include "judge/validate.h"

namespace rainref::judge {

/// Judges the dumps in `folder`, laid out as a pack: in.*, uniforms.bin and out.* of each run, which are `dumped`.
///
/// A run fails when an output lies outside what the profile allows for its inputs, when an input is not the output that
/// the graph names, when its uniforms cannot be its own (a number that is none, another frame's time, another run's
/// counter), or when other uniforms, the host's inputs or the state that the run begins with are not the plan's: more than
/// host_values.h explains, unless ValidateOptions::foreign_host forgives that. A planned run that was not dumped is not
/// judged. Outputs of Judge::input_only are taken as they are.
///
/// Files that are missing or cannot be what they should be are in PortJudgement::files; the runs that need them are not
/// judged, all others are. Throws Error(port_files) for a run that the plan does not know.
PortJudgement shadow(const ShadowPlan& plan, const std::filesystem::path& folder, const std::vector<DumpedRun>& dumped,
                     const ValidateOptions& options);

/// One dumped run again, with what the reference gives for its inputs, for those who look closer: `untested` where that
/// cannot be had. Links to other runs are not checked.
PortRun shadow_run(const ShadowPlan& plan, const std::filesystem::path& folder, const std::vector<DumpedRun>& dumped,
                   const ValidateOptions& options, const std::string& id);

}  // namespace rainref::judge
