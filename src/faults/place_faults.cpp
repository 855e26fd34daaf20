#include "faults/place_faults.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace rainref::faults {
namespace {

using perturbed::Op;
using perturbed::PlaceFault;
using perturbed::Trace;
using Node = Trace::Node;

struct Words {
  PlaceFault fault;
  std::string name, sentence;
};

std::string shortened(const Probe& p, std::int32_t node) {
  for (int depth = 3; depth > 0; --depth)
    if (const std::string text = p.text(node, depth); text.size() <= 60 && (depth > 1 || text.find_first_not_of(".+-*/ ()") != text.npos))
      return text;
  // A text of dots alone says nothing: then the beginning of a longer one.
  std::string text = p.text(node, 1);
  for (int depth = 2; depth <= 4 && std::none_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c); }); ++depth)
    text = p.text(node, depth);
  return text.size() <= 80 ? text : fmt::format("{:.77}...", text);
}

/// The input that a lookup's coordinate leads to: the next texel fetched.
std::string image_of(const Probe& p, std::size_t node) {
  for (std::size_t n = node; n < p.trace.nodes.size(); ++n) {
    if (p.trace.nodes[n].op != Op::fetch && p.trace.nodes[n].op != Op::load) continue;
    const std::string& name = p.names[n];
    return name.substr(0, name.find('.'));
  }
  return "a texture";
}

/// `op`: of the place. Which side of a decision is taken is less plain than what is left out.
bool is_multiple(PlaceFault fault, Op op) {
  if (fault == PlaceFault::swapped && (op == Op::choice || op == Op::comparison)) return true;
  switch (fault) {
    case PlaceFault::first_twice:
    case PlaceFault::second_twice:
    case PlaceFault::first_squared:
    case PlaceFault::second_squared:
    case PlaceFault::doubled:
    case PlaceFault::halved:
    case PlaceFault::squared:
    case PlaceFault::rooted:
    case PlaceFault::always:
    case PlaceFault::never:
      return true;
    default:
      return false;
  }
}

/// What is done to a place before it is looked up: both sides of it are wrong together.
bool is_bent(Op op) { return op == Op::floor || op == Op::fract || op == Op::minimum || op == Op::maximum; }

/// Groups of two or three first places of different shapes and one text, each met as often, of the operations that `wanted` says.
template <class Wanted>
std::vector<std::vector<std::size_t>> groups_of(const Probe& p, const Wanted& wanted) {
  std::map<std::pair<Op, std::string>, std::map<std::uint32_t, std::size_t>> by_text;
  std::map<std::pair<Op, std::string>, std::map<std::uint32_t, std::size_t>> by_axis;  // e_u.z and e_v.z
  std::map<std::pair<Op, std::string>, std::map<std::uint32_t, std::size_t>> by_side;
  for (std::size_t at = 0; at < p.trace.nodes.size(); ++at) {
    const Node& n = p.trace.nodes[at];
    if (!wanted(n.op) || n.occurrence != 0) continue;
    const std::string text = p.text(static_cast<std::int32_t>(at), 3);
    if (text == "...") continue;
    by_text[{n.op, of_any_component(with_columns(text))}][n.shape] = at;
    by_axis[{n.op, "axis " + of_any_component(text, 'u', 'v')}][n.shape] = at;
    // What lies on both sides of something: x - shift and x + shift.
    std::string both = text;
    for (std::size_t k = both.find(" - "); k != std::string::npos; k = both.find(" - ", k)) both[k + 1] = '+';
    if (is_bent(n.op)) by_side[{n.op, "side " + both}][n.shape] = at;
  }
  by_text.merge(by_axis);
  by_text.merge(by_side);
  std::vector<std::vector<std::size_t>> out;
  for (const auto& [text, places] : by_text) {
    if (places.size() < 2 || places.size() > 3) continue;
    std::vector<std::size_t> vector;
    for (const auto& [shape, at] : places) vector.push_back(at);
    std::sort(vector.begin(), vector.end());
    const auto count = [&](std::size_t at) { return p.trace.met.at(p.trace.nodes[at].shape); };
    if (std::all_of(vector.begin(), vector.end(), [&](std::size_t at) { return count(at) == count(vector[0]); }))
      out.push_back(std::move(vector));
  }
  // From the results to what they are made of.
  std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a[0] > b[0]; });
  return out;
}

