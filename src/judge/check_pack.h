// Checks a pack against this build's declaration of its effect, before any pass is evaluated.
#pragma once

#include "capture/pack_read.h"
#include "capture/pass_model.h"
#include "rainref/executor.h"

namespace rainref::judge {

/// Checks the uniform blocks, the formulas' revisions, and each case's shapes, formats and uniforms, from the manifest alone:
/// capture::check_case and capture::uniform_fault. Throws Error(port_files) naming the pack and the case; Error(usage) for an effect that
/// this build does not know. A pack with its own reference is checked against that: foreign::reference_of().
void check_pack(const capture::Pack& pack);

/// Reads a case of a checked pack with its values; Error(port_files) if a float of a record is not finite.
capture::PassCase read_case(const capture::Pack& pack, const capture::PackCase& entry);

/// Checks that the case's expected outputs are the reference's. Otherwise the pack is of another version, or damaged in a way that its
/// hashes do not show: Error(port_files).
void require_reference(const capture::Pack& pack, const capture::PassCase& c, const capture::PassModel& model,
                       const parallel::Executor& executor);

}  // namespace rainref::judge
