// Whether a captured case is one that its pass, as this build declares it, can be evaluated on. Packs and dumps come from
// anywhere, and everything behind this check trusts what it let through.
#pragma once

#include <span>
#include <string>

#include "capture/pass_info.h"
#include "scene/parameter.h"

namespace rainref::capture {

/// Checks what can be said without the values: pass and variant, the uniform block's size, each buffer's name, format,
/// record layout and size, and how outputs are judged. An input that is loaded texel by texel has the outputs' size, all
/// image outputs of a pass have one, and buffers whose format one scene key chooses have one format. That an input is
/// there at all the pass's model asks. `parameters` are the effect's scene keys.
/// Throws Error(port_files): "puddle.display/0011.0: in.colour: expected 35x21 as out.picture has, found 71x43".
void check_case(const EffectInfo& effect, std::span<const scene::Parameter> parameters, const PassCase& c);

/// Why nothing can be computed with the case's uniforms, or "": "uniform step is 200, expected 1 to 8". For a case that
/// check_case accepts, like the next.
std::string uniform_fault(const EffectInfo& effect, const PassCase& c);
/// The same of its input records, whose floats are finite numbers: "in.drops: record 3: x is nan, expected a finite number".
std::string record_fault(const PassCase& c);

}  // namespace rainref::capture