/// The components that a refraction or reflection is given, and those that it gives, which stand side by side whatever they are made of.
std::vector<std::vector<std::size_t>> arguments_of(const Probe& p) {
  std::vector<std::vector<std::size_t>> out;
  const std::vector<Node>& nodes = p.trace.nodes;
  const auto is_one = [&](std::size_t at) { return nodes[at].op == Op::argument || nodes[at].op == Op::bent; };
  for (std::size_t at = 0; at + 2 < nodes.size(); ++at) {
    if (!is_one(at) || nodes[at + 1].op != nodes[at].op || nodes[at + 2].op != nodes[at].op) continue;
    out.push_back({at, at + 1, at + 2});
    at += 2;
  }
  return out;
}

}  // namespace

std::string with_columns(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t n = text.compare(at, 14, "(column + 0.5)") == 0 ? 14
                          : text.compare(at, 12, "column + 0.5") == 0 ? 12
                          : text.compare(at, 6, "column") == 0        ? 6
                          : text.compare(at, 3, "row") == 0           ? 3
                                                                      : 0;
    out.push_back(n > 0 ? 'x' : text[at]);
    at += n > 0 ? n : 1;
  }
  return out;
}
std::string of_any_component(std::string text, char first, char last) {
  const auto is_part = [&](std::size_t at) { return at < text.size() && std::isalnum(static_cast<unsigned char>(text[at])); };
  for (std::size_t at = 0; at < text.size(); ++at)
    if (text[at] >= first && text[at] <= last && !(at > 0 && is_part(at - 1)) && !is_part(at + 1)) text[at] = first;
  return text;
}

std::vector<std::vector<std::size_t>> vectors_of(const Probe& p) {
  std::vector<std::vector<std::size_t>> out = arguments_of(p);
  for (std::vector<std::size_t>& v : groups_of(p, [](Op op) {
         return op == Op::floor || op == Op::fract || op == Op::sum || op == Op::difference || op == Op::product || op == Op::quotient ||
                op == Op::minimum || op == Op::maximum || op == Op::mix || op == Op::negation || op == Op::choice;
       }))
    out.push_back(std::move(v));
  return out;
}
std::vector<std::vector<std::size_t>> vector_values_of(const Probe& p) {
  return groups_of(p, [](Op op) { return op != Op::comparison && op != Op::lookup; });
}

