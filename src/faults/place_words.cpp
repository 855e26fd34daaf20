#include "faults/place_words.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include <fmt/format.h>

namespace rainref::faults {
namespace {

using perturbed::Op;
using perturbed::PlaceFault;
using Node = perturbed::Trace::Node;

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

/// Whether a square is a term of a sum of squares, of which hardly anybody forgets one.
bool is_of_length(const Probe& p, std::size_t square) {
  const auto op = [&](std::int32_t i) { return i < 0 ? Op::constant : p.trace.nodes[static_cast<std::size_t>(i)].op; };
  constexpr std::size_t near = 12;
  const std::size_t end = std::min(p.trace.nodes.size(), square + near);
  for (std::size_t n = square + 1; n < end; ++n) {
    const Node& sum = p.trace.nodes[n];
    for (const std::size_t k : {0u, 1u})
      if (sum.op == Op::sum && sum.of[k] == static_cast<std::int32_t>(square))
        return op(sum.of[1 - k]) == Op::square || op(sum.of[1 - k]) == Op::sum;
  }
  return false;
}

}  // namespace

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
      // What is held rather stands alone than what holds it.
      const auto left_out = [&](std::int32_t kept) {
        const bool is_limit = kept >= 0 && p.trace.nodes[static_cast<std::size_t>(kept)].op == Op::constant;
        return is_limit ? fmt::format("limit of {} alone: {}", name, all) : fmt::format("{} left out: {}", name, all);
      };
      add(PlaceFault::first, left_out(n.of[0]), fmt::format("for {} stands {}", all, a));
      add(PlaceFault::second, left_out(n.of[1]), fmt::format("for {} stands {}", all, b));
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
      add(PlaceFault::first, (is_of_length(p, at) ? "not squared in a length: " : "not squared: ") + a,
          fmt::format("{} is taken for its square", a));
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

}  // namespace rainref::faults
