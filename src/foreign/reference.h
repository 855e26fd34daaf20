// The shaders that a pack of a foreign effect brings with it, as its reference.
#pragma once

#include <memory>
#include <string>

#include "capture/pack_read.h"
#include "capture/pass_model.h"
#include "foreign/effect_file.h"

namespace rainref::foreign {

/// What computes a pack; null where rainref's own effect does. Throws Error(port_files) where it is damaged or is not what the manifest
/// says: passes, uniform blocks and the shapes of each case.
std::shared_ptr<const EffectFile> reference_of(const capture::Pack& pack);

/// A pass of it on a case that is as it describes. The effect and the case must outlive the model. Throws as spirv::spirv_model(); null for
/// a pass that it has not.
std::unique_ptr<capture::PassModel> model_of(const EffectFile& effect, const std::string& pass, const capture::PassCase& c);

/// What a pass is given in a run, without values, as its description says.
capture::PassCase case_of(const EffectFile& effect, const Pass& pass, int frame, int step);

}  // namespace rainref::foreign