namespace {

/// What a mistake makes of a node, in words.
std::vector<Words> words_of(const Probe& p, std::size_t at) {
  const Node& n = p.trace.nodes[at];
  const std::string all = shortened(p, static_cast<std::int32_t>(at)), a = shortened(p, n.of[0]), b = shortened(p, n.of[1]);
  const bool same = a == b && a != "...";
  std::vector<Words> out;
  const auto add = [&](PlaceFault fault, std::string name, std::string sentence) {
    out.push_back({fault, std::move(name), std::move(sentence)});
  };
  switch (n.op) {
    case Op::sum:
    case Op::difference:
      add(PlaceFault::first, "term left out: " + b, fmt::format("of {} the term {} is left out", all, b));
      add(PlaceFault::second, "term left out: " + a, fmt::format("of {} the term {} is left out", all, a));
      add(PlaceFault::second_negated, "sign of a term: " + b, fmt::format("in {} the term {} has the other sign", all, b));
      add(PlaceFault::swapped, n.op == Op::sum ? "sign of a term: " + a : "difference the other way: " + all,
          n.op == Op::sum ? fmt::format("in {} the term {} has the other sign", all, a) : fmt::format("{} is taken the other way", all));
      if (n.op == Op::sum) {
        add(PlaceFault::larger, "max for sum: " + all, fmt::format("the larger one of {} and {} stands in place of their sum", a, b));
        add(PlaceFault::smaller, "min for sum: " + all, fmt::format("the smaller one of {} and {} stands in place of their sum", a, b));
      }
      add(PlaceFault::first_twice, "term twice: " + a, fmt::format("in {} the term {} counts twice", all, a));
      add(PlaceFault::second_twice, "term twice: " + b, fmt::format("in {} the term {} counts twice", all, b));
      if (n.op == Op::difference) add(PlaceFault::other, "complement left out: " + all, fmt::format("for {} stands {}", all, b));
      add(PlaceFault::rooted, "root for square: " + all,
          fmt::format("the square root of {} is taken in place of it: a length for its square", all));
      break;
    case Op::product:
      if (same) {
        add(PlaceFault::first, "not squared: " + a, fmt::format("{} is taken for its square", a));
      } else {
        add(PlaceFault::first, "factor left out: " + b, fmt::format("of {} the factor {} is left out", all, b));
        add(PlaceFault::second, "factor left out: " + a, fmt::format("of {} the factor {} is left out", all, a));
        add(PlaceFault::first_squared, "factor twice: " + a, fmt::format("in {} the factor {} is taken twice, or squared", all, a));
        add(PlaceFault::second_squared, "factor twice: " + b, fmt::format("in {} the factor {} is taken twice, or squared", all, b));
        add(PlaceFault::inverted, "divided for multiplied: " + all, fmt::format("in {} is divided by {}", all, b));
      }
      add(PlaceFault::squared, "squared: " + all, fmt::format("{} is squared", all));
      add(PlaceFault::negated, "sign of a product: " + all, fmt::format("{} has the other sign", all));
      add(PlaceFault::doubled, "twice as large: " + all, fmt::format("{} is twice as large: a diameter for a radius, a factor 2", all));
      add(PlaceFault::halved, "half as large: " + all, fmt::format("{} is half as large: a radius for a diameter, a factor 1/2", all));
      break;
    case Op::quotient:
      add(PlaceFault::first, "division left out: by " + b, fmt::format("{} is not divided by {}", a, b));
      add(PlaceFault::swapped, "quotient upside down: " + all, fmt::format("{} is taken upside down", all));
      add(PlaceFault::inverted, "multiplied for divided: " + all, fmt::format("{} is multiplied by {}", a, b));
      break;
    case Op::negation:
      add(PlaceFault::first, "sign of a term: " + a, fmt::format("{} has the other sign", a));
      break;
    case Op::minimum:
    case Op::maximum: {
      const char* const name = n.op == Op::minimum ? "min" : "max";
      add(PlaceFault::first, fmt::format("{} left out: {}", name, all), fmt::format("for {} stands {}", all, a));
      add(PlaceFault::second, fmt::format("{} left out: {}", name, all), fmt::format("for {} stands {}", all, b));
      add(PlaceFault::other, fmt::format("{} for {}: {}", n.op == Op::minimum ? "max" : "min", name, all),
          fmt::format("{} is taken the other way", all));
      add(PlaceFault::added, fmt::format("sum for {}: {}", name, all), fmt::format("{} and {} are added in place of their {}", a, b, name));
      if (n.op == Op::maximum)
        add(PlaceFault::saturated, fmt::format("sum for max: {}", all),
            fmt::format("{} and {} are added, and held to [0, 1], in place of their max", a, b));
      break;
    }
    case Op::magnitude:
      add(PlaceFault::first, "abs left out: " + a, fmt::format("the sign of {} is kept", a));
      break;
    case Op::root:
      add(PlaceFault::first, "root left out: " + all, fmt::format("{} is taken without the root", all));
      add(PlaceFault::doubled, "twice as large: " + all, fmt::format("{} is twice as large: a diameter for a radius", all));
      add(PlaceFault::halved, "half as large: " + all, fmt::format("{} is half as large: a radius for a diameter", all));
      break;
    case Op::square:
      add(PlaceFault::first, "not squared: " + a, fmt::format("{} is taken for its square", a));
      add(PlaceFault::other, "cube for square: " + a, fmt::format("{} is cubed", a));
      add(PlaceFault::squared, "squared twice: " + a, fmt::format("{} is squared twice", a));
      break;
    case Op::floor:
      add(PlaceFault::first, "floor left out: " + a, fmt::format("{} is not rounded down", a));
      add(PlaceFault::other, "rounding for floor: " + a, fmt::format("{} is rounded to nearest", a));
      break;
    case Op::fract:
      add(PlaceFault::first, "fract left out: " + a, fmt::format("{} keeps its whole part", a));
      break;
    case Op::exponential:
    case Op::exponential2:
      add(PlaceFault::other, n.op == Op::exponential ? "exp2 for exp: " + all : "exp for exp2: " + all,
          fmt::format("the base of {} is another", all));
      add(PlaceFault::first, "exponential left out: " + all, fmt::format("for {} stands {}", all, a));
      add(PlaceFault::linear, "linear for an exponential: " + all, fmt::format("for {} stands 1 + {}", all, a));
      break;
    case Op::power:
      add(PlaceFault::first, "power left out: " + all, fmt::format("for {} stands {}", all, a));
      add(PlaceFault::inverted, "exponent inverted: " + all, fmt::format("the exponent of {} is 1 over what it should be", all));
      break;
    case Op::sine:
    case Op::cosine:
      add(PlaceFault::other, n.op == Op::sine ? "cosine for sine: " + all : "sine for cosine: " + all,
          "the angle is measured from the other axis");
      add(PlaceFault::negated, "sign of a term: " + all, fmt::format("{} has the other sign", all));
      break;
    case Op::angle:
      add(PlaceFault::swapped, "atan2 arguments swapped: " + all, fmt::format("{} gets (x, y)", all));
      break;
    case Op::mix:
      add(PlaceFault::swapped, "mix ends swapped: " + all, fmt::format("the ends of {} are exchanged", all));
      add(PlaceFault::first, "mix left out: " + all, fmt::format("for {} stands {}", all, a));
      add(PlaceFault::second, "mix left out: " + all, fmt::format("for {} stands {}", all, b));
      add(PlaceFault::premultiplied, "added whole: " + b,
          fmt::format("in {} {} is added whole, where it should be multiplied by the weight: as if it were premultiplied", all, b));
      add(PlaceFault::added, "added for mixed: " + all, fmt::format("in {} the second is added to the first", all));
      add(PlaceFault::in_gamma, "blended in gamma space: " + all, fmt::format("{} mixes numbers encoded by a power of 1/2.2", all));
      break;
    case Op::smoothstep:
      add(PlaceFault::swapped, "smoothstep's edges swapped: " + all, fmt::format("the edges of {} are exchanged", all));
      add(PlaceFault::other, "linear for smoothstep: " + all, fmt::format("{} is a linear ramp", all));
      break;
    case Op::choice:
      add(PlaceFault::first, "choice left out: " + all,
          fmt::format("{} stands everywhere, where it should where a condition holds; else {}", a, b));
      add(PlaceFault::second, "choice left out: " + all,
          fmt::format("{} stands everywhere, where it should unless a condition holds; then {}", b, a));
      add(PlaceFault::swapped, "select the other way: " + all, fmt::format("of {} the other side is taken", all));
      break;
    case Op::comparison:
      add(PlaceFault::swapped, fmt::format("condition the other way: {} < {}", a, b), fmt::format("{} < {} is taken the other way", a, b));
      add(PlaceFault::always, fmt::format("condition left out: {} < {}", a, b), fmt::format("{} < {} is taken to hold everywhere", a, b));
      add(PlaceFault::never, fmt::format("condition never holds: {} < {}", a, b), fmt::format("{} < {} is taken to hold nowhere", a, b));
      break;
    case Op::coordinate: {
      const std::string image = image_of(p, at);
      add(PlaceFault::nearest, "nearest for linear: " + image, fmt::format("a lookup of {} takes the nearest texel", image));
      add(PlaceFault::half_less, "half a texel off: " + image, fmt::format("a lookup of {} lies half a texel too low", image));
      add(PlaceFault::half_more, "half a texel off: " + image, fmt::format("a lookup of {} lies half a texel too high", image));
      add(PlaceFault::one_less, "one texel off: " + image, fmt::format("a lookup of {} lies one texel too low", image));
      add(PlaceFault::one_more, "one texel off: " + image, fmt::format("a lookup of {} lies one texel too high", image));
      break;
    }
    case Op::level: {
      const std::string image = image_of(p, at);
      add(PlaceFault::one_more, "mip level above: " + image, fmt::format("a lookup of {} takes one level too coarse", image));
      add(PlaceFault::one_less, "mip level below: " + image, fmt::format("a lookup of {} takes one level too fine", image));
      add(PlaceFault::zero, "mip level 0: " + image, fmt::format("a lookup of {} takes level 0", image));
      break;
    }
    case Op::argument:
      add(PlaceFault::negated, "sign of an argument: " + all,
          fmt::format("{} has the other sign where a refraction or reflection takes it", all));
      break;
    case Op::bent:
      add(PlaceFault::second, "refraction left out: " + b, fmt::format("the ray {} goes on straight where it should be refracted", b));
      break;
    case Op::lookup:
      add(PlaceFault::zero, "lookup left out: " + a, fmt::format("{} counts as 0", all));
      break;
    default:
      break;
  }
  return out;
}

}  // namespace

