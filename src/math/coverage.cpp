#include "math/coverage.h"

namespace rainref::perturbed {

std::string_view name(DecisionKind kind) {
  switch (kind) {
    case DecisionKind::choice:
      return "select";
    case DecisionKind::minimum:
      return "min";
    case DecisionKind::maximum:
      return "max";
    case DecisionKind::clamp:
      return "clamp";
    case DecisionKind::total_reflection:
      return "refract";
    case DecisionKind::address:
      return "lookup";
  }
  return "";
}

int sides(DecisionKind kind) { return kind == DecisionKind::clamp || kind == DecisionKind::address ? 3 : 2; }

std::string_view side_name(DecisionKind kind, int side) {
  switch (kind) {
    case DecisionKind::clamp:
      return side == 0 ? "below" : side == 1 ? "within" : "above";
    case DecisionKind::address:
      return side == 0 ? "before the first texel" : side == 1 ? "inside" : "behind the last texel";
    case DecisionKind::total_reflection:
      return side == 0 ? "a refracted ray" : "total reflection";
    default:
      return side == 0 ? "the first" : "the second";
  }
}

void Coverage::met(const char* file, int line, DecisionKind kind, int side) {
  ++counts_[{file, line, kind}][static_cast<std::size_t>(side)];
}

void Coverage::add(const Coverage& other) {
  for (const auto& [key, counts] : other.counts_)
    for (std::size_t k = 0; k < counts.size(); ++k) counts_[key][k] += counts[k];
}

std::map<Decision, Coverage::Counts> Coverage::decisions() const {
  std::map<Decision, Counts> out;
  for (const auto& [key, counts] : counts_) {
    std::string_view file = key.file;
    file.remove_prefix(file.rfind('/') + 1);
    // Parts of lookups and of the vocabulary's functions are met under the line that calls them.
    if (file.starts_with("sampling") || file.starts_with("vocabulary")) continue;
    Counts& all = out[{std::string(file), key.line, key.kind}];
    for (std::size_t k = 0; k < counts.size(); ++k) all[k] += counts[k];
  }
  return out;
}

Exercised exercised(const std::map<Decision, Coverage::Counts>& decisions) {
  Exercised e;
  for (const auto& [decision, counts] : decisions) {
    e.of += sides(decision.kind);
    for (int k = 0; k < sides(decision.kind); ++k) e.taken += counts[static_cast<std::size_t>(k)] > 0;
  }
  return e;
}

}  // namespace rainref::perturbed
