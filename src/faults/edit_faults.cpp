// An operation of the pass text with differently combined parts: exchanged, regrouped or remapped, or another curve.
#include "faults/generators.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "faults/edits.h"
#include "faults/place_faults.h"
#include "faults/targets.h"

namespace rainref::faults {
namespace {

using perturbed::Formula;
using perturbed::Op;
using perturbed::Rewrite;
using perturbed::RewriteKind;
using perturbed::Rewrites;
using Node = perturbed::Trace::Node;

constexpr std::int32_t most_alike = 4;  // places of one shape that are tried separately

/// True if an edit changes the value at one of the places of its shape.
bool shows(const Probe& p, std::int32_t node, const Formula& formula) {
  int asked = 0;
  for (std::int32_t at = node; at < static_cast<std::int32_t>(p.trace.nodes.size()) && asked < 6; ++at) {
    if (node_of(p, at).shape != node_of(p, node).shape) continue;
    ++asked;
    const float value = value_at(p, at, formula), right = node_of(p, at).value;
    if (!(std::abs(static_cast<double>(value) - right) <= 1e-6 * std::abs(static_cast<double>(right)))) return true;
  }
  return false;
}

class EditAdder {
 public:
  EditAdder(std::vector<Fault>& out, const std::vector<float>& known, std::size_t most)
      : out_(out), known_(std::make_shared<const std::vector<float>>(known)), most_(most) {}
  bool is_full() const { return made_ >= most_; }

  void operator()(const Probe& p, const Nodes& nodes, std::int32_t occurrence, const Edit& edit) {
    if (is_full() || nodes.size() > Rewrites().size()) return;
    auto formulas = std::make_shared<std::vector<Formula>>();
    bool is_seen = false;
    for (std::size_t c = 0; c < nodes.size(); ++c) {
      formulas->push_back(formula_of(edit.made[edit.made.size() == 1 ? 0 : c]));
      is_seen |= shows(p, nodes[c], formulas->back());
    }
    if (!is_seen || !done_.insert({name_of(edit.what) + sentence_of(edit.what), occurrence}).second) return;
    ++made_;
    Rewrites all{};
    for (std::size_t c = 0; c < nodes.size(); ++c) {
      all[c].kind = RewriteKind::formula;
      all[c].shape = node_of(p, nodes[c]).shape;
      all[c].occurrence = occurrence >= 0 ? node_of(p, nodes[c]).occurrence : -1;
      if (occurrence >= 0 && nodes.size() > 1) {
        all[c].period = period_of(p, nodes);
        if (all[c].period > 0) all[c].occurrence = static_cast<std::int32_t>(c);
      }
      // Components with equal shape are distinguished by their order.
      const auto is_same = [&](std::int32_t other) { return node_of(p, other).shape == all[c].shape; };
      if (occurrence < 0 && std::count_if(nodes.begin(), nodes.end(), is_same) > 1) all[c].occurrence = node_of(p, nodes[c]).occurrence;
      all[c].formula = &(*formulas)[c];
    }
    Fault& d = out_.emplace_back(edit.what);
    if (nodes.size() > 1 && edit.made.size() == 1) d.reach = Reach::all;
    d.rewrites = all;
    d.at_texel = [known = known_, formulas](Texel, perturbed::Behaviour& b, std::vector<float>&) { b.known = known.get(); };
    d.is_one_of_many = true;
  }

  /// The same at all places whose components look equal to this depth.
  void shared(const Probe& p, const Nodes& v, std::int8_t depth, Edit edit) {
    edit.what.reach = Reach::each_vector;
    const std::size_t before = out_.size();
    (*this)(p, v, -1, edit);
    if (out_.size() == before) return;
    for (std::size_t c = 0; c < v.size(); ++c) {
      Rewrite& r = (*out_.back().rewrites)[c];
      r.shape = node_of(p, v[c]).shallow[static_cast<std::size_t>(depth - 1)];
      r.occurrence = -1;
      r.depth = depth;
    }
  }
  /// At all places that look equal to this depth.
  void shared(const Probe& p, const SharedPlace& place, Edit edit) {
    if (is_full()) return;
    reach_all(edit.what, place);
    const std::size_t before = out_.size();
    (*this)(p, {place.node}, -1, edit);
    if (out_.size() == before) return;
    Rewrite& r = (*out_.back().rewrites)[0];
    r.shape = shape_of(node_of(p, place.node), place);
    r.depth = place.depth;
  }

