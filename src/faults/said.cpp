// What the search calls what it found.
#include <fmt/format.h>

#include "faults/targets.h"

namespace rainref::faults {
namespace {

using perturbed::Change;
using perturbed::Op;
using perturbed::Put;

/// Whether a node is a factor of another, through products alone; `of` a term, through sums.
bool is_part(const Probe& p, std::int32_t whole, std::int32_t part, bool is_factor, int depth = 3) {
  if (whole < 0 || depth < 0) return false;
  if (whole == part) return true;
  const Op op = node_of(p, whole).op;
  if (is_factor ? op != Op::product && op != Op::negation : op != Op::sum && op != Op::difference) return false;
  return is_part(p, node_of(p, whole).of[0], part, is_factor, depth - 1) || is_part(p, node_of(p, whole).of[1], part, is_factor, depth - 1);
}

}  // namespace

namespace {

std::string short_text(const Probe& p, std::int32_t node) {
  for (int depth = 3; depth > 0; --depth)
    if (std::string text = p.text(node, depth); text.size() <= 60) return text;
  return p.text(node, 1).substr(0, 77);
}

}  // namespace

std::string words_for(const Probe& p, std::int32_t node) {
  if (node < 0) return short_text(p, node);
  p.words.resize(p.trace.nodes.size());
  std::string& words = p.words[static_cast<std::size_t>(node)];
  if (words.empty()) words = short_text(p, node);
  return words;
}
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
    case Change::floored:
      return fmt::format("floor({})", text);
    case Change::rounded:
      return fmt::format("round({})", text);
    case Change::truncated:
      return fmt::format("trunc({})", text);
    case Change::fraction:
      return fmt::format("fract({})", text);
    case Change::saturated:
      return fmt::format("saturate({})", text);
    case Change::as_half:
      return fmt::format("{} in half precision", one);
    case Change::as_code:
      return fmt::format("{} in 8 bits", one);
    case Change::cubed:
      return fmt::format("{} cubed", one);
    case Change::smoothed:
      return fmt::format("the cubic smoothstep of {}", one);
  }
  return text;
}

Said said(const Probe& p, const Target& t, const Source& s, Put how, Change change) {
  const std::int32_t value = t.value_at(p, 0);
  const std::string right = words_for(p, value), wrong = changed_words(change, s.text),
                    where = t.operand < 0 ? fmt::format("for {}", right) : fmt::format("in {}", words_for(p, t.nodes[0]));
  const bool is_itself = s.nodes.size() == t.nodes.size() && !s.nodes.empty() && s.nodes[0] == value;
  const std::int32_t source = s.nodes.empty() ? -1 : s.nodes[0];
  if (is_itself && how == Put::instead) {
    switch (change) {
      case Change::floored:
      case Change::rounded:
      case Change::truncated:
        return {fmt::format("rounded: {}", wrong), fmt::format("{} {} stands: it is cut or rounded to a whole number", where, wrong)};
      case Change::as_half:
      case Change::as_code:
        return {fmt::format("precision: {}", wrong), fmt::format("{} {} is rounded: {}", where, right, wrong)};
      case Change::saturated:
        return {fmt::format("clamp too many: {}", right), fmt::format("{} {} is held to [0, 1]", where, right)};
      default:
        break;
    }
  }
  if (source >= 0 && source != value && change == Change::none && s.nodes.size() == 1) {
    if (how == Put::divided_by && is_part(p, value, source, true))
      return {"factor too many: 1 / " + wrong, fmt::format("of {} the factor {} is left out", right, wrong)};
    if (how == Put::minus && is_part(p, value, source, false))
      return {"term too many: -" + wrong, fmt::format("of {} the term {} is left out", right, wrong)};
  }
  const std::string closed = wrong.find(' ') != std::string::npos ? "(" + wrong + ")" : wrong;
  switch (how) {
    case Put::instead:
      if (wrong == right)
        return {"wrong texel: " + right, fmt::format("{} the texel {} is read elsewhere: at another neighbour", where, right)};
      return {fmt::format("wrong value: {} for {}", wrong, right), fmt::format("{} stands {} where {} is meant", where, wrong, right)};
    case Put::times:
    case Put::divided_by:
      return {fmt::format("factor too many: {}", how == Put::times ? wrong : "1 / " + closed),
              fmt::format("{} the term {} is {} {}", where, right, how == Put::times ? "multiplied by" : "divided by", wrong)};
    case Put::plus:
    case Put::minus:
      return {fmt::format("term too many: {}{}", how == Put::plus ? "" : "-", wrong),
              fmt::format("{} {} is {} {}", where, wrong, how == Put::plus ? "added to" : "subtracted from", right)};
    case Put::from:
      return {fmt::format("wrong value: {} - {}", wrong, right),
              fmt::format("{} stands {} - ({}) in place of {}", where, wrong, right, right)};
    case Put::over:
      return {fmt::format("wrong value: {} / {}", wrong, right),
              fmt::format("{} stands {} / ({}) in place of {}", where, wrong, right, right)};
    case Put::larger:
    case Put::smaller:
      return {fmt::format("{} too many: {}", how == Put::larger ? "max" : "min", wrong),
              fmt::format("{} {} of {} and {} stands in place of {}", where, how == Put::larger ? "max" : "min", right, wrong, right)};
  }
  return {};
}

}  // namespace rainref::faults
