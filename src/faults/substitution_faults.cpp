#include "faults/substitution_faults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace rainref::faults {
namespace {

using perturbed::Change;
using perturbed::Op;
using perturbed::Put;
using perturbed::Substitution;
using perturbed::Trace;
using Node = Trace::Node;

constexpr std::size_t most_uses = 240;
constexpr std::int32_t most_alike = 6;  // of one shape that are solved for one by one

std::string words(const Probe& p, std::int32_t node) {
  for (int depth = 3; depth > 0; --depth)
    if (const std::string text = p.text(node, depth); text.size() <= 60) return text;
  return p.text(node, 1).substr(0, 77);
}
const Node& node_of(const Probe& p, std::int32_t i) { return p.trace.nodes[static_cast<std::size_t>(i)]; }

/// An operand at a place.
struct Use {
  std::int32_t node;
  std::int8_t operand;
};
bool is_leaf(Op op) { return op == Op::constant || op == Op::load || op == Op::fetch || op == Op::index; }
/// What has a name of its own.
bool is_named(Op op) { return is_leaf(op) || op == Op::lookup; }
/// Whether the arithmetic can be done again with another number there.
bool is_again(Op op) { return !is_leaf(op) && op != Op::lookup; }

std::vector<Use> uses_of(const Probe& p) {
  std::vector<Use> out;
  for (std::int32_t at = static_cast<std::int32_t>(p.trace.nodes.size()); at-- > 0;) {
    const Node& n = node_of(p, at);
    if (!is_again(n.op) || p.trace.met.at(n.shape) > most_alike) continue;
    for (std::int8_t k = 0; k < (n.op == Op::choice ? 2 : 4) && out.size() < most_uses; ++k)
      if (n.of[static_cast<std::size_t>(k)] >= 0) out.push_back({at, k});
  }
  return out;
}

Substitution at_use(const Probe& p, const Use& use) {
  const Node& n = node_of(p, use.node);
  Substitution s;
  s.shape = n.shape;
  s.occurrence = n.occurrence;
  s.operand = use.operand;
  return s;
}

/// What a texel's slots hold with a number in place of an operand.
class Solver {
 public:
  Solver(const capture::PassModel& model, const Solvable& texel, const std::vector<float>& known)
      : model_(model), texel_(texel), known_(known) {}

  std::vector<float> values(const Substitution& s) const {
    perturbed::Substitutions one{{s}};
    one.start();
    perturbed::Behaviour b;
    b.known = &known_;
    b.substitutions = &one;
    const perturbed::Scope scope(b);
    std::vector<perturbed::Perturbed> out(texel_.port.size());
    model_.evaluate(texel_.probe.at.x, texel_.probe.at.y, out.data());
    std::vector<float> numbers;
    for (const perturbed::Perturbed& v : out) numbers.push_back(v.v);
    return numbers;
  }
  bool is_near(const std::vector<float>& v) const {
    for (std::size_t k = 0; k < v.size(); ++k)
      if (!(std::abs(static_cast<double>(v[k]) - texel_.port[k]) <= texel_.leeway[k])) return false;
    return true;
  }
  bool is_near(const Substitution& s) const { return is_near(values(s)); }

