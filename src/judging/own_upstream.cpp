#include "judging/own_upstream.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/path_text.h"
#include "judge/fused.h"
#include "judge/judge.h"
#include "judge/reference_outputs.h"
#include "rainref/error.h"

namespace rainref::judging {
namespace {

using capture::Array, capture::PassCase;
using judge::CaseJudgement, judge::FailedRun;

constexpr std::uint8_t outside = 3, not_judged = judge::OutputJudgement::not_judged;  // OutputJudgement::map

/// An input of the run with the values that the port gave for it.
struct OwnInput {
  std::size_t index;
  std::string name, from;
  Array array;
};

std::vector<OwnInput> own_inputs(const FailedRun& failed, const capture::Pack& pack, judge::PortFiles& port) {
  std::vector<OwnInput> found;
  const PassCase& c = failed.run.c;
  for (const capture::PackEdge& edge : pack.edges) {
    if (edge.pass != c.pass || edge.from == "host" || edge.from == c.pass || edge.previous) continue;
    const auto input = std::find_if(c.inputs.begin(), c.inputs.end(), [&](const auto& i) { return i.name == edge.input; });
    const capture::PackCase* source = input == c.inputs.end() ? nullptr : judge::source_of(pack, c.folder(), edge.from);
    if (!source) continue;
    try {
      Array own = port.read(utf8_path(source->id), "out." + edge.input, input->array);
      const bool differs = own.width != input->array.width ||
                           !std::equal(own.levels.begin(), own.levels.end(), input->array.levels.begin(), input->array.levels.end());
      if (differs) found.push_back({static_cast<std::size_t>(input - c.inputs.begin()), edge.input, edge.from, std::move(own)});
    } catch (const Error&) {
      // No dump of it, or none that can be used: then it explains nothing.
    }
  }
  return found;
}

bool map_has(const CaseJudgement& j, std::size_t texel, std::uint8_t verdict) {
  return std::any_of(j.outputs.begin(), j.outputs.end(),
                     [&](const judge::OutputJudgement& o) { return texel < o.map.size() && o.map[texel] == verdict; });
}
bool has_bits(const std::vector<Array>& a, const std::vector<Array>& b, std::size_t texel) {
  for (std::size_t o = 0; o < a.size(); ++o) {
    const std::size_t bytes = a[o].element_bytes();
    if ((texel + 1) * bytes > a[o].levels[0].size() || (texel + 1) * bytes > b[o].levels[0].size()) return false;
    if (std::memcmp(a[o].levels[0].data() + texel * bytes, b[o].levels[0].data() + texel * bytes, bytes) != 0) return false;
  }
  return true;
}

/// Judges the run with other inputs, and counts what they explain of the failing texels.
void judge_with(const FailedRun& failed, PassCase& c, judge::Cause& cause) {
  const auto model = failed.bind(c);
  const std::vector<Array> expected = judge::reference_outputs(c, *model, *failed.options.executor, failed.half_mode);
  for (std::size_t o = 0; o < c.outputs.size(); ++o) c.outputs[o].array = expected[o];
  judge::JudgeOptions options = failed.options;
  options.half_mode = failed.half_mode;
  options.typical = nullptr;
  options.kept = &failed.run.kept;
  const judge::ModeJudgements judged = judge::judge_case(c, model.get(), failed.run.stored, options);
  const CaseJudgement& now = judged.judgements.front();
  const auto texels = static_cast<std::size_t>(model->width()) * static_cast<std::size_t>(model->height());
  for (std::size_t texel = 0; texel < texels; ++texel) {
    if (!map_has(failed.judgement, texel, outside) || map_has(now, texel, not_judged)) continue;
    ++cause.of;
    cause.inside += !map_has(now, texel, outside);
    cause.explained += has_bits(failed.run.stored, expected, texel);
  }
  cause.is_likely = cause.of > 0 && 10 * cause.inside >= 9 * cause.of;
}

/// The failing texels that the run explains with these inputs.
judge::Cause judged_with(const FailedRun& failed, const std::vector<const OwnInput*>& inputs) {
  PassCase c = failed.run.c;
  std::vector<std::string> names, passes;
  for (const OwnInput* input : inputs) {
    c.inputs[input->index].array = input->array;
    names.push_back(input->name);
    if (std::find(passes.begin(), passes.end(), input->from) == passes.end()) passes.push_back(input->from);
  }
  judge::Cause cause{
      fmt::format("made from the port's own {}", fmt::join(names, ", ")),
      fmt::format("what the port gave for {} went in, not what the pack gives: a shader that computes {} itself reads the pack's "
                  "here, or is judged as a whole",
                  fmt::join(names, ", "), fmt::join(passes, ", "))};
  judge_with(failed, c, cause);
  return cause;
}

}  // namespace

std::optional<judge::Cause> made_from_own(const FailedRun& failed, const capture::Pack& pack, judge::PortFiles& port) {
  if (!failed.bind || !failed.model || failed.model->width() == 0) return std::nullopt;
  const std::vector<OwnInput> inputs = own_inputs(failed, pack, port);
  std::vector<std::vector<const OwnInput*>> tried;
  for (const OwnInput& input : inputs) tried.push_back({&input});
  if (inputs.size() > 1) {
    tried.emplace_back();
    for (const OwnInput& input : inputs) tried.back().push_back(&input);
  }
  std::optional<judge::Cause> best;
  for (const auto& some : tried) {
    judge::Cause cause = judged_with(failed, some);
    if (2 * cause.inside < cause.of || cause.of == 0 || (best && cause.inside <= best->inside)) continue;
    best = std::move(cause);
  }
  return best;
}

std::optional<judge::Cause> computes_itself(const FailedRun& failed, const capture::Pack& pack) {
  if (!failed.bind || !failed.model || failed.model->width() == 0) return std::nullopt;
  const PassCase& c = failed.run.c;
  const auto entry = std::find_if(pack.cases.begin(), pack.cases.end(), [&](const auto& e) { return e.id == c.folder(); });
  if (entry == pack.cases.end()) return std::nullopt;
  const auto is_free = [](const capture::PackOutput& o) { return o.rules.judge == capture::Judge::input_only; };
  for (const capture::PackEdge& edge : pack.edges) {
    const capture::PackCase* const source = edge.pass == c.pass && !edge.previous ? judge::source_of(pack, entry->id, edge.from) : nullptr;
    if (!source || !std::all_of(source->outputs.begin(), source->outputs.end(), is_free)) continue;
    const std::vector<judge::FusedPasses> both{{edge.from, c.pass}};
    PassCase widened = c;
    judge::Cause cause{
        fmt::format("computes {} itself", edge.input),
        fmt::format("the shader seems to compute {} itself and not to read the pack's: with --fused {}+{} both are judged as one",
                    edge.input, edge.from, c.pass)};
    try {
      judge::FusedInputs(pack, both, *failed.options.profile, *failed.options.executor).widen(*entry, widened);
      judge_with(failed, widened, cause);
    } catch (const Error&) {
      continue;  // the pass reads it elsewhere, so that nothing is known
    }
    if (cause.is_likely) return cause;
  }
  return std::nullopt;
}

}  // namespace rainref::judging
