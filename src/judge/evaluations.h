// This build's evaluations of a pass, bound to a run.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "capture/pack_read.h"
#include "capture/pass_case.h"
#include "capture/pass_model.h"

namespace rainref::judge {

/// Binds a pass to a case: capture::PassEvaluations::bind, or a shader from the pack.
using Bind = std::function<std::unique_ptr<capture::PassModel>(const capture::PassCase&)>;

/// Returns this build's evaluations of a pass; null for a foreign effect.
const capture::PassEvaluations* evaluations_of(const std::string& effect, const std::string& pass);
/// Returns the binder of a pass; null if no output is judged by envelope.
Bind binder(const std::string& effect, const std::string& pass);
/// Returns the binder of a pass of a pack; for a foreign effect it binds the shader. Throws like foreign::reference_of().
Bind binder(const capture::Pack& pack, const std::string& pass);

/// True if an output is judged by envelope.
bool is_enveloped(const capture::PassCase& c);
/// Returns the model of a run; null if no output is judged by one. Throws Error(internal) if it needs a model and there is no `bind`, and
/// whatever `bind` throws.
std::unique_ptr<capture::PassModel> bound(const std::string& pass, const Bind& bind, const capture::PassCase& c);

}  // namespace rainref::judge
