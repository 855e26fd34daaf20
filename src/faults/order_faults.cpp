#include "faults/order_faults.h"

#include <algorithm>
#include <memory>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "faults/place_faults.h"

#include "faults/targets.h"

namespace rainref::faults {
namespace {

using perturbed::Op;
using perturbed::Rewrite;
using perturbed::RewriteKind;
using perturbed::Rewrites;
using Node = perturbed::Trace::Node;

constexpr std::int32_t most_places = 6;  // of one shape that are tried one by one

/// Where a mistake is made: at a node, at each of its shape, or in each component of a vector.
struct Site {
  std::vector<std::size_t> nodes;  ///< the first one gives the words
  std::int32_t occurrence;         ///< -1: each of these shapes
};

class Adder {
 public:
  Adder(std::vector<Fault>& out, const std::vector<float>& known, std::size_t most)
      : out_(out), known_(std::make_shared<const std::vector<float>>(known)), most_(most) {}
  void operator()(const Probe& p, const Site& site, Rewrite r, std::string name, std::string sentence) {
    Rewrites all{};
    std::uint32_t key = 0;
    for (std::size_t k = 0; k < site.nodes.size(); ++k) {
      all[k] = r;
      all[k].shape = r.kind == RewriteKind::first_wins ? 0 : p.trace.nodes[site.nodes[k]].shape;
      all[k].occurrence = site.occurrence;
      key = key * 5 ^ all[k].shape;
    }
    if (made_ >= most_ || !done_.insert({r.kind, key, site.occurrence, r.operand, r.path}).second) return;
    ++made_;
    Fault d;
    d.name = std::move(name);
    d.sentence = std::move(sentence);
    if (site.nodes.size() > 1) d.name += ", in all components", d.sentence += ", and so in the other components";
    d.rewrites = all;
    d.at_texel = [known = known_](Texel, perturbed::Behaviour& b, std::vector<float>&) { b.known = known.get(); };
    d.for_diagnosis = true;
    out_.push_back(std::move(d));
  }

