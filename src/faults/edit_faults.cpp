#include "faults/edit_faults.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

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
using Nodes = std::vector<std::int32_t>;

constexpr std::int32_t most_alike = 4;  // of one shape that are tried one by one

/// Whether an edit gives another number at one of the places of its shape.
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

bool are_alike(const Probe& p, const Nodes& v) {
  std::set<std::uint32_t> shapes;
  for (const std::int32_t node : v) shapes.insert(node_of(p, node).shape);
  return shapes.size() < v.size();
}
/// In a loop that meets the components, all of one shape, round by round: how many there are; else 0.
std::int32_t period_of(const Probe& p, const Nodes& v) {
  const auto n = static_cast<std::int32_t>(v.size());
  for (std::int32_t k = 0; k < n; ++k) {
    const Node& node = node_of(p, v[static_cast<std::size_t>(k)]);
    if (node.shape != node_of(p, v[0]).shape || node.occurrence % n != k) return 0;
  }
  return p.trace.met.at(node_of(p, v[0]).shape) % n == 0 ? n : 0;
}

class Adder {
 public:
  Adder(std::vector<Fault>& out, const std::vector<float>& known, std::size_t most)
      : out_(out), known_(std::make_shared<const std::vector<float>>(known)), most_(most) {}
  bool is_full() const { return made_ >= most_; }
  /// For what is asked after all else: a tenth more.
  void extend() { most_ += most_ / 10; }

  /// `period`: of places of one shape, met again and again, each one that is so many on, from `occurrence`.
  void operator()(const Probe& p, const Nodes& nodes, std::int32_t occurrence, const Edit& edit, std::int32_t period = 0) {
    if (is_full() || nodes.size() > Rewrites().size()) return;
    auto formulas = std::make_shared<std::vector<Formula>>();
    bool is_seen = false;
    for (std::size_t c = 0; c < nodes.size(); ++c) {
      formulas->push_back(formula_of(edit.made[edit.made.size() == 1 ? 0 : c]));
      is_seen |= shows(p, nodes[c], formulas->back());
    }
    std::string key = fmt::format("{}{}/{}", edit.name, edit.sentence, period);
    if (!is_seen || !done_.insert({std::move(key), occurrence}).second) return;
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
      // Components that look alike are told apart by their order.
      const auto is_same = [&](std::int32_t other) { return node_of(p, other).shape == all[c].shape; };
      if (occurrence < 0 && std::count_if(nodes.begin(), nodes.end(), is_same) > 1) all[c].occurrence = node_of(p, nodes[c]).occurrence;
      if (period > 0) all[c].occurrence = occurrence, all[c].period = period;
      all[c].formula = &(*formulas)[c];
    }
    Fault d;
    d.name = edit.name;
    d.sentence = edit.sentence;
    if (nodes.size() > 1 && edit.made.size() == 1) d.name += ", in all components", d.sentence += ", and so in the other components";
    d.rewrites = all;
    d.at_texel = [known = known_, formulas](Texel, perturbed::Behaviour& b, std::vector<float>&) { b.known = known.get(); };
    d.for_diagnosis = true;
    d.is_one_of_many = true;
    out_.push_back(std::move(d));
  }

  /// At all places that look alike so few operations deep.
  void shared(const Probe& p, const SharedPlace& place, Edit edit) {
    if (is_full()) return;
    edit.name += ", in each such place";
    edit.sentence += words_for_all(place);
    const std::size_t before = out_.size();
    (*this)(p, {place.node}, -1, edit);
    if (out_.size() == before) return;
    Rewrite& r = (*out_.back().rewrites)[0];
    r.shape = node_of(p, place.node).shallow[static_cast<std::size_t>(place.depth - 1)];
    r.depth = place.depth;
  }

 private:
  std::vector<Fault>& out_;
  std::shared_ptr<const std::vector<float>> known_;
  std::set<std::pair<std::string, std::int32_t>> done_;
  std::size_t made_ = 0, most_;
};

