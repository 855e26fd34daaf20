#include "judge/coverage.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <tuple>

#include <fmt/format.h>

#include "judge/sample.h"
#include "math/perturbed.h"
#include "registry/registry.h"

namespace rainref::judge {

using perturbed::Coverage;

namespace {

/// True if declared to be 0 or 1, so that it has no other values.
bool is_flag(const scene::Member& m) {
  return m.range && m.range->low == 0 && m.range->high == 1 && (m.scalar != scene::Scalar::float32 || m.range->is_whole);
}
/// For each uniform and image, records whether its value would reveal a mistake; for a flag, which value it has.
void add_values(const capture::PassCase& c, const scene::UniformBlock& said, Exercise& to) {
  std::map<std::string, bool>& out = to.values;
  const effect::Effect* own = registry::find(c.effect);
  const scene::UniformBlock& block = own ? own->info->pass(c.pass).block(c.variant) : said;
  for (const scene::Member& m : block.members) {
    if (!is_read_by(m, c.variant)) continue;
    for (int k = 0; k < m.components; ++k) {
      const double value = std::abs(scene::component_of(m, c.uniforms.data(), k));
      const std::string name = m.components == 1 ? m.name : fmt::format("{}.{}", m.name, "xyzw"[k]);
      if (is_flag(m)) {
        out[fmt::format("uniform {}: 0", name)] = value == 0;
        out[fmt::format("uniform {}: 1", name)] = value == 1;
      } else {
        const std::string alternative = fmt::format("uniform {}: neither 0 nor 1", name);
        out[alternative] = value != 0 && value != 1;
        if (!m.guard.empty() && m.guarded_component == k) to.guards[alternative] = m.guard;
      }
    }
  }
  for (const capture::CaseInput& in : c.inputs)
    if (!in.array.is_records) out[fmt::format("input {}: more than one texel", in.name)] = in.array.width > 1 || in.array.height > 1;
}

}  // namespace

void Exercise::add(const Exercise& other) {
  decisions.add(other.decisions);
  for (const auto& [alternative, is_taken] : other.values) values[alternative] |= is_taken;
  guards.insert(other.guards.begin(), other.guards.end());
  is_sampled |= other.is_sampled;
}

bool is_read_by(const scene::Member& member, std::string_view variant) {
  const std::string_view other = variant == "corrected" ? "as-published:" : "corrected:";
  return !member.sentence.starts_with(other) || member.sentence.find(fmt::format("{}:", variant)) != std::string::npos;
}

Exercise coverage_of(const capture::PassCase& c, const capture::PassModel* model, const parallel::Executor& executor, std::int64_t sample,
                     const scene::UniformBlock& said) {
  Exercise out;
  if (std::all_of(c.outputs.begin(), c.outputs.end(), [](const auto& o) { return o.judge == capture::Judge::input_only; })) return out;
  add_values(c, said, out);
  Coverage& all = out.decisions;
  if (!model) return out;
  std::mutex mutex;  // sums of counts are the same in any order
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
  const Sample counted_ones(c, *model, sample);
  out.is_sampled = !counted_ones.is_whole();
  executor.for_range(counted_ones.size(), 256, [&](std::int64_t begin, std::int64_t end) {
    counted([&] {
      std::vector<perturbed::Perturbed> unused(static_cast<std::size_t>(model->values()));
      counted_ones.each_of(begin, end, [&](int x, int y) { model->evaluate(x, y, unused.data()); });
    });
  });
  for (const capture::CaseOutput& o : c.outputs)
    if (const capture::KeyedModel* list = o.judge == capture::Judge::keyed ? model->keyed(o.name) : nullptr)
      counted([&] { static_cast<void>(list->perturbed()); });
  return out;
}

std::string name_of(const perturbed::Decision& d, int number, bool is_guard, int side) {
  if (d.kind == perturbed::DecisionKind::address || d.kind == perturbed::DecisionKind::load)
    return fmt::format("{} of {} by {}: {}", name(d.kind), d.input.empty() ? "an image" : d.input, d.file, side_name(d.kind, side));
  if (d.function.empty())
    return fmt::format("{}:{}: {}, {}", d.file.substr(d.file.rfind('/') + 1), d.line, name(d.kind), side_name(d.kind, side));
  return fmt::format("{}, {}: {}{}{}, {}", d.file.substr(d.file.rfind('/') + 1), d.function == "operator()" ? "a lambda" : d.function,
                     is_guard ? "guarded " : "", name(d.kind), number > 1 ? fmt::format(" {}", number) : "", side_name(d.kind, side));
}

std::vector<Alternative> Exercise::alternatives() const {
  std::vector<Alternative> out;
  std::map<std::tuple<std::string, std::string, perturbed::DecisionKind, bool>, int> numbers;  // last number of a kind in a function
  for (const auto& [decision, sides] : decisions.decisions()) {
    const bool is_guard = std::any_of(sides.reasons.begin(), sides.reasons.end(), [](std::string_view reason) { return !reason.empty(); });
    const int number = ++numbers[{decision.file, decision.function, decision.kind, is_guard}];
    for (int side = 0; side < perturbed::sides(decision.kind); ++side) {
      const auto k = static_cast<std::size_t>(side);
      out.push_back(
          {name_of(decision, number, is_guard, side), sides.counts[k] > 0, std::string(sides.reasons[k]), is_guard ? 0 : decision.line});
    }
  }
  for (const auto& [value, is_taken] : values) {
    const auto guard = guards.find(value);
    out.push_back({value, is_taken, guard == guards.end() ? "" : guard->second});
  }
  return out;
}

PassCoverage summary(const Exercise& exercise, const std::map<std::string, std::string>& unexercised) {
  PassCoverage out;
  out.is_sampled = exercise.is_sampled;
  for (const Alternative& a : exercise.alternatives()) {
    ++out.alternatives;
    out.taken += a.is_taken;
    if (a.is_taken) continue;
    const auto own = unexercised.find(a.name);
    if (own != unexercised.end())
      out.reasons.insert(*own);
    else if (!a.guard.empty())
      out.reasons.emplace(a.name, a.guard);
    else
      out.never.push_back(a.name);
  }
  return out;
}

}  // namespace rainref::judge