 private:
  std::vector<Fault>& out_;
  std::shared_ptr<const std::vector<float>> known_;
  std::set<std::tuple<RewriteKind, std::uint32_t, std::int32_t, std::int8_t, std::array<std::int8_t, 2>>> done_;
  std::size_t made_ = 0, most_;
};

/// A part of an operand where the whole is meant. Of one that has no other use a term that is left out says the same.
void add_parts(Adder& add, const Probe& p, const Site& site, std::int8_t k, const std::vector<int>& uses) {
  const auto at = static_cast<std::int32_t>(site.nodes[0]);
  const std::int32_t whole = node_of(p, at).of[static_cast<std::size_t>(k)];
  const Op op = node_of(p, whole).op;
  const bool gathers = op == Op::sum || op == Op::difference || op == Op::mix || op == Op::minimum || op == Op::maximum ||
                       op == Op::choice || op == Op::floor || op == Op::fract;
  if (!gathers && uses[static_cast<std::size_t>(whole)] < 2) return;
  const auto one = [&](std::int32_t part, std::array<std::int8_t, 2> path) {
    if (part < 0 || node_of(p, part).op == Op::comparison) return;
    const std::string wrong = words_for(p, part), right = words_for(p, whole);
    if (wrong == right || wrong == "...") return;
    // What both ends of a clamp hold.
    const bool is_held = (op == Op::minimum || op == Op::maximum) && path == std::array<std::int8_t, 2>{0, 0} &&
                         node_of(p, node_of(p, whole).of[0]).op == (op == Op::minimum ? Op::maximum : Op::minimum);
    if (is_held) {
      add(p, site, {RewriteKind::part, 0, -1, k, path}, "clamp left out: " + right,
          fmt::format("in {} stands {} where {} is meant: it is not held between its ends", words_for(p, at), wrong, right));
      return;
    }
    if (op == Op::floor) {
      add(p, site, {RewriteKind::part, 0, -1, k, path}, "floor left out: " + right,
          fmt::format("in {} stands {} where {} is meant: it is not rounded down", words_for(p, at), wrong, right));
      return;
    }
    add(p, site, {RewriteKind::part, 0, -1, k, path}, fmt::format("value of before: {} for {}", wrong, right),
        fmt::format("in {} stands {} where {} is meant: the value of before a step", words_for(p, at), wrong, right));
  };
  for (std::int8_t i = 0; i < 3; ++i) {
    const std::int32_t part = node_of(p, whole).of[static_cast<std::size_t>(i)];
    one(part, {i, -1});
    for (std::int8_t j = 0; part >= 0 && j < 3; ++j) one(node_of(p, part).of[static_cast<std::size_t>(j)], {i, j});
  }
}

void add_factors(Adder& add, const Probe& p, const Site& site) {
  const auto at = static_cast<std::int32_t>(site.nodes[0]);
  const Node& n = node_of(p, at);
  const std::string all = words_for(p, at);
  for (std::int8_t k = 0; k < 2; ++k) {
    const std::int32_t of = n.of[static_cast<std::size_t>(k)];
    if (of < 0) continue;
    const Node& operand = node_of(p, of);
    const auto other = [&] { return words_for(p, n.of[static_cast<std::size_t>(1 - k)]); };
    if ((n.op == Op::sum || n.op == Op::difference) && operand.op == Op::product)
      for (std::int8_t f = 0; f < 2; ++f) {
        const std::string factor = words_for(p, operand.of[static_cast<std::size_t>(f)]);
        add(p, site, {RewriteKind::over_all, 0, -1, k, {f, -1}}, "factor of the whole sum: " + factor,
            fmt::format("{} multiplies all of {}, after the sum, where it should multiply one term", factor, all));
      }
    if ((n.op == Op::maximum || n.op == Op::minimum) && operand.op == Op::product)
      for (std::int8_t f = 0; f < 2; ++f) {
        const std::string factor = words_for(p, operand.of[static_cast<std::size_t>(f)]);
        const char* const what = n.op == Op::maximum ? "maximum" : "minimum";
        add(p, site, {RewriteKind::over_all, 0, -1, k, {f, -1}}, fmt::format("factor of the whole {}: {}", what, factor),
            fmt::format("{} multiplies all of {}, where it should multiply one of the two", factor, all));
      }
    if ((n.op == Op::product || (n.op == Op::quotient && k == 0)) && (operand.op == Op::sum || operand.op == Op::difference))
      for (const RewriteKind kind : {RewriteKind::over_first, RewriteKind::over_second})
        add(p, site, {kind, 0, -1, k, {-1, -1}}, fmt::format("{} of one term: {}", n.op == Op::product ? "factor" : "divisor", other()),
            fmt::format("in {} {} {} {} alone", all, other(), n.op == Op::product ? "multiplies" : "divides",
                        words_for(p, operand.of[kind == RewriteKind::over_first ? 0 : 1])));
  }
}

/// What rounds or bends a number: where it stands among sums matters.
const char* name_of(Op op) {
  return op == Op::floor         ? "floor"
         : op == Op::fract       ? "fract"
         : op == Op::magnitude   ? "abs"
         : op == Op::root        ? "sqrt"
         : op == Op::square      ? "square"
         : op == Op::power       ? "pow"
         : op == Op::exponential ? "exp"
                                 : "";
}
void add_functions(Adder& add, const Probe& p, const Site& site) {
  const auto at = static_cast<std::int32_t>(site.nodes[0]);
  const Node& n = node_of(p, at);
  const auto op_of = [&](std::int32_t i) { return i < 0 ? Op::constant : node_of(p, i).op; };
  if (n.op == Op::sum || n.op == Op::difference)
    for (std::int8_t k = 0; k < 2; ++k) {
      const std::int32_t of = n.of[static_cast<std::size_t>(k)];
      const char* const function = name_of(op_of(of));
      if (!*function || op_of(of) == Op::power) continue;
      add(p, site, {RewriteKind::function_of_all, 0, -1, k, {-1, -1}}, fmt::format("{} of the whole sum: {}", function, words_for(p, at)),
          fmt::format("{} is taken of all of {}, where it should be of {} alone", function, words_for(p, at),
                      words_for(p, node_of(p, of).of[0])));
    }
  const Op inner = op_of(n.of[0]);
  if (!*name_of(n.op) || (inner != Op::sum && inner != Op::difference)) return;
  for (const RewriteKind kind : {RewriteKind::function_of_first, RewriteKind::function_of_second}) {
    const std::int32_t term = node_of(p, n.of[0]).of[kind == RewriteKind::function_of_first ? 0 : 1];
    if (n.op == Op::floor && op_of(term) == Op::fract) continue;  // nothing is left of it: the floor is left out with it
    add(p, site, {kind, 0, -1, 0, {-1, -1}}, fmt::format("{} of one term: {}", name_of(n.op), words_for(p, term)),
        fmt::format("{} is taken of {} alone, where it should be of all of {}", name_of(n.op), words_for(p, term), words_for(p, n.of[0])));
  }
}

bool bends(Op op) { return *name_of(op) || op == Op::minimum || op == Op::maximum || op == Op::sine || op == Op::cosine; }
bool scales(Op op) { return op == Op::product || op == Op::quotient; }
const char* verb_of(Op op) { return op == Op::quotient ? "divides" : op == Op::product ? "multiplies" : "bounds"; }
std::string function_words(const Probe& p, const Node& n, bool is_clamp) {
  if (is_clamp) return "the clamp";
  if (n.op == Op::minimum || n.op == Op::maximum)
    return fmt::format("{} with {}", n.op == Op::minimum ? "min" : "max", words_for(p, n.of[1]));
  return n.op == Op::sine ? "sin" : n.op == Op::cosine ? "cos" : name_of(n.op);
}
/// An operation and that of its operand in the other order, where that is another number: a factor before a function or after it.
void add_commuted(Adder& add, const Probe& p, const Site& site) {
  const auto at = static_cast<std::int32_t>(site.nodes[0]);
  const Node& n = node_of(p, at);
  const std::string all = words_for(p, at);
  const auto is_clamp = [&](const Node& outer) {
    if ((outer.op != Op::minimum && outer.op != Op::maximum) || outer.of[0] < 0) return false;
    const Op below = node_of(p, outer.of[0]).op;
    return below != outer.op && (below == Op::minimum || below == Op::maximum);
  };
  const bool outer_is_clamp = is_clamp(n);
  for (std::int8_t k = 0; k < 2; ++k) {
    const std::int32_t of = n.of[static_cast<std::size_t>(k)];
    if (of < 0) continue;
    const Node& operand = node_of(p, of);
    const auto after = [&](RewriteKind kind, const Node& inner, std::int8_t j) {
      const std::int32_t other = inner.of[static_cast<std::size_t>(1 - j)];
      const std::string factor = words_for(p, other), function = function_words(p, n, kind == RewriteKind::commuted_outer_2);
      add(p, site, {kind, 0, -1, k, {j, -1}}, fmt::format("too late: {} after {}", factor, function),
          fmt::format("in {} {} {} what {} gives; it should be taken before, inside of {}", all, factor, verb_of(inner.op), function,
                      function));
    };
    const auto before = [&](RewriteKind kind, const Node& inner, std::int8_t j) {
      const std::string factor = words_for(p, n.of[static_cast<std::size_t>(1 - k)]);
      const std::string function = function_words(p, inner, kind == RewriteKind::commuted_inner_2);
      add(p, site, {kind, 0, -1, k, {j, -1}}, fmt::format("too early: {} before {}", factor, function),
          fmt::format("in {} {} {} what {} is taken of; it should be taken after, outside of {}", all, factor, verb_of(n.op), function,
                      function));
    };
    if (bends(n.op) && scales(operand.op))
      for (std::int8_t j = 0; j < (operand.op == Op::quotient ? 1 : 2); ++j) after(RewriteKind::commuted, operand, j);
    if (scales(n.op) && bends(operand.op) && (n.op == Op::product || k == 0)) {
      before(RewriteKind::commuted, operand, 0);
      if (is_clamp(operand)) before(RewriteKind::commuted_inner_2, operand, 0);
    }
    if (k == 0 && outer_is_clamp && operand.of[0] >= 0 && scales(node_of(p, operand.of[0]).op)) {
      const Node& inner = node_of(p, operand.of[0]);
      for (std::int8_t j = 0; j < (inner.op == Op::quotient ? 1 : 2); ++j) after(RewriteKind::commuted_outer_2, inner, j);
    }
    // (a + b) / c for a / c + b.
    if ((n.op == Op::sum || n.op == Op::difference) && operand.op == Op::quotient)
      add(p, site, {RewriteKind::commuted, 0, -1, k, {0, -1}}, "divisor of the whole sum: " + words_for(p, operand.of[1]),
          fmt::format("{} divides all of {}, after the sum, where it should divide one term", words_for(p, operand.of[1]), all));
  }
}

}  // namespace

void add_order_faults(std::vector<Fault>& out, const std::vector<Probe>& probes, const std::vector<float>& known, std::size_t most) {
  Adder add(out, known, most);
  for (const Probe& p : probes) {
    std::vector<int> uses(p.trace.nodes.size());
    for (const Node& n : p.trace.nodes)
      for (const std::int32_t of : n.of)
        if (of >= 0) ++uses[static_cast<std::size_t>(of)];
    std::vector<Site> sites;
    for (std::vector<std::size_t>& vector : vectors_of(p)) sites.push_back({std::move(vector), -1});
    for (std::size_t at = p.trace.nodes.size(); at-- > 0;) {
      const Node& n = p.trace.nodes[at];
      const std::int32_t count = p.trace.met.at(n.shape);
      if (n.occurrence == 0) sites.push_back({{at}, -1});
      if (count > 1 && count <= most_places) sites.push_back({{at}, n.occurrence});
    }
    // Of values of before there are most: they come last, where not all can be asked.
    for (const Site& site : sites) {
      add_factors(add, p, site);
      add_functions(add, p, site);
      add_commuted(add, p, site);
    }
    for (const Node& n : p.trace.nodes)
      if (n.op == Op::choice)
        for (std::int8_t k = 0; k < 2; ++k)
          if (n.of[static_cast<std::size_t>(k)] >= 0 && node_of(p, n.of[static_cast<std::size_t>(k)]).op == Op::choice) {
            const auto at = static_cast<std::size_t>(&n - p.trace.nodes.data());
            add(p, {{at}, -1}, {RewriteKind::first_wins, 0, -1, k, {-1, -1}}, "order of choices reversed",
                "of several that hold in a loop another one stays: the loop runs in the other order, so that the last of them, "
                "which should lie on top, lies below");
          }
    for (const Site& site : sites)
      for (std::int8_t k = 0; k < 3; ++k)
        if (p.trace.nodes[site.nodes[0]].of[static_cast<std::size_t>(k)] >= 0) add_parts(add, p, site, k, uses);
  }
}

}  // namespace rainref::faults
