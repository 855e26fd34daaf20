#include "judge/coverage.h"

#include <mutex>
#include <vector>

#include <fmt/format.h>

#include "math/perturbed.h"

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

PassCoverage summary(const Coverage& coverage) {
  const auto decisions = coverage.decisions();
  const perturbed::Exercised e = exercised(decisions);
  PassCoverage out{e.taken, e.of, {}};
  for (const auto& [decision, counts] : decisions)
    for (int side = 0; side < sides(decision.kind); ++side)
      if (counts[static_cast<std::size_t>(side)] == 0)
        out.never.push_back(decision.line == 0 ? fmt::format("a lookup by {}: {}", decision.file, side_name(decision.kind, side))
                                               : fmt::format("{}:{} {}: {}", decision.file, decision.line, name(decision.kind),
                                                             side_name(decision.kind, side)));
  return out;
}

}  // namespace rainref::judge