  struct Root {
    float at;
    double leeway;
  };
  /// The numbers that an operand must be, where there are some. `now`: what it is.
  std::vector<Root> roots(Substitution s, float now) const {
    const auto with = [&](float x) {
      s.number = x;
      return values(s);
    };
    const std::vector<float> right = with(now);
    std::size_t slot = 0;
    double farthest = 0;
    for (std::size_t k = 0; k < right.size(); ++k)
      if (const double far = std::abs(static_cast<double>(right[k]) - texel_.port[k]) / texel_.leeway[k]; far > farthest)
        farthest = far, slot = k;
    if (farthest <= 1) return {};
    const float size = now != 0 ? now : 1;
    bool counts = false;
    for (const float x : {0.0f, 2 * size, -size, 0.5f * size, 1.1f * size, 20.0f}) counts |= counts ? false : with(x)[slot] != right[slot];
    if (!counts) return {};
    std::vector<float> tried{0, 0.01f, 0.1f, 0.5f, 1, 2, 5, 20, 100, 1000, -0.01f, -0.1f, -0.5f, -1, -2, -5, -20, -100, -1000};
    for (const float f : {-3.0f, -1.0f, -0.5f, 0.1f, 0.3f, 0.5f, 0.75f, 0.9f, 0.97f, 1.0f, 1.03f, 1.1f, 1.3f, 1.6f, 2.0f, 3.0f, 5.0f})
      tried.push_back(f * size);
    std::sort(tried.begin(), tried.end());
    tried.erase(std::unique(tried.begin(), tried.end()), tried.end());
    const auto off = [&](float x) { return static_cast<double>(with(x)[slot]) - texel_.port[slot]; };
    std::vector<Root> out;
    const auto keep = [&](float x) {
      if (x == now || !is_near(with(x))) return;
      const float step = 1e-3f * (std::abs(x) + 1e-3f);
      const double slope = std::abs(off(x + step) - off(x - step)) / 2;
      const double most = 0.02 * std::abs(x) + 1e-6;
      out.push_back({x, slope > 0 ? std::min(most, 2 * step * texel_.leeway[slot] / slope) : most});
    };
    double before = off(tried[0]);
    for (std::size_t k = 1; k < tried.size() && out.size() < 4; ++k) {
      const double at = off(tried[k]);
      if (std::isfinite(before) && std::isfinite(at) && (before < 0) != (at < 0)) {
        float low = tried[k - 1], high = tried[k];
        double at_low = before;
        for (int round = 0; round < 26; ++round) {
          const float middle = low + (high - low) / 2;
          const double there = off(middle);
          if ((there < 0) == (at_low < 0))
            low = middle, at_low = there;
          else
            high = middle;
        }
        keep(low + (high - low) / 2);
      }
      before = at;
    }
    return out;
  }

 private:
  const capture::PassModel& model_;
  const Solvable& texel_;
  const std::vector<float>& known_;
};

std::string changed_words(Change change, const std::string& text) {
  const bool is_compound = text.find(' ') != std::string::npos;
  const std::string one = is_compound ? fmt::format("({})", text) : text;
  switch (change) {
    case Change::none:
      return text;
    case Change::negated:
      return "-" + one;
    case Change::from_one:
      return "1 - " + one;
    case Change::magnitude:
      return fmt::format("abs({})", text);
    case Change::squared:
      return fmt::format("square({})", text);
    case Change::rooted:
      return fmt::format("sqrt({})", text);
    case Change::inverted:
      return "1 / " + one;
    case Change::doubled:
      return "2 * " + one;
    case Change::halved:
      return "0.5 * " + one;
  }
  return text;
}

/// How many steps off a source is: a leaf as it is is plainer than a term made of it.
int effort(const Substitution& s, bool is_of_leaf) {
  return (is_of_leaf ? 0 : 1) + (s.change == Change::none ? 0 : 2) + (s.how == Put::instead ? 0 : 3);
}

/// Which nodes came before a place, as sources.
std::vector<std::pair<std::int32_t, std::int32_t>> sources_before(const Probe& p, std::int32_t at) {
  std::vector<std::pair<std::int32_t, std::int32_t>> out;  // node, how many of its shape back
  std::map<std::uint32_t, std::int32_t> after;
  constexpr std::int32_t most_back = 64;
  for (std::int32_t m = at; m-- > 0 && out.size() < 400;) {
    const std::int32_t back = ++after[node_of(p, m).shape];
    if (back <= most_back && node_of(p, m).op != Op::comparison) out.emplace_back(m, back);
  }
  return out;
}

Fault fault_of(const Substitution& s, const std::shared_ptr<const std::vector<float>>& known, std::string name, std::string sentence) {
  Fault d;
  d.name = std::move(name);
  d.sentence = std::move(sentence);
  d.substitutions = {s};
  d.at_texel = [known](Texel, perturbed::Behaviour& b, std::vector<float>&) { b.known = known.get(); };
  d.for_diagnosis = true;
  return d;
}

}  // namespace

