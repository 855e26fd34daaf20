// Finds out whether a port computed a failing pass from its own outputs of earlier passes, as a shader does that computes two passes at
// once.
#pragma once

#include <optional>

#include "capture/pack_read.h"
#include "judge/judge_pass.h"
#include "judge/port_files.h"

namespace rainref::judging {

/// The cause "made from the port's own X, not the pack's": X are inputs that another pass of the same step or frame gives and that the port
/// has dumped with other values. The run is judged once more with these. Nothing if the port has no such dumps, or if they explain less
/// than half of the failing texels; likely if they explain nine in ten. `port`: the folder that is judged.
std::optional<judge::Cause> made_from_own(const judge::FailedRun& failed, const capture::Pack& pack, judge::PortFiles& port);

/// The cause "computes X itself": X are inputs of a pass that a port need not write (`input_only`), whatever it gives. Likely if that
/// explains nine in ten of the failing texels; otherwise nothing. Other causes should be looked for first, because X may be anything.
std::optional<judge::Cause> computes_itself(const judge::FailedRun& failed, const capture::Pack& pack);

}  // namespace rainref::judging
