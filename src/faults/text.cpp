#include "faults/text.h"

#include <algorithm>
#include <cctype>
#include <utility>
#include <string_view>

#include <fmt/format.h>

#include "base/number_text.h"
#include "faults/targets.h"

namespace rainref::faults {

using perturbed::Change;
using perturbed::Op;
using Step = perturbed::FormulaStep::Kind;
using Node = perturbed::Trace::Node;

namespace {

constexpr auto npos = std::string::npos;
constexpr const char *signs_alone = ".<+-*/ ()", *digits = "0123456789.-e";

/// "min", "sqrt", ...; "" if it is not written as a function.
const char* function_of(Op op) {
  constexpr std::pair<Op, const char*> names[] = {
      {Op::minimum, "min"}, {Op::maximum, "max"}, {Op::exponential2, "exp2"}, {Op::logarithm, "log"},         {Op::sine, "sin"},
      {Op::cosine, "cos"},  {Op::angle, "atan2"}, {Op::mix, "mix"},           {Op::smoothstep, "smoothstep"}, {Op::choice, "select"}};
  for (const auto& [one, name] : names)
    if (one == op) return name;
  return bend_name(op);
}
/// " + ", " * ", ... with spaces; "" if it is not an infix operator.
const char* sign_of(Op op) {
  return op == Op::sum ? " + " : op == Op::difference ? " - " : op == Op::product ? " * " : op == Op::quotient ? " / " : "";
}

std::string short_text(const Probe& p, std::int32_t node) {
  for (int depth = 3; depth > 0; --depth)
    if (std::string text = p.text(node, depth); text.size() <= 60) return text;
  return p.text(node, 1).substr(0, 77);
}

std::string text_so_deep(const Probe& p, const Expression& e, int depth) {
  if (!e.is_operation()) {
    if (e.step.kind == Step::number && e.node < 0) return fmt::format("{:.6g}", e.step.number);
    return e.node < 0 ? "..." : p.text(e.node, std::max(depth, 1));
  }
  if (depth == 0) return "...";
  const Op op = e.step.op;
  if (op == Op::negation) return "-" + text_so_deep(p, e.of[0], depth);
  if (op == Op::comparison) return text_so_deep(p, e.of[0], depth - 1) + " < " + text_so_deep(p, e.of[1], depth - 1);
  if (const char* sign = sign_of(op); *sign) {
    const auto side = [&](const Expression& of) {
      const std::string text = text_so_deep(p, of, depth - 1);
      return text.find(' ') != npos && text.back() != ')' ? fmt::format("({})", text) : text;
    };
    const std::string a = side(e.of[0]), b = side(e.of[1]);
    const auto apart = [&](const Expression& of, const std::string& text) {
      const bool is_sum = *sign_of(of.is_operation() ? of.step.op : of.node >= 0 ? node_of(p, of.node).op : Op::constant);
      return is_sum && text.front() != '(' && text.find(' ') != npos ? fmt::format("({})", text) : text;
    };
    return apart(e.of[0], a) + sign + apart(e.of[1], b);
  }
  if (!*function_of(op)) return text_so_deep(p, e.of[0], depth);
  std::string out = std::string(function_of(op)) + "(";
  for (std::size_t k = 0; k < e.of.size(); ++k) out += (k == 0 ? "" : ", ") + text_so_deep(p, e.of[k], depth - 1);
  return out + ")";
}

}  // namespace

bool Probe::is_of_column(const Node& n) const {
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
  // Depth decreases with each choice too: the steps of a march choose between each other, which would double the text with each step.
  if (n.op == Op::choice) return fmt::format("{} or {}", text(n.of[0], depth - 1), text(n.of[1], depth - 1));
  if (n.op == Op::negation) return "-" + text(n.of[0], depth);
  // The pixel's centre counts as deep as its row, which is one number.
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

std::string words_for(const Probe& p, std::int32_t node) {
  if (node < 0) return short_text(p, node);
  p.words.resize(p.trace.nodes.size());
  std::string& words = p.words[static_cast<std::size_t>(node)];
  if (words.empty()) words = short_text(p, node);
  return words;
}
std::string shortened(const Probe& p, std::int32_t node) {
  for (int depth = 3; depth > 0; --depth)
    if (const std::string text = p.text(node, depth); text.size() <= 60 && (depth > 1 || !says_nothing(text))) return text;
  // A text of dots alone is not informative: then the beginning of a longer one.
  std::string text = p.text(node, 1);
  for (int depth = 2; depth <= 4 && std::none_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c); }); ++depth)
    text = p.text(node, depth);
  return text.size() <= 80 ? text : fmt::format("{:.77}...", text);
}
std::string text_of(const Probe& p, const Expression& e) {
  for (int depth = 4; depth > 1; --depth)
    if (std::string text = text_so_deep(p, e, depth); text.size() <= 80) return text;
  return text_so_deep(p, e, 1).substr(0, 80);
}
std::string closed(const std::string& text) { return text.find(' ') != npos ? fmt::format("({})", text) : text; }
std::string changed_text(Change change, const std::string& text) {
  const std::string one = closed(text);
  constexpr std::pair<Change, const char*> functions[] = {
      {Change::magnitude, "abs"}, {Change::squared, "square"},  {Change::rooted, "sqrt"},    {Change::floored, "floor"},
      {Change::rounded, "round"}, {Change::truncated, "trunc"}, {Change::fraction, "fract"}, {Change::saturated, "saturate"}};
  for (const auto& [one_of, name] : functions)
    if (one_of == change) return fmt::format("{}({})", name, text);
  return change == Change::negated    ? "-" + one
         : change == Change::from_one ? "1 - " + one
         : change == Change::inverted ? "1 / " + one
         : change == Change::doubled  ? "2 * " + one
         : change == Change::halved   ? "0.5 * " + one
         : change == Change::cubed    ? one + " cubed"
         : change == Change::smoothed ? "the cubic smoothstep of " + one
                                      : text;
}