 private:
  std::vector<Fault>& out_;
  std::shared_ptr<const std::vector<float>> known_;
  std::set<std::pair<std::string, std::int32_t>> done_;
  std::size_t made_ = 0;
  const std::size_t most_;
};

/// Adds edits_at(node) for each place, from the results to their operands.
template <class EditsAt>
void each_place(EditAdder& add, const Probe& p, const EditsAt& edits_at) {
  for (std::int32_t at = static_cast<std::int32_t>(p.trace.nodes.size()); at-- > 0 && !add.is_full();) {
    const Node& n = node_of(p, at);
    if (is_leaf(n.op)) continue;
    const std::int32_t count = p.trace.met.at(n.shape);
    if (n.occurrence != 0 && count > most_alike) continue;
    for (const Edit& e : edits_at(at)) {
      if (n.occurrence == 0) add(p, {at}, -1, e);
      if (count > 1 && count <= most_alike) add(p, {at}, n.occurrence, e);
    }
  }
}

}  // namespace

void add_edit_faults(std::vector<Fault>& out, const std::vector<Probe>& probes, const std::vector<float>& known, std::size_t most,
                     const std::vector<Probe>& all) {
  EditAdder add(out, known, most);
  for (const Probe& p : probes) {
    const std::vector<Nodes> vectors = vector_groups_of(p);
    for (const Nodes& v : vectors) {
      for (const Edit& e : vector_edits_of(p, v)) add(p, v, are_alike(p, v) ? 0 : -1, e);
    }
    // A function that is called several times is edited in each call.
    std::map<std::uint32_t, std::set<std::uint32_t>> calls;
    for (const Node& n : p.trace.nodes) calls[n.shallow[1]].insert(n.shape);
    std::set<std::vector<std::uint32_t>> asked;
    for (const Nodes& v : vectors) {
      std::vector<std::uint32_t> shallow;
      bool is_called = true;
      for (const std::int32_t at : v) {
        shallow.push_back(node_of(p, at).shallow[1]);
        is_called &= calls[shallow.back()].size() > 1;
      }
      if (!is_called || std::set<std::uint32_t>(shallow.begin(), shallow.end()).size() < v.size() || !asked.insert(shallow).second)
        continue;
      for (const Edit& e : vector_edits_of(p, v)) add.shared(p, v, 2, e);
    }
    for (const Nodes& v : vectors)
      for (const Edit& e : value_curve_edits_of(p, v)) add(p, v, are_alike(p, v) ? 0 : -1, e);
    for (const Nodes& v : lookups_of(p))
      for (const Edit& e : value_curve_edits_of(p, v)) add(p, v, -1, e);
    for (const JointEdit& e : blend_edits_of(p)) add(p, e.nodes, -1, e.edit);
    // A separable filter has the same weights along rows and columns.
    std::map<std::string, std::pair<Nodes, std::vector<Edit>>> filters;
    for (std::int32_t at = static_cast<std::int32_t>(p.trace.nodes.size()); at-- > 0;) {
      if (node_of(p, at).occurrence != 0 || is_leaf(node_of(p, at).op)) continue;
      for (Edit& e : weight_edits_of(p, at)) {
        auto& [nodes, made] = filters[name_of(e.what)];
        nodes.push_back(at);
        add(p, {at}, -1, e);
        made.push_back(std::move(e));
      }
    }
    for (const auto& [name, filter] : filters) {
      if (filter.first.size() < 2 || filter.first.size() > Rewrites().size()) continue;
      Edit every{{}, filter.second[0].what};
      every.what.reach = Reach::all_sums;
      for (const Edit& e : filter.second) every.made.push_back(e.made[0]);
      add(p, filter.first, -1, every);
    }
    std::vector<Nodes> same;
    for (const std::vector<std::size_t>& at : vectors_of(p)) same.emplace_back(at.begin(), at.end());
    for (const Nodes& v : vectors)
      if (!are_alike(p, v) && std::all_of(v.begin(), v.end(), [&](std::int32_t i) { return node_of(p, i).op == node_of(p, v[0]).op; }))
        same.push_back(v);
    for (const Nodes& v : same) {
      for (const Edit& e : edits_of(p, v[0])) add(p, v, -1, e);
      for (const Edit& e : exchanges_of(p, v[0])) add(p, v, -1, e);
    }
    // First other combinations, then exchanged parts, which are most numerous.
    each_place(add, p, [&](std::int32_t at) {
      std::vector<Edit> made = edits_of(p, at);
      for (Edit& e : value_curve_edits_of(p, {at})) made.push_back(std::move(e));
      return made;
    });
    each_place(add, p, [&](std::int32_t at) { return exchanges_of(p, at); });
    // A function of the text that is called several times is edited in each call.
    for (const SharedPlace& place : shared_places_of(all)) {
      if (add.is_full()) break;
      const Probe& of = all[place.probe];
      // At several places that only look equal, edits other than curves are probably chance; in the rounds of a loop they are not.
      const bool is_loop = place.depth == perturbed::by_sequence;
      std::vector<Edit> made = edits_of(of, place.node);
      if (is_loop)
        for (Edit& e : value_curve_edits_of(of, {place.node})) made.push_back(std::move(e));
      for (const Edit& e : made)
        if (is_loop || e.what.kind == Kind::another_curve) add.shared(of, place, e);
    }
  }
}

}  // namespace rainref::faults
