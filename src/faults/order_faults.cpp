// Mistakes in the order of steps: an old value in place of the new one, a factor applied too early or too late.
#include "faults/generators.h"

#include <memory>
#include <set>
#include <tuple>

#include "faults/place_faults.h"
#include "faults/targets.h"
#include "faults/text.h"

namespace rainref::faults {
namespace {

using perturbed::Op;
using perturbed::Rewrite;
using perturbed::RewriteKind;
using perturbed::Rewrites;
using Node = perturbed::Trace::Node;

constexpr std::int32_t most_places = 6;  // places of one shape that are tried separately

/// Where a mistake is made: at a node, at every node of its shape, or in each component of a vector.
struct Site {
  std::vector<std::size_t> nodes;  ///< the first one gives the text
  std::int32_t occurrence;         ///< -1: every node of these shapes
};

class OrderAdder {
 public:
  OrderAdder(std::vector<Fault>& out, const std::vector<float>& known, std::size_t most)
      : out_(out), known_(std::make_shared<const std::vector<float>>(known)), most_(most) {}
  void operator()(const Probe& p, const Site& site, Rewrite r, What what) {
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
    const std::size_t components =
        site.nodes.size() == 1 && site.occurrence < 0 ? components_of(p, site.nodes[0]).size() : site.nodes.size();
    if (components > 1) what.reach = components == 2 ? Reach::both : Reach::all;
    Fault& d = out_.emplace_back(std::move(what));
    d.rewrites = all;
    tell_places_by(d, known_);
  }

