#include "judge/sampled_votes.h"

#include <algorithm>
#include <array>
#include <memory>

#include "judge/invocation_judge.h"
#include "judge/reference_bits.h"
#include "judge/sample.h"
#include "judge/slots.h"

namespace rainref::judge {
namespace {

constexpr std::size_t most_runs = 4;
constexpr std::int64_t of_run = 128;

/// For one run: invocations that fail under each rounding, and that have the reference's bits under it.
struct Counts {
  std::array<std::int64_t, 2> failing{}, with_bits{};

  bool is_wrong() const { return failing[0] > 0 && failing[1] > 0; }
  /// True if so many fail under only one rounding that the rest is not needed.
  bool tells() const {
    constexpr std::int64_t enough = 32;
    return (failing[0] == 0 && failing[1] >= enough) || (failing[1] == 0 && failing[0] >= enough);
  }
};

void ask(const PortRun& run, const capture::PassModel& model, const std::vector<HalfMode>& modes, const JudgeOptions& options,
         Counts& counts) {
  const std::vector<Slot> slots = slots_of(run.c, model);
  const ReferenceBits bits(run.c, model, run.stored, slots, modes);
  const std::array<InvocationJudge, 2> judges{InvocationJudge(run.c, model, *options.profile, modes[0], false),
                                              InvocationJudge(run.c, model, *options.profile, modes[1], false)};
  const Sample sample(run.c, model, of_run);
  sample.each(std::max<std::int64_t>(1, sample.size() / of_run), [&](int x, int y) {
    if (counts.is_wrong() || counts.tells()) return;
    const std::array<bool, 2> is_held = bits.stores(x, y);
    for (std::size_t m = 0; m < 2; ++m) {
      counts.with_bits[m] += is_held[m];
      counts.failing[m] += !is_held[m] && judges[m].accepts(x, y, run.stored, &run.kept) == Accepted::no;
    }
  });
}

}  // namespace

HalfVotes sampled_votes(PassTask task, const JudgeOptions& options) {
  task.runs.settle = nullptr;
  HalfVotes votes{task.pass->name, {}, {}};
  Counts counts;
  const std::size_t runs = std::min(task.runs.count, most_runs);
  for (std::size_t k = 0; k < runs && !counts.is_wrong() && !counts.tells(); ++k) {
    PortRun run = task.runs.load(k * task.runs.count / runs);
    if (!run.untested.empty()) continue;
    const std::unique_ptr<capture::PassModel> model = prepare(task, run);
    if (!run.untested.empty()) continue;
    const std::vector<HalfMode> modes = modes_of(run.c, options);
    if (!model || model->rounds_inside() || modes.size() < 2) return votes;
    votes.modes = modes;
    ask(run, *model, modes, options, counts);
  }
  if (votes.modes.empty()) return votes;
  if (counts.is_wrong()) counts = {{1, 1}, {}};  // a pass that fails under both tells nothing about stores
  votes.failing = {counts.failing[0], counts.failing[1]};
  votes.with_bits = {counts.with_bits[0], counts.with_bits[1]};
  votes.failing.resize(votes.modes.size(), 0);
  votes.with_bits.resize(votes.modes.size(), 0);
  return votes;
}

}  // namespace rainref::judge
