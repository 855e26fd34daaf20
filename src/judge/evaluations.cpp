#include "judge/evaluations.h"

#include <algorithm>

#include <fmt/format.h>

#include "foreign/reference.h"
#include "judge/slots.h"
#include "rainref/error.h"
#include "registry/evaluations.h"
#include "registry/registry.h"

namespace rainref::judge {

const capture::PassEvaluations* evaluations_of(const std::string& effect, const std::string& pass) {
  if (!registry::find(effect)) return nullptr;
  for (const capture::PassEvaluations& r : registry::evaluations(effect))
    if (r.pass == pass) return &r;
  return nullptr;
}
Bind binder(const std::string& effect, const std::string& pass) {
  const capture::PassEvaluations* evaluations = evaluations_of(effect, pass);
  return evaluations ? Bind(evaluations->bind) : nullptr;
}
Bind binder(const capture::Pack& pack, const std::string& pass) {
  const std::shared_ptr<const foreign::EffectFile> effect = foreign::reference_of(pack);
  if (!effect) return binder(pack.effect, pass);
  return [effect, pass](const capture::PassCase& c) { return foreign::model_of(*effect, pass, c); };
}

bool is_enveloped(const capture::PassCase& c) {
  return std::any_of(c.outputs.begin(), c.outputs.end(), [](const auto& o) { return is_placed(o); });
}

std::unique_ptr<capture::PassModel> bound(const std::string& pass, const Bind& bind, const capture::PassCase& c) {
  if (!bind && is_enveloped(c)) throw Error(ExitCode::internal, fmt::format("no evaluation of pass {}", pass));
  const auto has_model = [](const capture::CaseOutput& o) {
    return o.judge == capture::Judge::envelope || o.judge == capture::Judge::keyed;
  };
  return bind && std::any_of(c.outputs.begin(), c.outputs.end(), has_model) ? bind(c) : nullptr;
}

}  // namespace rainref::judge