 private:
  std::vector<Fault>& out_;
  std::shared_ptr<const std::vector<float>> known_;
  std::set<std::tuple<RewriteKind, std::uint32_t, std::int32_t, std::int8_t, std::array<std::int8_t, 2>>> done_;
  std::size_t made_ = 0, most_;
};

/// Part of an operand in place of the whole. If the whole has no other use, "term left out" says the same.
void add_parts(OrderAdder& add, const Probe& p, const Site& site, std::int8_t k, const std::vector<int>& uses) {
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
    // The value inside a clamp with two limits.
    const bool is_held = (op == Op::minimum || op == Op::maximum) && path == std::array<std::int8_t, 2>{0, 0} &&
                         node_of(p, node_of(p, whole).of[0]).op == (op == Op::minimum ? Op::maximum : Op::minimum);
    const Kind kind = is_held ? Kind::unclamped_before : op == Op::floor ? Kind::unrounded_before : Kind::value_of_before;
    add(p, site, {RewriteKind::part, 0, -1, k, path}, {kind, {words_for(p, at), wrong, right}});
  };
  for (std::int8_t i = 0; i < 3; ++i) {
    const std::int32_t part = node_of(p, whole).of[static_cast<std::size_t>(i)];
    one(part, {i, -1});
    for (std::int8_t j = 0; part >= 0 && j < 3; ++j) one(node_of(p, part).of[static_cast<std::size_t>(j)], {i, j});
  }
}

void add_factors(OrderAdder& add, const Probe& p, const Site& site) {
  const auto at = static_cast<std::int32_t>(site.nodes[0]);
  const Node& n = node_of(p, at);
  const std::string all = words_for(p, at);
  for (std::int8_t k = 0; k < 2; ++k) {
    const std::int32_t of = n.of[static_cast<std::size_t>(k)];
    if (of < 0) continue;
    const Node& operand = node_of(p, of);
    const auto over_all = [&](Kind kind) {
      for (std::int8_t f = 0; f < 2; ++f)
        add(p, site, {RewriteKind::over_all, 0, -1, k, {f, -1}}, {kind, {all, words_for(p, operand.of[static_cast<std::size_t>(f)])}});
    };
    if ((n.op == Op::sum || n.op == Op::difference) && operand.op == Op::product) over_all(Kind::factor_of_whole_sum);
    if (n.op == Op::maximum && operand.op == Op::product) over_all(Kind::factor_of_whole_maximum);
    if (n.op == Op::minimum && operand.op == Op::product) over_all(Kind::factor_of_whole_minimum);
    if ((n.op == Op::product || (n.op == Op::quotient && k == 0)) && (operand.op == Op::sum || operand.op == Op::difference))
      for (const RewriteKind kind : {RewriteKind::over_first, RewriteKind::over_second})
        add(p, site, {kind, 0, -1, k, {-1, -1}},
            {n.op == Op::product ? Kind::factor_of_one_term : Kind::divisor_of_one_term,
             {all, words_for(p, n.of[static_cast<std::size_t>(1 - k)]),
              words_for(p, operand.of[kind == RewriteKind::over_first ? 0 : 1])}});
  }
}

/// A rounding or nonlinear function at another position among sums.
void add_functions(OrderAdder& add, const Probe& p, const Site& site) {
  const auto at = static_cast<std::int32_t>(site.nodes[0]);
  const Node& n = node_of(p, at);
  const auto op_of = [&](std::int32_t i) { return i < 0 ? Op::constant : node_of(p, i).op; };
  if (n.op == Op::sum || n.op == Op::difference)
    for (std::int8_t k = 0; k < 2; ++k) {
      const std::int32_t of = n.of[static_cast<std::size_t>(k)];
      const char* const function = bend_name(op_of(of));
      if (!*function || op_of(of) == Op::power) continue;
      add(p, site, {RewriteKind::function_of_all, 0, -1, k, {-1, -1}},
          {Kind::function_of_whole_sum, {words_for(p, at), function, words_for(p, node_of(p, of).of[0])}});
    }
  const Op inner = op_of(n.of[0]);
  if (!*bend_name(n.op) || (inner != Op::sum && inner != Op::difference)) return;
  for (const RewriteKind kind : {RewriteKind::function_of_first, RewriteKind::function_of_second}) {
    const std::int32_t term = node_of(p, n.of[0]).of[kind == RewriteKind::function_of_first ? 0 : 1];
    if (n.op == Op::floor && op_of(term) == Op::fract) continue;  // nothing is left of it: covered by leaving out the floor
    add(p, site, {kind, 0, -1, 0, {-1, -1}}, {Kind::function_of_one_term, {words_for(p, n.of[0]), bend_name(n.op), words_for(p, term)}});
  }
}

bool bends(Op op) { return *bend_name(op) || op == Op::minimum || op == Op::maximum || op == Op::sine || op == Op::cosine; }
bool scales(Op op) { return op == Op::product || op == Op::quotient; }
/// An operation and its operand's operation exchanged, if the result differs: a factor before or after a function.
void add_commuted(OrderAdder& add, const Probe& p, const Site& site) {
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
      const std::string function = kind == RewriteKind::commuted_outer_2 ? "the clamp" : function_text(p, n);
      add(p, site, {kind, 0, -1, k, {j, -1}},
          {Kind::too_late, {all, words_for(p, inner.of[static_cast<std::size_t>(1 - j)]), verb_of(inner.op), function}});
    };
    const auto before = [&](RewriteKind kind, const Node& inner, std::int8_t j) {
      const std::string function = kind == RewriteKind::commuted_inner_2 ? "the clamp" : function_text(p, inner);
      add(p, site, {kind, 0, -1, k, {j, -1}},
          {Kind::too_early, {all, words_for(p, n.of[static_cast<std::size_t>(1 - k)]), verb_of(n.op), function}});
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
      add(p, site, {RewriteKind::commuted, 0, -1, k, {0, -1}}, {Kind::divisor_of_whole_sum, {all, words_for(p, operand.of[1])}});
  }
}

}  // namespace

void add_order_faults(std::vector<Fault>& out, const std::vector<Probe>& probes, const std::vector<float>& known, std::size_t most) {
  OrderAdder add(out, known, most);
  for (const Probe& p : probes) {
    const std::vector<int> uses = uses_of(p.trace);
    std::vector<Site> sites;
    for (std::vector<std::size_t>& vector : vectors_of(p)) sites.push_back({std::move(vector), -1});
    for (std::size_t at = p.trace.nodes.size(); at-- > 0;) {
      const Node& n = p.trace.nodes[at];
      const std::int32_t count = p.trace.met.at(n.shape);
      if (n.occurrence == 0) sites.push_back({{at}, -1});
      if (count > 1 && count <= most_places) sites.push_back({{at}, n.occurrence});
    }
    // Old values are most numerous, so they come last, in case not all can be tried.
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
            add(p, {{at}, -1}, {RewriteKind::first_wins, 0, -1, k, {-1, -1}}, {Kind::order_of_choices});
          }
    for (const Site& site : sites)
      for (std::int8_t k = 0; k < 3; ++k)
        if (p.trace.nodes[site.nodes[0]].of[static_cast<std::size_t>(k)] >= 0) add_parts(add, p, site, k, uses);
  }
}

}  // namespace rainref::faults
