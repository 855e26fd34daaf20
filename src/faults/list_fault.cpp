// Splits lists into records and joins them, and applies a mistake to a list.
#include <algorithm>
#include <cstring>
#include <map>

#include "faults/list_faults.h"
#include "faults/members.h"
#include "judge/keyed.h"

namespace rainref::faults {

using capture::Array;
using capture::PassCase;
using judge::keyed_outputs;
using scene::Member;

namespace {

/// Longer lists are not tried with other inputs or uniforms: a radius that is too large makes one group of all.
constexpr int most_for_altered_cases = 4096;

}  // namespace

List::List(const PassCase& c, std::size_t o) : output(o), name(c.outputs[o].name), layout(c.outputs[o].array.record) {
  for (const Member& m : layout.members) {
    if (m.name == "id")
      id = m.offset;
    else if (!is_padding(m))
      fields.push_back(m);
  }
}

std::map<std::uint32_t, std::vector<std::byte>> List::taken(const PassCase& c) const {
  std::map<std::uint32_t, std::vector<std::byte>> out;
  const capture::CaseInput* in = c.input(name);
  if (!in || !in->array.is_records || in->array.record.size != layout.size) return out;
  for (std::vector<std::byte>& r : records_of(in->array)) out.emplace(id_of(r), std::move(r));
  return out;
}

std::size_t List::place(const Records& records, std::uint32_t of) const {
  return static_cast<std::size_t>(std::find_if(records.begin(), records.end(), [&](const auto& r) { return id_of(r) == of; }) -
                                  records.begin());
}

Fault& ListAdder::add(Kind kind, Alter alter, std::vector<std::string> more) {
  more.insert(more.begin(), list_.name);
  Fault& d = out_.emplace_back(What{kind, std::move(more)}, false);
  d.list_output = static_cast<int>(list_.output);
  d.alter_list = [list = list_, alter](const PassCase& c, ListEdit& e) { return alter(list, c, e); };
  return d;
}

Records records_of(const Array& list) {
  const std::size_t size = list.record.size;
  Records out;
  for (auto at = list.levels[0].begin(); at != list.levels[0].end(); at += static_cast<std::ptrdiff_t>(size))
    out.emplace_back(at, at + static_cast<std::ptrdiff_t>(size));
  return out;
}
Array array_of(const Records& records, const Array& like) {
  Array out = like;
  out.width = static_cast<int>(records.size());
  std::vector<std::byte> all;
  for (const auto& r : records) all.insert(all.end(), r.begin(), r.end());
  out.levels = {std::move(all)};
  return out;
}
std::uint32_t id_of(const std::vector<std::byte>& record, const scene::UniformBlock& layout) {
  const auto key = std::find_if(layout.members.begin(), layout.members.end(), [](const scene::Member& m) { return m.name == "id"; });
  std::uint32_t id;
  std::memcpy(&id, &record[key->offset], sizeof id);
  return id;
}

std::vector<float> constants_of_lists(const capture::PassModel& model, const PassCase& c) {
  std::vector<float> out;
  for (const std::size_t o : keyed_outputs(c)) {
    const capture::KeyedModel* keyed = model.keyed(c.outputs[o].name);
    if (!keyed) continue;
    std::vector<float> met;
    perturbed::Behaviour collecting;
    collecting.constants = &met;
    const perturbed::Scope scope(collecting);
    if (!keyed->perturbed()) continue;
    std::map<float, int> counts;
    for (const float v : met) ++counts[v];
    for (const auto& [v, count] : counts)
      if (2 * count >= c.outputs[o].array.width) out.push_back(v);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::optional<std::vector<std::byte>> evaluated(const Fault& d, const capture::KeyedModel& keyed, perturbed::Trace* trace) {
  perturbed::Behaviour behaviour = d.behaviour;
  std::vector<float> unused;
  if (d.at_texel) d.at_texel({-1, -1}, behaviour, unused);
  perturbed::Trace own;
  if (trace || d.rewrites) behaviour.trace = trace ? trace : &own;
  perturbed::Substitutions substitutions{d.substitutions};
  if (!substitutions.all.empty()) behaviour.substitutions = &substitutions, substitutions.start();
  const perturbed::RewriteScope rewriting(d.rewrites.value_or(perturbed::Rewrites()));
  const perturbed::Scope scope(behaviour);
  substitutions.look_ahead([&] { static_cast<void>(keyed.perturbed()); });
  if (trace) *trace = {};
  return keyed.perturbed();
}

std::optional<Array> faulty_list(const Fault& d, const PassCase& c, std::size_t output, const capture::PassEvaluations& evaluations,
                                 const capture::PassModel* model, const Array& finished, const std::vector<std::uint32_t>& at,
                                 const Records* port) {
  if (d.alter_list) {
    if (d.list_output != static_cast<int>(output)) return std::nullopt;
    ListEdit edit{records_of(finished), at, port};
    if (!d.alter_list(c, edit)) return std::nullopt;
    return array_of(edit.records, finished);
  }
  if (d.alter_outputs || d.stores) return std::nullopt;
  if (d.draws) {
    if (evaluations.bind || !evaluations.recompute) return std::nullopt;
    const random::DrawsScope scope(*d.draws);
    return evaluations.recompute(c)[output];
  }
  PassCase altered;
  std::unique_ptr<capture::PassModel> altered_model;
  if (d.alter_case) {
    if (finished.width > most_for_altered_cases) return std::nullopt;
    altered = c;
    d.alter_case(altered);
    if (!evaluations.bind) {
      if (!evaluations.recompute) return std::nullopt;
      return evaluations.recompute(altered)[output];
    }
    altered_model = evaluations.bind(altered);
    model = altered_model.get();
  }
  const capture::KeyedModel* keyed = model ? model->keyed(c.outputs[output].name) : nullptr;
  if (!keyed) return std::nullopt;
  const auto bytes = evaluated(d, *keyed);
  if (!bytes) return std::nullopt;
  Array out = finished;
  out.width = static_cast<int>(bytes->size() / finished.record.size);
  out.levels = {*bytes};
  return out;
}

}  // namespace rainref::faults
