#include "faults/order_faults.h"

#include <memory>
#include <set>
#include <tuple>

#include <fmt/format.h>

namespace rainref::faults {
namespace {

using perturbed::Op;
using perturbed::Rewrite;
using perturbed::RewriteKind;
using Node = perturbed::Trace::Node;

constexpr std::size_t most = 600;

std::string words(const Probe& p, std::int32_t node) {
  for (int depth = 3; depth > 0; --depth)
    if (const std::string text = p.text(node, depth); text.size() <= 60) return text;
  return p.text(node, 1).substr(0, 77);
}

class Adder {
 public:
  Adder(std::vector<Fault>& out, const std::vector<float>& known) : out_(out), known_(std::make_shared<const std::vector<float>>(known)) {}
  void operator()(const Rewrite& r, std::string name, std::string sentence) {
    if (made_ >= most || !done_.insert({r.kind, r.shape, r.occurrence, r.operand, r.path}).second) return;
    ++made_;
    Fault d;
    d.name = std::move(name);
    d.sentence = std::move(sentence);
    d.rewrite = r;
    d.at_texel = [known = known_](Texel, perturbed::Behaviour& b, std::vector<float>&) { b.known = known.get(); };
    d.for_diagnosis = true;
    out_.push_back(std::move(d));
  }

 private:
  std::vector<Fault>& out_;
  std::shared_ptr<const std::vector<float>> known_;
  std::set<std::tuple<RewriteKind, std::uint32_t, std::int32_t, std::int8_t, std::array<std::int8_t, 2>>> done_;
  std::size_t made_ = 0;
};

/// A part of an operand where the whole is meant. Of one that has no other use a term that is left out says the same.
void add_parts(Adder& add, const Probe& p, std::size_t at, std::int8_t k, const std::vector<int>& uses) {
  const Node& n = p.trace.nodes[at];
  const std::int32_t whole = n.of[static_cast<std::size_t>(k)];
  const auto node = [&](std::int32_t i) -> const Node& { return p.trace.nodes[static_cast<std::size_t>(i)]; };
  const Op op = node(whole).op;
  const bool gathers = op == Op::sum || op == Op::difference || op == Op::mix || op == Op::minimum || op == Op::maximum ||
                       op == Op::choice || op == Op::floor || op == Op::fract;
  if (!gathers && uses[static_cast<std::size_t>(whole)] < 2) return;
  const auto one = [&](std::int32_t part, std::array<std::int8_t, 2> path) {
    if (part < 0 || node(part).op == Op::comparison) return;
    const Rewrite r{RewriteKind::part, n.shape, p.trace.met.at(n.shape) == 1 ? -1 : n.occurrence, k, path};
    const std::string wrong = words(p, part), right = words(p, whole);
    if (wrong == right || wrong == "...") return;
    add(r, fmt::format("value of before: {} for {}", wrong, right),
        fmt::format("in {} stands {} where {} is meant: the value of before a step", words(p, static_cast<std::int32_t>(at)), wrong,
                    right));
  };
  for (std::int8_t i = 0; i < 3; ++i) {
    const std::int32_t part = node(whole).of[static_cast<std::size_t>(i)];
    one(part, {i, -1});
    for (std::int8_t j = 0; part >= 0 && j < 3; ++j) one(node(part).of[static_cast<std::size_t>(j)], {i, j});
  }
}

void add_factors(Adder& add, const Probe& p, std::size_t at) {
  const Node& n = p.trace.nodes[at];
  const std::string all = words(p, static_cast<std::int32_t>(at));
  const std::int32_t occurrence = p.trace.met.at(n.shape) == 1 ? -1 : n.occurrence;
  for (std::int8_t k = 0; k < 2; ++k) {
    const std::int32_t of = n.of[static_cast<std::size_t>(k)];
    if (of < 0) continue;
    const Node& operand = p.trace.nodes[static_cast<std::size_t>(of)];
    if ((n.op == Op::sum || n.op == Op::difference) && operand.op == Op::product)
      for (std::int8_t f = 0; f < 2; ++f)
        add({RewriteKind::over_all, n.shape, occurrence, k, {f, -1}},
            "factor of the whole sum: " + words(p, operand.of[static_cast<std::size_t>(f)]),
            fmt::format("{} multiplies all of {}, after the sum, where it should multiply one term",
                        words(p, operand.of[static_cast<std::size_t>(f)]), all));
    if (n.op == Op::product && (operand.op == Op::sum || operand.op == Op::difference))
      for (const RewriteKind kind : {RewriteKind::over_first, RewriteKind::over_second})
        add({kind, n.shape, occurrence, k, {-1, -1}}, "factor of one term: " + words(p, n.of[static_cast<std::size_t>(1 - k)]),
            fmt::format("in {} the factor {} multiplies {} alone", all, words(p, n.of[static_cast<std::size_t>(1 - k)]),
                        words(p, operand.of[kind == RewriteKind::over_first ? 0 : 1])));
  }
}

}  // namespace

void add_order_faults(std::vector<Fault>& out, const std::vector<Probe>& probes, const std::vector<float>& known) {
  Adder add(out, known);
  for (const Probe& p : probes) {
    std::vector<int> uses(p.trace.nodes.size());
    for (const Node& n : p.trace.nodes)
      for (const std::int32_t of : n.of)
        if (of >= 0) ++uses[static_cast<std::size_t>(of)];
    for (std::size_t at = p.trace.nodes.size(); at-- > 0;) {
      const Node& n = p.trace.nodes[at];
      if (p.trace.met.at(n.shape) > 6) continue;
      add_factors(add, p, at);
      for (std::int8_t k = 0; k < 3; ++k)
        if (n.of[static_cast<std::size_t>(k)] >= 0) add_parts(add, p, at, k, uses);
    }
  }
}

}  // namespace rainref::faults
