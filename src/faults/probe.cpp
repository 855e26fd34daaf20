#include "faults/probe.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "faults/operation_names.h"
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

bool is_leaf(Op op) { return op == Op::constant || op == Op::load || op == Op::fetch || op == Op::index; }

/// What is probed of a model: a texel, or a whole list.
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
  // Of a list of one record what that is given.
  if (!evaluation.list.empty())
    for (std::size_t at = 0; at < trace.nodes.size(); ++at)
      if (trace.nodes[at].op == Op::stored) nodes.push_back(static_cast<std::int32_t>(at));
  constexpr std::size_t most_slots = 16;
  if (nodes.size() > most_slots) nodes.clear();
  if (outputs) *outputs = std::move(nodes);
  return trace;
}

/// A case with one thing changed by about its last bit.
struct Touched {
  std::string name;
  bool is_input;               ///< an image: texels change, constants do not
  std::optional<float> value;  ///< of a uniform: it is no texel
  std::function<void(PassCase&)> alter;
};

void touch_float(std::byte* at) {
  float value;
  std::memcpy(&value, at, 4);
  value = value == 0 ? 0x1p-20f : value * (1 + 0x1p-18f);
  std::memcpy(at, &value, 4);
}
void add_uniforms(std::vector<Touched>& out, const capture::PackPass& pass, const PassCase& c) {
  for (const scene::Member& m : pass.block.members) {
    if (m.scalar != scene::Scalar::float32 || m.name.starts_with("padding")) continue;
    for (int k = 0; k < m.components; ++k) {
      const std::size_t offset = m.offset + 4 * static_cast<std::size_t>(k);
      float value;
      std::memcpy(&value, c.uniforms.data() + offset, 4);
      out.push_back({m.components == 1 ? m.name : fmt::format("{}.{}", m.name, "xyzw"[k]), false, value,
                     [offset](PassCase& altered) { touch_float(altered.uniforms.data() + offset); }});
    }
  }
}
void add_inputs(std::vector<Touched>& out, const PassCase& c) {
  for (std::size_t i = 0; i < c.inputs.size(); ++i) {
    const Array& a = c.inputs[i].array;
    if (a.is_records) {
      for (const scene::Member& m : a.record.members)
        for (int k = 0; m.scalar == scene::Scalar::float32 && k < m.components; ++k) {
          const std::size_t offset = m.offset + 4 * static_cast<std::size_t>(k), size = a.record.size;
          const std::string part = m.components == 1 ? m.name : fmt::format("{}.{}", m.name, "xyzw"[k]);
          out.push_back({fmt::format("{} of {}", part, c.inputs[i].name), false, std::nullopt, [i, offset, size](PassCase& altered) {
                           std::vector<std::byte>& records = altered.inputs[i].array.levels[0];
                           for (std::size_t r = 0; r + size <= records.size(); r += size) touch_float(records.data() + r + offset);
                         }});
        }
      continue;
    }
    const FormatInfo& f = info(a.format);
    for (int k = 0; k < f.channels; ++k) {
      const int byte = k * f.channel_bytes;  // little endian: the lowest
      out.push_back({f.channels == 1 ? c.inputs[i].name : fmt::format("{}.{}", c.inputs[i].name, "xyzw"[k]), true, std::nullopt,
                     [i, byte](PassCase& altered) {
                       judge::each_texel(altered.inputs[i].array, [byte](std::byte* t) { t[byte] ^= std::byte{1}; });
                     }});
    }
  }
}

