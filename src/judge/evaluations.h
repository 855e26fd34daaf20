// What this build can evaluate of a pass, bound to a run.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "capture/pack_read.h"
#include "capture/pass_case.h"
#include "capture/pass_model.h"

namespace rainref::judge {

/// Binds a pass to a case: capture::PassEvaluations::bind, or the shader that a pack brings with it.
using Bind = std::function<std::unique_ptr<capture::PassModel>(const capture::PassCase&)>;

/// The evaluations that this build has of a pass, or null: it has none of a foreign effect.
const capture::PassEvaluations* evaluations_of(const std::string& effect, const std::string& pass);
/// Its binder; null where no output is judged by envelope.
Bind binder(const std::string& effect, const std::string& pass);
/// Of a pass of a pack: of a foreign effect's the shader is bound. Throws as foreign::reference_of().
Bind binder(const capture::Pack& pack, const std::string& pass);

/// Whether an output is judged by envelope.
bool is_enveloped(const capture::PassCase& c);
/// The model of a run; null where no output is judged by one. Throws Error(internal) when it needs one and there is no
/// `bind`, and what `bind` throws.
std::unique_ptr<capture::PassModel> bound(const std::string& pass, const Bind& bind, const capture::PassCase& c);

}  // namespace rainref::judge