void add_place_faults(std::vector<Fault>& out, const std::vector<Probe>& probes, const std::vector<float>& known, PlaceKind kind) {
  const auto shared = std::make_shared<const std::vector<float>>(known);
  const auto add = [&](const Words& w, std::array<perturbed::Place, 4> places, std::string remark) {
    Fault d;
    d.name = w.name;
    if (remark.starts_with(", and so")) d.name.append(remark.ends_with("s") ? ", in all components" : ", in both components");
    d.sentence = w.sentence + remark;
    d.behaviour.places = places;
    d.at_texel = [shared](Texel, perturbed::Behaviour& b, std::vector<float>&) { b.known = shared.get(); };
    d.for_diagnosis = true;
    out.push_back(std::move(d));
  };
  constexpr std::int32_t most = 6;  // of one shape that are tried one by one: components, neighbours
  std::set<std::pair<std::uint32_t, std::int32_t>> done;
  for (const Probe& p : probes) {
    // The components of a vector stand at two places or three; a mistake in the vector is made at each.
    for (const std::vector<std::size_t>& at : kind == PlaceKind::plain ? vectors_of(p) : std::vector<std::vector<std::size_t>>()) {
      std::array<perturbed::Place, 4> places{};
      std::uint32_t key = 0;
      std::vector<std::vector<Words>> words;
      for (std::size_t k = 0; k < at.size(); ++k) {
        const Node& n = p.trace.nodes[at[k]];
        places[k].shape = n.shape;
        // Of the arguments of one call each is a place of its own.
        if ((n.op == Op::argument || n.op == Op::bent) && p.trace.met.at(n.shape) > 1) places[k].occurrence = n.occurrence;
        key = (key * 5 ^ n.shape) + static_cast<std::uint32_t>(places[k].occurrence + 1);
        words.push_back(words_of(p, at[k]));
      }
      if (!done.insert({key, 0}).second) continue;
      for (std::size_t w = 0; w < words[0].size(); ++w) {
        const PlaceFault fault = words[0][w].fault;
        const bool is_of_all = std::all_of(words.begin(), words.end(), [&](const auto& o) { return o.size() > w && o[w].fault == fault; });
        if (!is_of_all || is_multiple(fault, p.trace.nodes[at[0]].op)) continue;
        for (std::size_t k = 0; k < at.size(); ++k) places[k].fault = fault;
        add(words[0][w], places, at.size() == 2 ? ", and so in the other component" : ", and so in the other components");
      }
    }
    // From the results to what they are made of: a whole term left out is a plainer mistake than one in its depths.
    for (std::size_t at = p.trace.nodes.size(); at-- > 0;) {
      const Node& n = p.trace.nodes[at];
      const std::int32_t count = p.trace.met.at(n.shape);
      for (const std::int32_t occurrence : {-1, n.occurrence}) {
        if (occurrence >= 0 && (count == 1 || count > most)) continue;
        if (!done.insert({n.shape, occurrence}).second) continue;
        for (const Words& w : words_of(p, at))
          if ((kind == PlaceKind::multiple) == is_multiple(w.fault, n.op))
            add(w, {perturbed::Place{n.shape, occurrence, w.fault}},
                occurrence < 0 ? "" : fmt::format(" (one of {} alike, number {})", count, occurrence + 1));
      }
      if (n.op != Op::lookup || kind == PlaceKind::multiple) continue;
      // Both coordinates of a lookup: fx and fy of a blend are what a coordinate has beyond its floor.
      const auto coordinate_of = [&](std::int32_t fraction) -> std::int32_t {
        if (fraction < 0) return -1;
        const std::int32_t from = p.trace.nodes[static_cast<std::size_t>(fraction)].of[0];
        return from >= 0 && p.trace.nodes[static_cast<std::size_t>(from)].op == Op::coordinate ? from : -1;
      };
      const std::int32_t x = coordinate_of(n.of[0]), y = coordinate_of(n.of[1]);
      if (x < 0 || y < 0) continue;
      const Node &u = p.trace.nodes[static_cast<std::size_t>(x)], &v = p.trace.nodes[static_cast<std::size_t>(y)];
      if (!done.insert({u.shape ^ v.shape * 3, u.occurrence}).second) continue;
      for (const Words& w : words_of(p, static_cast<std::size_t>(x)))
        add(w, {perturbed::Place{u.shape, u.occurrence, w.fault}, perturbed::Place{v.shape, v.occurrence, w.fault}}, ", in u and v");
    }
  }
}

