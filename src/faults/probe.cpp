#include "faults/probe.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "faults/members.h"
#include "faults/targets.h"
#include "faults/text.h"
#include "judge/rearrange.h"
#include "rainref/error.h"

namespace rainref::faults {
namespace {

using capture::Array;
using capture::CaseInput;
using capture::PassCase;
using perturbed::Op;
using perturbed::Trace;
using Node = Trace::Node;

/// Evaluates a texel, or a whole list.
struct Evaluation {
  Texel at;
  std::string list;  ///< "": the texel

  std::vector<std::int32_t> run(const capture::PassModel& model) const {
    std::vector<std::int32_t> nodes;
    if (const capture::KeyedModel* keyed = list.empty() ? nullptr : model.keyed(list)) {
      static_cast<void>(keyed->perturbed());
      return nodes;
    }
    std::vector<perturbed::Perturbed> given(static_cast<std::size_t>(model.values()));
    model.evaluate(at.x, at.y, given.data());
    for (const perturbed::Perturbed& v : given) nodes.push_back(v.node());
    return nodes;
  }
};
Trace traced(const capture::PassModel& model, const Evaluation& evaluation, const std::vector<float>& known,
             std::vector<std::int32_t>* outputs = nullptr) {
  Trace trace;
  perturbed::Behaviour following;
  following.trace = &trace;
  following.known = &known;
  const perturbed::Scope scope(following);
  std::vector<std::int32_t> nodes = evaluation.run(model);
  // For a list of one record, its input.
  if (!evaluation.list.empty())
    for (std::size_t at = 0; at < trace.nodes.size(); ++at)
      if (trace.nodes[at].op == Op::stored) nodes.push_back(static_cast<std::int32_t>(at));
  constexpr std::size_t most_slots = 16;
  if (nodes.size() > most_slots) nodes.clear();
  if (outputs) *outputs = std::move(nodes);
  return trace;
}

/// A case with one value changed by about its last bit.
struct Touched {
  std::string name;
  bool is_input;               ///< an image: texels change, constants do not
  std::optional<float> value;  ///< of a uniform: it is not a texel
  std::function<void(PassCase&)> alter;
};

void touch_float(std::byte* at) {
  const auto value = number_at<float>(at, 0);
  put_number(at, 0, value == 0 ? 0x1p-20f : value * (1 + 0x1p-18f));
}
void add_uniforms(std::vector<Touched>& out, const capture::PackPass& pass, const PassCase& c) {
  for (const Part& part : float_parts(pass.block))
    out.push_back({part.name, false, number_at<float>(c.uniforms.data(), part.offset),
                   [at = part.offset](PassCase& altered) { touch_float(altered.uniforms.data() + at); }});
}
void add_inputs(std::vector<Touched>& out, const PassCase& c) {
  for (std::size_t i = 0; i < c.inputs.size(); ++i) {
    const Array& a = c.inputs[i].array;
    if (a.is_records) {
      for (const scene::Member& m : a.record.members)
        for (int k = 0; m.scalar == scene::Scalar::float32 && k < m.components; ++k)
          out.push_back({fmt::format("{} of {}", part_name(m, k), c.inputs[i].name), false, std::nullopt,
                         [i, at = offset_of(m, k), size = a.record.size](PassCase& altered) {
                           std::vector<std::byte>& records = altered.inputs[i].array.levels[0].edit();
                           for (std::size_t r = 0; r + size <= records.size(); r += size) touch_float(records.data() + r + at);
                         }});
      continue;
    }
    const FormatInfo& f = info(a.format);
    for (int k = 0; k < f.channels; ++k) {
      const int byte = k * f.channel_bytes;  // little endian: the lowest byte
      out.push_back({f.channels == 1 ? c.inputs[i].name : c.inputs[i].name + "." + component_name(k), true, std::nullopt,
                     [i, byte](PassCase& altered) {
                       judge::each_texel(altered.inputs[i].array, [byte](std::byte* t) { t[byte] ^= std::byte{1}; });
                     }});
    }
  }
}

/// Names the leaves that a change affects. If the position of a lookup moves, its texel changes by more than its last bit, so the smallest
/// change over all cases identifies the input.
void name_changed(Probe& probe, std::vector<double>& least, const Trace& changed, const Touched& touched, bool is_list) {
  // If the invocation takes another path through the pass, later nodes do not correspond; the records before do.
  const std::size_t most = std::min(probe.trace.nodes.size(), changed.nodes.size());
  std::size_t alike = 0;
  while (alike < most && probe.trace.nodes[alike].op == changed.nodes[alike].op) ++alike;
  if (!is_list && (alike < most || probe.trace.nodes.size() != changed.nodes.size())) return;
  for (std::size_t n = 0; n < alike; ++n) {
    const Node &a = probe.trace.nodes[n], &b = changed.nodes[n];
    const bool is_texel = a.op == Op::load || a.op == Op::fetch;
    if (!is_leaf(a.op) || (is_texel ? touched.value.has_value() : touched.is_input)) continue;
    const double by = std::abs(static_cast<double>(b.value) - a.value);
    if (!(by > 0)) continue;
    // If a member of a record changes by more than its last bits, it belongs to another record: the order changed.
    const bool is_of_record = !touched.is_input && !touched.value;
    if (is_of_record && by > 0x1p-16 * std::abs(static_cast<double>(a.value)) + 0x1p-19) continue;
    std::string& name = probe.names[n];
    if (!touched.is_input && !name.empty()) {
      // A function of several numbers is named after all of them, from the second on.
      name = made_of_too(name, touched.name);
      continue;
    }
    if (by >= least[n]) continue;
    least[n] = by;
    // A value computed before the pass's arithmetic begins, such as 1 / ior, is not the number itself.
    const bool falls = (b.value < a.value) == (a.value > 0);
    const bool is_itself = touched.is_input || (touched.value ? a.value == *touched.value : !falls);
    const bool is_inverse = touched.value ? a.value == 1 / *touched.value : falls;
    name = is_itself                                     ? touched.name
           : is_inverse                                  ? "1 / " + touched.name
           : touched.value && a.value == -*touched.value ? "-" + touched.name
                                                         : "f(" + touched.name + ")";
  }
}

}  // namespace

std::vector<Texel> failing_texels(const judge::CaseJudgement& j) {
  std::vector<Texel> all;
  for (const judge::OutputJudgement& o : j.outputs)
    for (std::size_t i = 0; i < o.map.size(); ++i)
      if (o.map[i] == 3) all.push_back({static_cast<int>(i) % o.width, static_cast<int>(i) / o.width});
  std::sort(all.begin(), all.end(), [](Texel a, Texel b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
  all.erase(std::unique(all.begin(), all.end(), [](Texel a, Texel b) { return a.x == b.x && a.y == b.y; }), all.end());
  return all;
}
std::vector<Texel> spread(const std::vector<Texel>& all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<Texel> some;
  for (std::size_t k = 0; k < most; ++k) some.push_back(all[k * all.size() / most]);
  return some;
}

Trace trace_of(const capture::PassModel& model, Texel at) {
  Trace trace;
  perturbed::Behaviour following;
  following.trace = &trace;
  const perturbed::Scope scope(following);
  std::vector<perturbed::Perturbed> unused(static_cast<std::size_t>(model.values()));
  model.evaluate(at.x, at.y, unused.data());
  return trace;
}
std::vector<int> uses_of(const Trace& trace) {
  std::vector<int> out(trace.nodes.size());
  for (const Node& n : trace.nodes)
    for (const std::int32_t of : n.of)
      if (of >= 0) ++out[static_cast<std::size_t>(of)];
  return out;
}

std::map<float, int> constants_met(const capture::PassModel& model) {
  constexpr int probes = 8;
  std::map<float, int> places;
  if (model.width() == 0) return places;
  std::vector<float> met;
  perturbed::Behaviour collecting;
  collecting.constants = &met;
  const perturbed::Scope scope(collecting);
  std::vector<perturbed::Perturbed> unused(static_cast<std::size_t>(model.values()));
  for (int j = 0; j < probes; ++j)
    for (int i = 0; i < probes; ++i) {
      met.clear();
      model.evaluate(i * (model.width() - 1) / (probes - 1), j * (model.height() - 1) / (probes - 1), unused.data());
      for (const float v : std::set<float>(met.begin(), met.end())) ++places[v];
    }
  return places;
}
std::vector<float> constants_everywhere(const capture::PassModel& model) {
  constexpr int of_two_rows = 16;  // a value of one row is used by one row of eight
  std::vector<float> out;
  for (const auto& [value, count] : constants_met(model))
    if (count > of_two_rows && value > -1e30f && value < 1e30f) out.push_back(value);
  return out;
}

namespace {

std::vector<Probe> probed(const Probed& p, const std::vector<Evaluation>& evaluations, const std::vector<float>& known) {
  std::vector<Probe> probes;
  std::vector<std::vector<double>> least;
  for (const Evaluation& e : evaluations) {
    Probe& probe = probes.emplace_back(Probe{e.at, {}, {}});
    probe.trace = traced(p.model, e, known, &probe.outputs);
    probe.names.resize(probe.trace.nodes.size());
    least.emplace_back(probe.trace.nodes.size(), HUGE_VAL);
  }
  std::vector<Touched> touched;
  add_uniforms(touched, p.pass, p.c);
  add_inputs(touched, p.c);
  for (const Touched& t : touched) {
    PassCase c = p.c;
    t.alter(c);
    try {
      const std::unique_ptr<capture::PassModel> model = p.bind(c);
      if (model->width() != p.model.width() || model->height() != p.model.height() || model->values() != p.model.values()) continue;
      for (std::size_t k = 0; k < probes.size(); ++k)
        name_changed(probes[k], least[k], traced(*model, evaluations[k], known), t, !evaluations[k].list.empty());
    } catch (const Error&) {
      // a bit outside its range: no name
    }
  }
  for (Probe& probe : probes)
    for (std::size_t n = 0; n < probe.names.size(); ++n) {
      const Node& node = probe.trace.nodes[n];
      if (!is_leaf(node.op) || !probe.names[n].empty()) continue;
      const bool is_row = node.op == Op::constant && probe.at.y > 0 &&
                          (node.value == static_cast<float>(probe.at.y) + 0.5f || node.value == static_cast<float>(probe.at.y)) &&
                          !std::binary_search(known.begin(), known.end(), node.value);
      probe.names[n] = is_row                    ? "row"
                       : node.op == Op::constant ? fmt::format("{}", node.value)
                       : node.op == Op::index    ? "column"
                                                 : "a texel";
    }
  return probes;
}

}  // namespace

std::vector<Probe> probes_of(const Probed& p, const std::vector<Texel>& texels, const std::vector<float>& known) {
  std::vector<Evaluation> evaluations;
  for (const Texel at : texels) evaluations.push_back({at, ""});
  return probed(p, evaluations, known);
}
std::vector<Probe> probes_of_list(const Probed& p, const std::string& list, const std::vector<float>& known) {
  return probed(p, {{{-1, -1}, list}}, known);
}

std::vector<Probe> probes_again(const capture::PassModel& model, const std::vector<Probe>& probes, const std::vector<float>& known,
                                const std::string& list) {
  std::vector<Probe> out;
  for (const Probe& p : probes) {
    Probe again{p.at, {}, p.names};
    again.trace = traced(model, {p.at, list}, known, &again.outputs);
    if (again.trace.nodes.size() == p.trace.nodes.size()) out.push_back(std::move(again));
  }
  return out;
}

Constants names_of_constants(const std::vector<Probe>& probes, const std::vector<float>& known) {
  std::map<float, std::set<std::string>> all;
  for (const Probe& probe : probes)
    for (std::size_t n = 0; n < probe.names.size(); ++n) {
      const Node& node = probe.trace.nodes[n];
      if (node.op != Op::constant || !std::binary_search(known.begin(), known.end(), node.value)) continue;
      if (!is_of_list(probe.names[n])) all[node.value].insert(probe.names[n]);
    }
  Constants out;
  for (const auto& [value, names] : all) {
    const std::string literal = fmt::format("{}", value), &first = *names.begin();
    Constant& c = out.emplace_back(Constant{value, "", names.contains(literal), first == literal, is_made(first), first_word(first)});
    for (const std::string& name : names) c.name += (c.name.empty() ? "" : " or ") + (name == literal ? "the literal " + name : name);
    if (c.begins_as_literal) c.head = "the";
  }
  return out;
}

std::set<std::string> uniforms_met(const std::vector<Probe>& probes, const capture::PackPass& pass) {
  std::set<std::string> out;
  for (const Probe& probe : probes)
    for (const std::string& name : probe.names)
      for (const scene::Member& m : pass.block.members)
        if (names_member(name, m.name)) out.insert(m.name);
  return out;
}

}  // namespace rainref::faults
