#include "judge/coverage.h"

#include <mutex>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "judge/pass_texts.h"
#include "math/perturbed.h"
#include "scene/unexercised.h"

namespace rainref::judge {

using perturbed::Coverage;

Coverage coverage_of(const capture::PassCase& c, const capture::PassModel* model, const parallel::Executor& executor) {
  Coverage all;
  if (!model) return all;
  std::mutex mutex;  // sums of counts: in any order the same
  const auto counted = [&](const auto& evaluate) {
    Coverage own;
    perturbed::Behaviour counting;
    counting.coverage = &own;
    {
      const perturbed::Scope scope(counting);
      evaluate();
    }
    own.name_inputs([&](const float* texel) { return std::string(model->input_of(texel)); });
    const std::lock_guard lock(mutex);
    all.add(own);
  };
  executor.for_range(model->height(), 8, [&](std::int64_t begin, std::int64_t end) {
    counted([&] {
      std::vector<perturbed::Perturbed> unused(static_cast<std::size_t>(model->values()));
      for (std::int64_t y = begin; y < end; ++y)
        for (int x = 0; x < model->width(); ++x) model->evaluate(x, static_cast<int>(y), unused.data());
    });
  });
  for (const capture::CaseOutput& out : c.outputs)
    if (const capture::KeyedModel* list = out.judge == capture::Judge::keyed ? model->keyed(out.name) : nullptr)
      counted([&] { static_cast<void>(list->perturbed()); });
  return all;
}

std::string alternative(const perturbed::Decision& d, int side) {
  if (d.kind == perturbed::DecisionKind::address || d.kind == perturbed::DecisionKind::load)
    return fmt::format("{} of {} by {}: {}", name(d.kind), d.input.empty() ? "an image" : d.input, d.file, side_name(d.kind, side));
  const std::string_view line = pass_line(d.file, d.line);
  return fmt::format("{}, {} {}: {}", d.file.substr(d.file.rfind('/') + 1), name(d.kind), side_name(d.kind, side),
                     line.empty() ? fmt::format("line {}", d.line) : line);
}

const std::map<std::string, std::string>& unreached() {
  static const std::map<std::string, std::string> all =
      scene::unexercised(detail::embedded_text("unreached.toml"), "unreached.toml")["any"];
  return all;
}

PassCoverage summary(const Coverage& coverage, const std::map<std::string, std::string>& unexercised) {
  const auto decisions = coverage.decisions();
  const perturbed::Exercised e = exercised(decisions);
  PassCoverage out{e.taken, e.of, {}, {}};
  for (const auto& [decision, counts] : decisions)
    for (int side = 0; side < sides(decision.kind); ++side) {
      if (counts[static_cast<std::size_t>(side)] > 0) continue;
      const std::string text = alternative(decision, side);
      const auto own = unexercised.find(text), always = unreached().find(text);
      if (own != unexercised.end())
        out.reasons.insert(*own);
      else if (always != unreached().end())
        out.reasons.insert(*always);
      else
        out.never.push_back(text);
    }
  return out;
}

}  // namespace rainref::judge
