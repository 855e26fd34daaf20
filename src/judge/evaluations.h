// What this build can evaluate of a pass, bound to a run.
#pragma once

#include <memory>
#include <string>

#include "capture/pass_case.h"
#include "capture/pass_model.h"

namespace rainref::judge {

/// Binds a pass to a case: capture::PassEvaluations::bind.
using Bind = std::unique_ptr<capture::PassModel> (*)(const capture::PassCase&);

/// The evaluations that this build has of a pass, or null; Error(usage) for an effect that it does not know.
const capture::PassEvaluations* evaluations_of(const std::string& effect, const std::string& pass);
/// Its binder; null where no output is judged by envelope.
Bind binder(const std::string& effect, const std::string& pass);

/// Whether an output is judged by envelope.
bool is_enveloped(const capture::PassCase& c);
/// The model of a run; null where no output is judged by one. Throws Error(internal) when it needs one and there is no
/// `bind`, and what `bind` throws.
std::unique_ptr<capture::PassModel> bound(const std::string& pass, Bind bind, const capture::PassCase& c);

}  // namespace rainref::judge