std::vector<SharedPlace> shared_places_of(const std::vector<Probe>& probes) {
  // What is of one operation and two numbers looks alike everywhere.
  const auto is_telling = [&](const Node& n, std::int8_t depth) {
    switch (n.op) {
      case Op::constant:
      case Op::load:
      case Op::fetch:
      case Op::index:
      case Op::lookup:
      case Op::comparison:
      case Op::coordinate:
      case Op::level:
        return false;
      case Op::sum:
      case Op::difference:
      case Op::product:
      case Op::quotient:
      case Op::negation:
      case Op::argument:
      case Op::bent:
        return depth > 1;
      default:
        return true;
    }
  };
  // Of these a call may be one that no probe makes.
  const auto is_rare = [](Op op) {
    return op == Op::angle || op == Op::power || op == Op::mix || op == Op::smoothstep || op == Op::sine || op == Op::cosine ||
           op == Op::exponential || op == Op::fract;
  };
  constexpr std::size_t most_shapes = 12, most = 70;
  std::vector<SharedPlace> out;
  std::set<std::set<std::uint32_t>> done;
  for (const std::int8_t depth : {std::int8_t{2}, std::int8_t{1}}) {
    struct Class {
      std::size_t probe;
      std::int32_t node;
      std::set<std::uint32_t> shapes = {};
    };
    std::map<std::uint32_t, Class> classes;
    // Invocations that take another way call the same functions with other arguments.
    for (std::size_t k = 0; k < probes.size(); ++k)
      for (std::int32_t at = 0; at < static_cast<std::int32_t>(probes[k].trace.nodes.size()); ++at) {
        const Node& n = probes[k].trace.nodes[static_cast<std::size_t>(at)];
        if (n.occurrence != 0 || !is_telling(n, depth)) continue;
        Class& one = classes.try_emplace(n.shallow[static_cast<std::size_t>(depth - 1)], Class{k, at}).first->second;
        if (one.probe == k) one.node = at;
        one.shapes.insert(n.shape);
      }
    std::vector<SharedPlace> found;
    for (const auto& [shape, one] : classes)
      if (one.shapes.size() >= (is_rare(probes[one.probe].trace.nodes[static_cast<std::size_t>(one.node)].op) ? 1u : 2u) &&
          one.shapes.size() <= most_shapes && done.insert(one.shapes).second)
        found.push_back({one.probe, one.node, depth, one.shapes.size()});
    std::sort(found.begin(), found.end(),
              [](const SharedPlace& a, const SharedPlace& b) { return a.probe != b.probe ? a.probe < b.probe : a.node > b.node; });
    out.insert(out.end(), found.begin(), found.end());
  }
  if (out.size() > most) out.resize(most);
  return out;
}