const char* bend_name(Op op) {
  return op == Op::floor         ? "floor"
         : op == Op::fract       ? "fract"
         : op == Op::magnitude   ? "abs"
         : op == Op::root        ? "sqrt"
         : op == Op::square      ? "square"
         : op == Op::power       ? "pow"
         : op == Op::exponential ? "exp"
                                 : "";
}
std::string function_text(const Probe& p, const Node& n) {
  if (n.op == Op::minimum || n.op == Op::maximum) return fmt::format("{} with {}", function_of(n.op), words_for(p, n.of[1]));
  return function_of(n.op);
}
const char* verb_of(Op op) {
  return op == Op::quotient     ? "divides"
         : op == Op::product    ? "multiplies"
         : op == Op::sum        ? "is added to"
         : op == Op::difference ? "is taken from"
                                : "bounds";
}
std::string offset_text(int dx, int dy) { return dx == 0 && dy == 0 ? "the texel itself" : fmt::format("({}, {})", dx, dy); }

int gaps(const std::string& text) {
  int out = 0;
  for (std::size_t at = text.find("..."); at != npos; at = text.find("...", at + 3)) ++out;
  return out;
}
bool says_nothing(const std::string& text) { return text.find_first_not_of(signs_alone) == npos; }
bool has_brackets(const std::string& text) { return text.find('(') != npos; }
bool offers_choice(const std::string& text) { return text.find(" or ") != npos; }
bool has_fraction(const std::string& text) { return text.find("- floor(") != npos; }
bool names_component_before_gap(const std::string& text) { return text.find("...") != npos && text.find('.') != text.find("..."); }
std::string first_name(const std::string& text) { return text.substr(0, text.find_first_of(".,")); }
std::string first_word(const std::string& text) { return text.substr(0, text.find(' ')); }

int mip_level(const std::string& case_id) {
  const std::size_t dot = case_id.rfind(".L");
  return dot == npos ? -1 : whole_from<int>(std::string_view(case_id).substr(dot + 2)).value_or(-1);
}

bool is_number(const std::string& name) { return !name.empty() && name.find_first_not_of(digits) == npos; }
bool is_of_list(const std::string& name) { return name.find(" of ") != npos; }
bool is_made(const std::string& name) { return name.starts_with("f("); }
std::string made_of_too(const std::string& name, const std::string& other) {
  std::string out = is_made(name) ? name : "f(" + name + ")";
  return out.insert(out.size() - 1, ", " + other);
}
bool names_member(const std::string& name, const std::string& member) {
  const std::size_t at = name.find(member), end = at + member.size();
  return at != npos && (end == name.size() || name[end] == '.' || name[end] == ')');
}
std::string image_of_channel(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return dot + 2 == name.size() ? name.substr(0, dot) : std::string();
}
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
std::string of_any_axis(const std::string& text) {
  std::string out = of_any_component(with_columns(text), 'u', 'z');
  std::erase(out, '-');  // a rotated vector has another sign in one component
  return out;
}
std::string of_either_side(std::string text) {
  for (std::size_t k = text.find(" - "); k != npos; k = text.find(" - ", k)) text[k + 1] = '+';
  return text;
}

}  // namespace rainref::faults