/// What belongs together as a vector: what a length is taken of, the arguments of named functions, what is alike but for the
/// component, what the outputs are made of side by side.
std::vector<Nodes> groups_of(const Probe& p) {
  std::vector<Nodes> out;
  std::set<std::vector<std::uint32_t>> done;
  const auto add = [&](Nodes v) {
    if (v.size() < 2 || v.size() > 3 || std::any_of(v.begin(), v.end(), [](std::int32_t i) { return i < 0; })) return;
    if (std::set<std::int32_t>(v.begin(), v.end()).size() < v.size()) return;
    std::vector<std::uint32_t> shapes;
    for (const std::int32_t i : v) {
      if (is_leaf(node_of(p, i).op) || node_of(p, i).op == Op::lookup) return;
      shapes.push_back(node_of(p, i).shape);
    }
    // What is alike in the components is told apart by its order, in a loop from round to round.
    if (are_alike(p, v) && p.trace.met.at(shapes[0]) > 3 && period_of(p, v) == 0) return;
    if (done.insert(shapes).second) out.push_back(std::move(v));
  };
  for (std::int32_t at = static_cast<std::int32_t>(p.trace.nodes.size()); at-- > 0;) {
    const Node& n = node_of(p, at);
    if (n.occurrence != 0 || n.op != Op::sum || n.of[0] < 0 || n.of[1] < 0) continue;
    const auto squared = [&](std::int32_t i) { return i >= 0 && node_of(p, i).op == Op::square ? node_of(p, i).of[0] : -1; };
    const Node& first = node_of(p, n.of[0]);
    if (first.op == Op::sum) add({squared(first.of[0]), squared(first.of[1]), squared(n.of[1])});
    add({squared(n.of[0]), squared(n.of[1])});
  }
  // What these are made of side by side, as far as it is by the same operations, and what stands there.
  const auto add_below = [&](Nodes top, std::size_t most) {
    std::vector<Nodes> open{std::move(top)};
    for (std::size_t at = 0; at < open.size() && open.size() < most; ++at) {
      const Nodes v = open[at];
      if (std::any_of(v.begin(), v.end(), [](std::int32_t i) { return i < 0; })) continue;
      add(v);
      if (std::any_of(v.begin(), v.end(), [&](std::int32_t i) { return node_of(p, i).op != node_of(p, v[0]).op; })) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        Nodes& below = open.emplace_back();
        for (const std::int32_t i : v) below.push_back(node_of(p, i).of[k]);
      }
    }
  };
  for (const std::vector<std::size_t>& v : vectors_of(p)) add_below({v.begin(), v.end()}, 12);
  for (std::size_t first = 0; first < p.outputs.size() && first < 8; ++first)
    for (const std::size_t n : {3u, 2u}) {
      if (first + n > p.outputs.size()) continue;
      add_below({p.outputs.begin() + static_cast<std::ptrdiff_t>(first), p.outputs.begin() + static_cast<std::ptrdiff_t>(first + n)}, 300);
    }
  // Two beside each other of the same operation of the same operations: members of a record have names of their own.
  const auto is_alike = [&](const Node& a, const Node& b) {
    for (std::size_t k = 0; k < a.of.size(); ++k) {
      if ((a.of[k] < 0) != (b.of[k] < 0)) return false;
      const bool takes_sum = a.op == Op::choice || a.op == Op::mix;  // of a matrix one row may be a sum, and one a product
      if (a.of[k] >= 0 && !takes_sum && node_of(p, a.of[k]).op != node_of(p, b.of[k]).op) return false;
    }
    return true;
  };
  constexpr std::int32_t near = 24;
  constexpr std::size_t most_pairs = 60;
  std::size_t pairs = 0;
  for (std::int32_t b = static_cast<std::int32_t>(p.trace.nodes.size()); b-- > 0 && pairs < most_pairs;) {
    const Node& second = node_of(p, b);
    if (second.occurrence != 0 || (second.op != Op::choice && second.op != Op::mix && second.op != Op::sum && second.op != Op::difference))
      continue;
    for (std::int32_t a = b - 1; a >= 0 && b - a <= near; --a) {
      const Node& first = node_of(p, a);
      if (first.op != second.op) continue;
      if (first.occurrence == 0 && first.shape != second.shape && is_alike(first, second)) add_below({a, b}, 8), ++pairs;
      break;
    }
  }
  return out;
}

/// Channels that one lookup gives.
std::vector<Nodes> lookups_of(const Probe& p) {
  std::vector<Nodes> out;
  std::set<std::uint32_t> done;
  const auto image = [&](std::int32_t at) {
    const std::string text = words_for(p, at);
    const std::size_t dot = text.rfind('.');
    return dot + 2 == text.size() ? text.substr(0, dot) : std::string();
  };
  constexpr std::size_t most = 24;
  const auto count = static_cast<std::int32_t>(p.trace.nodes.size());
  constexpr std::int32_t near = 12;  // what a lookup does for its next channel
  for (std::int32_t at = 0; at < count && out.size() < most; ++at) {
    if (node_of(p, at).op != Op::lookup || node_of(p, at).occurrence != 0) continue;
    const std::string name = image(at);
    if (name.empty() || done.contains(node_of(p, at).shape)) continue;
    Nodes v{at};
    for (std::int32_t next = at + 1; next < count && next - v.back() <= near && v.size() < 3; ++next)
      if (node_of(p, next).op == Op::lookup && node_of(p, next).occurrence == 0 && image(next) == name &&
          node_of(p, next).shape != node_of(p, v.back()).shape)
        v.push_back(next);
    for (const std::int32_t i : v) done.insert(node_of(p, i).shape);
    if (v.size() > 1) out.push_back(std::move(v));
  }
  return out;
}

}  // namespace