/// Names the leaves that differ under a change. A texel that is another because the place
/// of a lookup moved has changed by more than its last bit, so the smallest change of all says whose it is.
void name_changed(Probe& probe, std::vector<double>& least, const Trace& changed, const Touched& touched, bool is_list) {
  // Where it takes another way through the pass nothing stands beside its like; the records of before that do.
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
    // A member of a record that changed by more than its last bits is that of another record: they came in another order.
    const bool is_of_record = !touched.is_input && !touched.value;
    if (is_of_record && by > 0x1p-16 * std::abs(static_cast<double>(a.value)) + 0x1p-19) continue;
    std::string& name = probe.names[n];
    if (!touched.is_input && !name.empty()) {
      // Of several numbers: named after all of them, the second time and on.
      if (!name.starts_with("f(")) name = "f(" + name + ")";
      name.insert(name.size() - 1, ", " + touched.name);
      continue;
    }
    if (by >= least[n]) continue;
    least[n] = by;
    // What is computed of a number before the pass's arithmetic begins, 1 / ior, is not the number itself.
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

bool Probe::is_of_column(const perturbed::Trace::Node& n) const {
  const auto op = [&](std::int32_t i) { return i < 0 ? Op::lookup : trace.nodes[static_cast<std::size_t>(i)].op; };
  return op(n.of[0]) == Op::index && op(n.of[1]) == Op::constant && n.with[1] == 0.5f;
}
std::string Probe::text(std::int32_t node, int depth) const {
  if (node < 0) return "...";
  const Node& n = trace.nodes[static_cast<std::size_t>(node)];
  if (is_leaf(n.op)) return names[static_cast<std::size_t>(node)];
  if (n.op == Op::lookup) return text(n.of[2], depth);
  if (n.op == Op::level || n.op == Op::coordinate || n.op == Op::argument || n.op == Op::bent || n.op == Op::stored)
    return text(n.of[0], depth);
  if (depth == 0) return n.op == Op::sum && is_of_column(n) ? text(n.of[0], depth) + " + 0.5" : "...";
  // HLSL's int(): toward zero.
  if (n.op == Op::choice) {
    const auto below = [&](std::int32_t i, Op op) {
      return i >= 0 && trace.nodes[static_cast<std::size_t>(i)].op == op ? trace.nodes[static_cast<std::size_t>(i)].of[0] : -1;
    };
    const std::int32_t up = below(n.of[1], Op::floor);
    if (up >= 0 && below(below(below(n.of[0], Op::negation), Op::floor), Op::negation) == up)
      return fmt::format("trunc({})", text(up, depth - 1));
  }
  // One deeper with each choice too: the steps of a march choose between each other, and twice as many texts with each step.
  if (n.op == Op::choice) return fmt::format("{} or {}", text(n.of[0], depth - 1), text(n.of[1], depth - 1));
  if (n.op == Op::negation) return "-" + text(n.of[0], depth);
  // The pixel's centre is as deep as its row, which is one number.
  if (n.op == Op::sum && is_of_column(n)) return text(n.of[0], depth) + " + 0.5";
  if (const char* sign = sign_of(n.op); *sign) {
    const auto side = [&](std::int32_t of) {
      const Node* const below = of < 0 ? nullptr : &trace.nodes[static_cast<std::size_t>(of)];
      const bool is_compound = below && *sign_of(below->op) && (depth > 1 || is_of_column(*below));
      return is_compound ? fmt::format("({})", text(of, depth - 1)) : text(of, depth - 1);
    };
    return side(n.of[0]) + sign + side(n.of[1]);
  }
  std::string out = function_of(n.op);
  if (out.empty()) return "...";
  out += "(";
  for (std::size_t k = 0; k < n.of.size() && n.of[k] >= 0; ++k) out += (k == 0 ? "" : ", ") + text(n.of[k], depth - 1);
  return out + ")";
}

std::vector<float> constants_everywhere(const capture::PassModel& model) {
  if (model.width() == 0) return {};
  constexpr int probes = 8;
  std::map<float, int> places;
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
  std::vector<float> out;
  for (const auto& [value, count] : places)
    if (count > probes * 2 && value > -1e30f && value < 1e30f) out.push_back(value);  // a row's own is met by one row of eight
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
      // out of its range by a bit: it stays without a name
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
      if (probe.names[n].find(" of ") == std::string::npos) all[node.value].insert(probe.names[n]);
    }
  Constants out;
  for (const auto& [value, names] : all) {
    std::string text;
    bool is_literal = false;
    for (const std::string& name : names) {
      const bool is_number = name == fmt::format("{}", value);
      is_literal |= is_number;
      text += (text.empty() ? "" : " or ") + (is_number ? "the literal " + name : name);
    }
    out.push_back({value, text, is_literal});
  }
  return out;
}

std::set<std::string> uniforms_met(const std::vector<Probe>& probes, const capture::PackPass& pass) {
  std::set<std::string> out;
  for (const Probe& probe : probes)
    for (const std::string& name : probe.names)
      for (const scene::Member& m : pass.block.members)
        if (const std::size_t at = name.find(m.name); at != std::string::npos) {
          const std::size_t end = at + m.name.size();
          if (end == name.size() || name[end] == '.' || name[end] == ')') out.insert(m.name);
        }
  return out;
}

}  // namespace rainref::faults
