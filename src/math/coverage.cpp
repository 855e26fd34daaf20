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
    case DecisionKind::load:
      return "load";
  }
  return "";
}

int sides(DecisionKind kind) { return kind == DecisionKind::clamp || kind == DecisionKind::address || kind == DecisionKind::load ? 3 : 2; }

std::string_view side_name(DecisionKind kind, int side) {
  switch (kind) {
    case DecisionKind::clamp:
      return side == 0 ? "below" : side == 1 ? "within" : "above";
    case DecisionKind::address:
    case DecisionKind::load:
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

void Coverage::addressed(const char* rule, DecisionKind kind, int side) {
  if (kind == DecisionKind::load && open_ > 0 && opened_[0].kind == DecisionKind::address) return;
  if (open_ < opened_.size()) opened_[open_++] = {rule, kind, side};
}

void Coverage::settle(const float* texel) {
  for (std::size_t k = 0; k < open_; ++k)
    ++counts_[{opened_[k].rule, 0, opened_[k].kind, texel}][static_cast<std::size_t>(opened_[k].side)];
  open_ = 0;
}

void Coverage::name_inputs(const std::function<std::string(const float*)>& name_of) {
  std::map<Key, Counts> named;
  for (const auto& [key, counts] : counts_) {
    Key with_name = key;
    if (key.texel) with_name.input = name_of(key.texel);
    with_name.texel = nullptr;
    for (std::size_t k = 0; k < counts.size(); ++k) named[with_name][k] += counts[k];
  }
  counts_ = std::move(named);
}

void Coverage::add(const Coverage& other) {
  for (const auto& [key, counts] : other.counts_)
    for (std::size_t k = 0; k < counts.size(); ++k) counts_[key][k] += counts[k];
}

std::map<Decision, Coverage::Counts> Coverage::decisions() const {
  std::map<Decision, Counts> out;
  for (const auto& [key, counts] : counts_) {
    std::string_view file = key.file;
    const std::size_t name = file.rfind('/') + 1;
    // Parts of lookups and of the vocabulary's functions are met under the line that calls them.
    if (file.substr(name).starts_with("sampling") || file.substr(name).starts_with("vocabulary")) continue;
    if (name > 1) file.remove_prefix(file.rfind('/', name - 2) + 1);
    Counts& all = out[{std::string(file), key.line, key.kind, key.input}];
    for (std::size_t k = 0; k < counts.size(); ++k) all[k] += counts[k];
  }
  return out;
}

}  // namespace rainref::perturbed