std::string words_for_all(const SharedPlace& place) {
  return place.shapes > 1
             ? fmt::format(", and so in all {} places that are made alike: a function that is called several times", place.shapes)
             : ", wherever it is made alike: a function that is called several times";
}

void add_shared_place_faults(std::vector<Fault>& out, const std::vector<Probe>& probes, const std::vector<float>& known) {
  const auto shared = std::make_shared<const std::vector<float>>(known);
  for (const SharedPlace& place : shared_places_of(probes)) {
    const Probe& p = probes[place.probe];
    const Node& n = p.trace.nodes[static_cast<std::size_t>(place.node)];
    for (const Words& w : words_of(p, static_cast<std::size_t>(place.node))) {
      Fault d;
      d.name = w.name + ", in each such place";
      d.sentence =
          fmt::format("{}, and so in all {} places that are made alike: a function that is called several times", w.sentence, place.shapes);
      d.behaviour.places[0] = {n.shallow[static_cast<std::size_t>(place.depth - 1)], -1, w.fault, 0, place.depth};
      d.at_texel = [shared](Texel, perturbed::Behaviour& b, std::vector<float>&) { b.known = shared.get(); };
      d.for_diagnosis = true;
      d.is_one_of_many = true;
      out.push_back(std::move(d));
    }
  }
}

}  // namespace rainref::faults
