// Finds other values of a literal or uniform that give what a port stored.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "base/number_text.h"
#include "faults/place_faults.h"
#include "faults/solver.h"

namespace rainref::faults {
namespace {

/// A pass with one constant replaced.
struct Replaced {
  const EvaluateWith& evaluate;
  float constant;

  float value(const Wanted& w, std::size_t slot, float replacement) const { return evaluate(w, slot, constant, replacement); }
};

/// The slot in which the port differs most from the reference.
std::size_t farthest_slot(const Wanted& w) {
  std::size_t best = 0;
  double most = -1;
  for (std::size_t s = 0; s < w.port.size(); ++s) {
    const double off = std::abs(static_cast<double>(w.port[s]) - w.reference[s]) / (std::abs(static_cast<double>(w.reference[s])) + 1e-6);
    if (off > most && std::isfinite(w.port[s])) most = off, best = s;
  }
  return best;
}

/// Rounds to `digits` significant digits.
float rounded(float x, int digits) { return number_from<float>(fmt::format("{:.{}g}", x, digits)).value_or(x); }

/// The replacements of a constant that give a texel its wanted value, the nearest to the constant first.
std::vector<float> replacements(const Replaced& pass, const Wanted& w) {
  const float v = pass.constant;
  const std::size_t slot = farthest_slot(w);
  const auto off = [&](float r) { return static_cast<double>(pass.value(w, slot, r)) - w.port[slot]; };
  std::vector<float> tried;
  for (const float f :
       {-4.0f, -2.0f, -1.0f, -0.5f, 0.0f, 0.05f, 0.25f, 0.5f, 0.75f, 0.9f, 0.97f, 1.0f, 1.03f, 1.1f, 1.25f, 1.5f, 2.0f, 3.0f, 4.5f, 10.0f})
    tried.push_back(v == 0 ? f : v * f);
  std::sort(tried.begin(), tried.end());
  std::vector<float> roots;
  double before = off(tried[0]);
  for (std::size_t k = 1; k < tried.size(); ++k) {
    const double now = off(tried[k]);
    if (std::isfinite(before) && std::isfinite(now) && (before < 0) != (now < 0))
      roots.push_back(bisected(tried[k - 1], tried[k], before, 40, off));
    before = now;
  }
  std::sort(roots.begin(), roots.end(), [v](float a, float b) { return std::abs(a - v) < std::abs(b - v); });
  return roots;
}

/// Typing errors of a number: one digit wrong, missing, doubled, or exchanged with the next, or the point moved.
std::vector<float> typed_wrong(float x) {
  const std::string right = fmt::format("{}", x);
  std::vector<float> out;
  const auto add = [&](const std::string& text) {
    if (const std::optional<float> v = number_from<float>(text); v && *v != x && std::isfinite(*v)) out.push_back(*v);
  };
  // Numbers with more digits are not literals of the text, but computed.
  if (std::count(right.begin(), right.end(), 'e') > 0 || right.size() > 9) return out;
  for (std::size_t at = 0; at < right.size(); ++at) {
    if (right[at] < '0' || right[at] > '9') continue;
    for (char digit = '0'; digit <= '9'; ++digit) {
      std::string text = right;
      text[at] = digit;
      add(text);
    }
    add(std::string(right).erase(at, 1));
    add(std::string(right).insert(at, 1, right[at]));
    add(std::string(right).insert(at, 1, '0'));
    if (at + 1 < right.size() && right[at + 1] != '.') {
      std::string text = right;
      std::swap(text[at], text[at + 1]);
      add(text);
    }
  }
  for (const float factor : {10.0f, 0.1f, 100.0f, 0.01f}) add(fmt::format("{:.7g}", x * factor));
  return out;
}

/// Returns the best value for all texels, rounded to few digits if that fits about as well; nothing if none fits.
std::optional<float> fitted(const Replaced& pass, const std::vector<Wanted>& wanted, bool is_literal) {
  // Sum of the errors of all texels, in steps of the store.
  const auto misfit = [&](float r) {
    double sum = 0;
    for (const Wanted& w : wanted) {
      const std::size_t s = farthest_slot(w);
      // Half a step is the store's own rounding.
      sum += std::max(0.0, std::abs(static_cast<double>(pass.value(w, s, r)) - w.port[s]) / std::max(w.step[s], 1e-30f) - 0.5);
    }
    return sum;
  };
  const double without = misfit(pass.constant);
  std::optional<float> best;
  double least = without / 10;  // it must be much better than the constant itself
  std::vector<float> roots;
  for (std::size_t k = 0; k < std::min<std::size_t>(wanted.size(), 4); ++k)
    for (const float root : replacements(pass, wanted[k])) {
      if (const double m = misfit(root); m < least && root != pass.constant) least = m, best = root;
      roots.push_back(root);
    }
  if (!best) return best;
  // 8-bit output bounds the number only to an interval per texel. The number is in all intervals, so average the nearby candidates.
  float sum = 0, count = 0;
  for (const float root : roots)
    if (std::abs(root - *best) <= 0.05f * std::abs(*best)) sum += root, count += 1;
  if (const float mean = sum / count; mean != pass.constant)
    if (const double m = misfit(mean); m < least) least = m, best = mean;
  const auto suits = [&](float r) { return r != pass.constant && misfit(r) <= 1.1 * least + 0.02 * static_cast<double>(wanted.size()); };
  // If numbers fit equally well, prefer the most likely typing error.
  std::optional<float> typed;
  for (const float other : is_literal ? typed_wrong(pass.constant) : std::vector<float>())
    if (std::abs(other - *best) <= 0.1f * std::abs(*best) && misfit(other) <= 1.02 * least + 0.005 * static_cast<double>(wanted.size()) &&
        (!typed || std::abs(other - *best) < std::abs(*typed - *best)))
      typed = other;
  if (typed) return typed;
  for (int digits = 1; *best != 0 && digits < 7; ++digits) {
    if (const float nice = rounded(*best, digits); suits(nice)) return nice;
    if (const float nice = 1 / rounded(1 / *best, digits); digits < 4 && suits(nice)) return nice;
  }
  return best;
}

/// Short numbers that the pass uses only through their reciprocals, which a host or a compiler computed (perturbed::replacing).
Constants behind(const Constants& all) {
  Constants out;
  for (const Constant& c : all) {
    const float base = c.is_literal ? rounded(1 / c.value, 5) : 0;
    const auto is_base = [base](const Constant& other) { return other.value == base; };
    const std::pair made = perturbed::replacing(base, base).derived[0];
    if (base != 0 && std::isfinite(base) && made.first == c.value && std::none_of(all.begin(), all.end(), is_base))
      out.push_back({base, fmt::format("the literal {}", base), true, true, false, "the"});
  }
  return out;
}

}  // namespace

Fault another_value(Kind kind, const Constant& constant, float said, float replacement) {
  What what{kind, {constant.name, fmt::format("{:.5g}", said), fmt::format("{}", constant.value)}};
  what.is_literal = constant.begins_as_literal;
  return replaced(std::move(what), constant.value, replacement);
}

void add_fitted_constants(std::vector<Fault>& out, const EvaluateWith& evaluate, const Constants& constants,
                          const std::vector<Wanted>& wanted) {
  if (wanted.empty()) return;
  for (const Constants& some : {constants, behind(constants)})
    for (const Constant& constant : some)
      if (const std::optional<float> other = fitted({evaluate, constant.value}, wanted, constant.is_literal))
        out.push_back(another_value(Kind::another_value, constant, *other, *other));
}

}  // namespace rainref::faults