void add_edit_faults(std::vector<Fault>& out, const std::vector<Probe>& probes, const std::vector<float>& known, std::size_t most,
                     bool copies, const std::vector<Probe>& all) {
  Adder add(out, known, most);
  for (const Probe& p : probes) {
    const std::vector<Nodes> vectors = groups_of(p);
    for (const Nodes& v : vectors) {
      for (const Edit& e : vector_edits_of(p, v)) add(p, v, are_alike(p, v) ? 0 : -1, e);
    }
    for (const Nodes& v : vectors)
      for (const Edit& e : value_curve_edits_of(p, v)) add(p, v, are_alike(p, v) ? 0 : -1, e);
    for (const Nodes& v : lookups_of(p))
      for (const Edit& e : value_curve_edits_of(p, v)) add(p, v, -1, e);
    for (const JointEdit& e : turned_edits_of(p)) add(p, e.nodes, -1, e.edit);
    for (const JointEdit& e : blend_edits_of(p)) add(p, e.nodes, -1, e.edit);
    for (const JointEdit& e : moved_edits_of(p, vectors)) add(p, e.nodes, -1, e.edit);
    // A filter that is taken along rows and then along columns has the same weights in both.
    std::map<std::string, std::pair<Nodes, std::vector<Edit>>> filters;
    for (std::int32_t at = static_cast<std::int32_t>(p.trace.nodes.size()); at-- > 0;) {
      if (node_of(p, at).occurrence != 0 || is_leaf(node_of(p, at).op)) continue;
      for (Edit& e : weight_edits_of(p, at)) {
        auto& [nodes, made] = filters[e.name];
        nodes.push_back(at);
        add(p, {at}, -1, e);
        made.push_back(std::move(e));
      }
    }
    for (const auto& [name, filter] : filters) {
      if (filter.first.size() < 2 || filter.first.size() > Rewrites().size()) continue;
      Edit every{{}, name + ", in all of these sums", filter.second[0].sentence + ", and so in the other sums of these weights"};
      for (const Edit& e : filter.second) every.made.push_back(e.made[0]);
      add(p, filter.first, -1, every);
    }
    for (const std::vector<std::size_t>& at : vectors_of(p)) {
      const Nodes v(at.begin(), at.end());
      for (const Edit& e : edits_of(p, v[0], false)) add(p, v, -1, e);
    }
    for (const bool is_rarer : {false, true}) {
      if (is_rarer) {
        add.extend();
        constexpr std::size_t most_joint = 300;
        for (const auto of_several : {branch_edits_of, constant_edits_of}) {
          std::vector<JointEdit> joint = of_several(p);
          if (joint.size() > most_joint) joint.resize(most_joint);
          for (const JointEdit& e : joint) add(p, e.nodes, -1, e.edit);
        }
        // A function of the text that is called several times has an edit in each call.
        for (const SharedPlace& place : shared_places_of(all)) {
          if (add.is_full()) break;
          const Probe& of = all[place.probe];
          // What is put together otherwise in several places that only look alike is rather a chance.
          for (const Edit& e : edits_of(of, place.node, false))
            if (e.name.starts_with("another") || e.name.starts_with("held") || e.name.starts_with("wrapped") ||
                e.name.starts_with("ceiling"))
              add.shared(of, place, e);
        }
      }
      for (std::int32_t at = static_cast<std::int32_t>(p.trace.nodes.size()); at-- > 0 && !add.is_full();) {
        const Node& n = node_of(p, at);
        if (is_leaf(n.op)) continue;
        const std::int32_t count = p.trace.met.at(n.shape);
        if (n.occurrence != 0 && count > most_alike) continue;
        if (!is_rarer)
          for (const Edit& e : value_curve_edits_of(p, {at})) {
            if (n.occurrence == 0) add(p, {at}, -1, e);
            if (count > 1 && count <= most_alike) add(p, {at}, n.occurrence, e);
          }
        if (n.op == Op::lookup) continue;
        for (const Edit& e : is_rarer ? rarer_edits_of(p, at) : edits_of(p, at, copies)) {
          if (n.occurrence == 0) add(p, {at}, -1, e);
          if (count > 1 && count <= most_alike) add(p, {at}, n.occurrence, e);
          // Of two or three that are met in each round of a loop.
          for (const std::int32_t period : {2, 3})
            if (count > most_alike && count % period == 0 && count <= 8 * period && e.name.starts_with("another member"))
              for (std::int32_t first = 0; first < period; ++first) add(p, {at}, first, e, period);
        }
      }
    }
  }
}

}  // namespace rainref::faults
