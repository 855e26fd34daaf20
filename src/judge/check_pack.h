// A pack against what this build declares of its effect, before anything of it is evaluated.
#pragma once

#include "capture/pack_read.h"
#include "capture/pass_model.h"
#include "rainref/executor.h"

namespace rainref::judge {

/// Checks the uniform blocks, and every case's shapes, formats and uniforms, by the manifest alone: capture::check_case
/// and capture::uniform_fault. Throws Error(port_files) naming the pack and the case; Error(usage) for an effect that this
/// build does not know. A pack that brings its reference is checked against that: foreign::reference_of().
void check_pack(const capture::Pack& pack);

/// A case of a checked pack with its values; Error(port_files) where a record holds a float that is no finite number.
capture::PassCase read_case(const capture::Pack& pack, const capture::PackCase& entry);

/// The case's expected outputs are the reference's: else the pack is of another version, or damaged in a way that its
/// hashes do not show. Error(port_files) then.
void require_reference(const capture::Pack& pack, const capture::PassCase& c, const capture::PassModel& model,
                       const parallel::Executor& executor);

}  // namespace rainref::judge
