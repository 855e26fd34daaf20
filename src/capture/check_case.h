// Checks that a captured case fits the pass that this build declares. Packs and dumps may come from anyone; all later code relies on this
// check.
#pragma once

#include <span>
#include <string>

#include "capture/pass_info.h"
#include "scene/parameter.h"

namespace rainref::capture {

/// Checks everything but the values: pass and variant, the uniform block's size, each buffer's name, format, record layout and size, and
/// the way outputs are judged. An input that is loaded texel by texel must have the outputs' size. All image outputs of a pass must have
/// one size, and buffers whose format one scene key selects must have one format. The pass's model checks that inputs exist. `parameters`
/// are the effect's scene keys.
/// Throws Error(port_files): "puddle.display/0011.0: in.colour: expected 35x21 as out.picture has, found 71x43".
void check_case(const EffectInfo& effect, std::span<const scene::Parameter> parameters, const PassCase& c);

/// Explains why nothing can be computed from the case's uniforms, or returns "": "uniform step is 200, expected 1 to 8". This function and
/// the next need a case that check_case accepts.
std::string uniform_fault(const EffectInfo& effect, const PassCase& c);
/// The same for its input records, whose floats must be finite: "in.drops: record 3: x is nan, expected a finite number".
std::string record_fault(const PassCase& c);

}  // namespace rainref::capture