void add_solved_substitutions(std::vector<Fault>& out, const Probed& p, const std::vector<Solvable>& texels,
                              const std::vector<float>& known) {
  if (texels.size() < 2) return;
  const auto shared = std::make_shared<const std::vector<float>>(known);
  const Probe& first = texels[0].probe;
  std::vector<Solver> solvers;
  for (const Solvable& t : texels) solvers.emplace_back(p.model, t, *shared);
  std::vector<std::map<std::pair<std::uint32_t, std::int32_t>, std::int32_t>> nodes(texels.size());
  for (std::size_t t = 0; t < texels.size(); ++t)
    for (std::size_t n = 0; n < texels[t].probe.trace.nodes.size(); ++n) {
      const Node& node = texels[t].probe.trace.nodes[n];
      nodes[t][{node.shape, node.occurrence}] = static_cast<std::int32_t>(n);
    }
  std::vector<std::pair<int, Fault>> found;
  for (const Use& use : uses_of(first)) {
    Substitution s = at_use(first, use);
    const std::int32_t operand = node_of(first, use.node).of[static_cast<std::size_t>(use.operand)];
    const std::vector<Solver::Root> roots = solvers[0].roots(s, node_of(first, operand).value);
    if (roots.empty()) continue;
    // What the others need there.
    std::vector<std::vector<Solver::Root>> all{roots};
    std::vector<float> now{node_of(first, operand).value};
    for (std::size_t t = 1; t < texels.size(); ++t) {
      const auto place = nodes[t].find({s.shape, s.occurrence});
      if (place == nodes[t].end()) break;
      const std::int32_t theirs = node_of(texels[t].probe, place->second).of[static_cast<std::size_t>(use.operand)];
      if (theirs < 0) break;
      now.push_back(node_of(texels[t].probe, theirs).value);
      all.push_back(solvers[t].roots(s, now.back()));
      if (all.back().empty()) break;
    }
    if (all.size() != texels.size() || all.back().empty()) continue;
    const std::string right = words(first, operand), where = words(first, use.node);
    const auto suits = [&](const Substitution& other) {
      return std::all_of(solvers.begin() + 1, solvers.end(), [&](const Solver& at) { return at.is_near(other); });
    };
    std::set<std::tuple<std::uint32_t, std::int32_t, Change, Put>> done;
    for (const Solver::Root& root : roots)
      for (const auto& [source, back] : sources_before(first, use.node)) {
        const float v = node_of(first, source).value;
        // What happens to be 0 or 1 makes nothing of a term, or leaves it as it is: that has plainer names.
        if (v == 0 || v == 1 || v == -1) continue;
        for (const Put how : {Put::instead, Put::times, Put::divided_by, Put::plus, Put::minus})
          for (const Change change : {Change::none, Change::negated, Change::from_one, Change::magnitude, Change::squared, Change::rooted,
                                      Change::inverted, Change::doubled, Change::halved}) {
            // A term of the other sign and a factor upside down are those of the other kind.
            const bool is_term = how == Put::plus || how == Put::minus, is_factor = how == Put::times || how == Put::divided_by;
            if ((is_term && change == Change::negated) || (is_factor && change == Change::inverted)) continue;
            const float other = perturbed::changed(v, change);
            if (other == 0 || other == 1 || other == -1) continue;
            const float there = perturbed::put(now[0], other, how);
            if (!(std::abs(static_cast<double>(there) - root.at) <= root.leeway)) continue;
            s.source = node_of(first, source).shape;
            s.back = back;
            s.change = change;
            s.how = how;
            if (!done.insert({s.source, back, change, how}).second || !suits(s)) continue;
            const std::string text = words(first, source), wrong = changed_words(change, text);
            const bool is_same_text = wrong == right && how == Put::instead;
            if (text == "..." || (is_same_text && text.find("...") != std::string::npos)) continue;
            const char* const verb = how == Put::times ? "multiplied by" : how == Put::divided_by ? "divided by" : "";
            const bool is_of_leaf = is_named(node_of(first, source).op);
            const int costs = effort(s, is_of_leaf);
            if (is_same_text)
              found.emplace_back(costs, fault_of(s, shared, fmt::format("wrong texel: {}", right),
                                                 fmt::format("in {} the texel {} is read elsewhere: at another neighbour", where, right)));
            else if (how == Put::instead)
              found.emplace_back(costs, fault_of(s, shared, fmt::format("wrong value: {} for {}", wrong, right),
                                                 fmt::format("in {} stands {} where {} is meant", where, wrong, right)));
            else if (is_factor)
              found.emplace_back(costs, fault_of(s, shared, fmt::format("factor too many: {}", how == Put::times ? wrong : "1 / " + wrong),
                                                 fmt::format("in {} the term {} is {} {}", where, right, verb, wrong)));
            else
              found.emplace_back(costs, fault_of(s, shared, fmt::format("term too many: {}{}", how == Put::plus ? "" : "-", wrong),
                                                 fmt::format("in {} {} is {} {}", where, wrong,
                                                             how == Put::plus ? "added to" : "subtracted from", right)));
          }
      }
    // A number in its place, or a factor or a term that is one, where the operand itself is none.
    if (node_of(first, operand).op == Op::constant) continue;
    s.source = 0;
    s.back = 0;
    s.change = Change::none;
    const bool varies = std::any_of(now.begin(), now.end(), [&](float v) { return std::abs(v - now[0]) > 0.02f * std::abs(now[0]); });
    for (const Put how : {Put::instead, Put::times, Put::plus}) {
      if (how != Put::instead && !varies) continue;
      const float number = how == Put::instead ? roots[0].at : how == Put::times ? roots[0].at / now[0] : roots[0].at - now[0];
      if (!std::isfinite(number)) continue;
      s.how = how;
      s.number = number;
      if (!suits(s)) continue;
      for (int digits = 1; digits < 6; ++digits) {
        const float nice = std::strtof(fmt::format("{:.{}g}", number, digits).c_str(), nullptr);
        Substitution rounded = s;
        rounded.number = nice;
        if (solvers[0].is_near(rounded) && suits(rounded)) {
          s = rounded;
          break;
        }
      }
      found.emplace_back(9,
                         fault_of(s, shared, fmt::format("another value of {}", right),
                                  how == Put::instead ? fmt::format("in {} stands about {:.5g} in place of {}", where, s.number, right)
                                  : how == Put::times ? fmt::format("in {} the term {} counts about {:.5g} times", where, right, s.number)
                                                      : fmt::format("in {} about {:.5g} is added to {}", where, s.number, right)));
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  constexpr std::size_t most = 120;
  for (std::size_t k = 0; k < std::min(found.size(), most); ++k) out.push_back(std::move(found[k].second));
}

void add_vector_substitutions(std::vector<Fault>& out, const Probe& probe, const std::vector<float>& known, std::size_t most) {
  const auto shared = std::make_shared<const std::vector<float>>(known);
  const std::vector<std::vector<std::size_t>> vectors = vectors_of(probe), values = vector_values_of(probe);
  std::size_t made = 0;
  for (const std::vector<std::size_t>& use : vectors)
    for (std::int8_t k = 0; k < 3; ++k) {
      const std::int32_t operand = probe.trace.nodes[use[0]].of[static_cast<std::size_t>(k)];
      if (operand < 0 || !is_again(probe.trace.nodes[use[0]].op)) continue;
      const std::string right = words(probe, operand);
      for (const std::vector<std::size_t>& value : values) {
        if (value.size() != use.size()) continue;
        std::vector<Substitution> all;
        bool is_before = true, is_same = true;
        for (std::size_t c = 0; c < use.size(); ++c) {
          const Node& place = probe.trace.nodes[use[c]];
          const Node& source = probe.trace.nodes[value[c]];
          is_before &= value[c] < use[0];
          is_same &= place.of[static_cast<std::size_t>(k)] == static_cast<std::int32_t>(value[c]);
          Substitution& s = all.emplace_back();
          s.shape = place.shape;
          s.operand = k;
          s.source = source.shape;
          // The last one of its shape before the place.
          for (std::size_t m = value[c]; m < use[0]; ++m) s.back += probe.trace.nodes[m].shape == source.shape;
        }
        if (!is_before || is_same || ++made > most) continue;
        const std::string wrong = words(probe, static_cast<std::int32_t>(value[0]));
        if (wrong == right || wrong == "...") continue;
        Fault d = fault_of(all[0], shared, fmt::format("wrong value: {} for {}, in all components", wrong, right),
                           fmt::format("in {} stands {} where {} is meant, and so in the other components",
                                       words(probe, static_cast<std::int32_t>(use[0])), wrong, right));
        d.substitutions = std::move(all);
        out.push_back(std::move(d));
      }
    }
}

}  // namespace rainref::faults
