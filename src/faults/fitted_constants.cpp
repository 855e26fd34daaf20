// Which other value of a literal or a uniform gives what a port stored.
#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "faults/place_faults.h"

namespace rainref::faults {
namespace {

/// A pass with one constant replaced.
struct Replaced {
  const capture::PassModel& model;
  float constant;

  float value(const Wanted& w, std::size_t slot, float replacement) const {
    perturbed::Behaviour b;
    b.fault = perturbed::Fault::constant;
    b.constant = constant;
    b.replacement = replacement;
    const perturbed::Scope scope(b);
    std::vector<perturbed::Perturbed> values(w.port.size());
    model.evaluate(w.at.x, w.at.y, values.data());
    return values[slot].v;
  }
};

/// The slot that the port changed most, against what the reference has there.
std::size_t farthest_slot(const Wanted& w) {
  std::size_t best = 0;
  double most = -1;
  for (std::size_t s = 0; s < w.port.size(); ++s) {
    const double off = std::abs(static_cast<double>(w.port[s]) - w.reference[s]) / (std::abs(static_cast<double>(w.reference[s])) + 1e-6);
    if (off > most && std::isfinite(w.port[s])) most = off, best = s;
  }
  return best;
}

/// A value between two at which `off` changes its sign.
template <class Off>
float bisected(float low, float high, const Off& off) {
  double at_low = off(low);
  for (int round = 0; round < 40; ++round) {
    const float middle = low + (high - low) / 2;
    const double at = off(middle);
    if ((at < 0) == (at_low < 0))
      low = middle, at_low = at;
    else
      high = middle;
  }
  return low + (high - low) / 2;
}

/// With so many significant digits.
float rounded(float x, int digits) {
  const double scale = std::pow(10.0, digits - 1 - std::floor(std::log10(std::abs(static_cast<double>(x)))));
  return static_cast<float>(std::round(x * scale) / scale);
}

/// The replacement of a constant that every texel wants, as near to it as one of a few digits may be.
std::optional<float> fitted(const Replaced& pass, const std::vector<Wanted>& wanted) {
  const float v = pass.constant;
  const Wanted& first = wanted.front();
  const std::size_t slot = farthest_slot(first);
  const auto off = [&](float r) { return static_cast<double>(pass.value(first, slot, r)) - first.port[slot]; };
  std::vector<float> tried;
  for (const float f :
       {-4.0f, -2.0f, -1.0f, -0.5f, 0.0f, 0.25f, 0.5f, 0.75f, 0.9f, 0.97f, 1.0f, 1.03f, 1.1f, 1.25f, 1.5f, 2.0f, 3.0f, 4.5f, 10.0f})
    tried.push_back(v == 0 ? f : v * f);
  std::sort(tried.begin(), tried.end());
  // Nearest to the constant first.
  std::vector<std::pair<double, float>> roots;
  double before = off(tried[0]);
  for (std::size_t k = 1; k < tried.size(); ++k) {
    const double now = off(tried[k]);
    if (std::isfinite(before) && std::isfinite(now) && (before < 0) != (now < 0)) {
      const float root = bisected(tried[k - 1], tried[k], off);
      roots.push_back({std::abs(static_cast<double>(root) - v), root});
    }
    before = now;
  }
  std::sort(roots.begin(), roots.end());
  // How much nearer than the reference a replacement must be everywhere.
  const auto fits = [&](float r, double share) {
    return std::all_of(wanted.begin(), wanted.end(), [&](const Wanted& w) {
      const std::size_t s = farthest_slot(w);
      const double far = std::abs(static_cast<double>(w.port[s]) - w.reference[s]);
      return std::abs(static_cast<double>(pass.value(w, s, r)) - w.port[s]) <= share * far + w.step[s];
    });
  };
  for (const auto& [distance, root] : roots) {
    if (!(distance > 0) || !fits(root, 0.1)) continue;
    for (int digits = 1; digits < 6 && root != 0; ++digits)
      if (const float nice = rounded(root, digits); nice != v && fits(nice, 0.02)) return nice;
    return root;
  }
  return std::nullopt;
}

}  // namespace

void add_fitted_constants(std::vector<Deviation>& out, const capture::PassModel& model, const std::map<float, std::string>& names,
                          const std::vector<Wanted>& wanted) {
  if (wanted.empty()) return;
  for (const auto& [value, name] : names) {
    const std::optional<float> other = fitted({model, value}, wanted);
    if (!other) continue;
    Deviation d;
    d.name = fmt::format("another value of {}", name);
    d.sentence = fmt::format("{} is about {:.5g} in the port, {} in the reference", name, *other, value);
    d.behaviour.fault = perturbed::Fault::constant;
    d.behaviour.constant = value;
    d.behaviour.replacement = *other;
    d.for_diagnosis = true;
    out.push_back(std::move(d));
  }
}

}  // namespace rainref::faults
