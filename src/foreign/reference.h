// The reference shaders that a pack of a foreign effect contains.
#pragma once

#include <memory>
#include <string>

#include "capture/pack_read.h"
#include "capture/pass_model.h"
#include "foreign/effect_file.h"

namespace rainref::foreign {

/// Reads a pack's own reference; null if the effect is one of rainref's. Throws Error(port_files) if it is damaged or does not match the
/// manifest: passes, uniform blocks and the shapes of each case.
std::shared_ptr<const EffectFile> reference_of(const capture::Pack& pack);

/// The model of a pass on a case that matches the description; null for a pass that the effect lacks. The effect and the case must outlive
/// it. Throws like spirv::spirv_model().
std::unique_ptr<capture::PassModel> model_of(const EffectFile& effect, const std::string& pass, const capture::PassCase& c);

/// The inputs of a pass in a run, without values, from its description.
capture::PassCase case_of(const EffectFile& effect, const Pass& pass, int frame, int step);

}  // namespace rainref::foreign
