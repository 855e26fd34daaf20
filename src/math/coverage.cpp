#include "math/coverage.h"

namespace rainref::perturbed {
namespace {

/// Decisions inside lookups and vocabulary functions belong to the line that calls them.
bool is_part(std::string_view file) {
  const std::string_view name = file.substr(file.rfind('/') + 1);
  return name.starts_with("sampling") || name.starts_with("vocabulary");
}

}  // namespace

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

void Sides::add(const Sides& other) {
  for (std::size_t k = 0; k < counts.size(); ++k) {
    counts[k] += other.counts[k];
    if (reasons[k].empty()) reasons[k] = other.reasons[k];
  }
}

void Coverage::met(const Site& site, DecisionKind kind, int side) {
  last_ = nullptr;
  const Site& at = is_shader_ ? shader_site_ : site;
  if (is_shader_ ? at.line == 0 : is_part(site.file)) return;
  last_ = &*sides_.try_emplace({at.file, at.line, kind, at.function}).first;
  ++last_->second.counts[static_cast<std::size_t>(side)];
}
void Coverage::guarded(const char* reason, int side) {
  if (!last_) return;
  auto& [key, sides] = *last_;
  const bool has_outer = perturbed::sides(key.kind) == 3;
  if (side < 0 && has_outer)
    sides.reasons[0] = sides.reasons[2] = reason;
  else
    sides.reasons[static_cast<std::size_t>(side < 0 ? 1 : side)] = reason;
}

void Coverage::addressed(const char* rule, DecisionKind kind, int side) {
  if (kind == DecisionKind::load && open_ > 0 && opened_[0].kind == DecisionKind::address) return;
  if (open_ < opened_.size()) opened_[open_++] = {rule, kind, side};
}

void Coverage::settle(const float* texel) {
  for (std::size_t k = 0; k < open_; ++k) {
    last_ = &*sides_.try_emplace({opened_[k].rule, 0, opened_[k].kind, "", texel}).first;
    ++last_->second.counts[static_cast<std::size_t>(opened_[k].side)];
  }
  open_ = 0;
}

void Coverage::name_inputs(const std::function<std::string(const float*)>& name_of) {
  std::map<Key, Sides> named;
  for (const auto& [key, sides] : sides_) {
    Key with_name = key;
    if (key.texel) with_name.input = name_of(key.texel);
    with_name.texel = nullptr;
    named[with_name].add(sides);
  }
  sides_ = std::move(named);
  last_ = nullptr;
}

void Coverage::add(const Coverage& other) {
  for (const auto& [key, sides] : other.sides_) sides_[key].add(sides);
}

std::map<Decision, Sides> Coverage::decisions() const {
  std::map<Decision, Sides> out;
  for (const auto& [key, sides] : sides_) {
    std::string_view file = key.file;
    if (const std::size_t name = file.rfind('/') + 1; name > 1) file.remove_prefix(file.rfind('/', name - 2) + 1);
    const std::string_view function = key.function;
    out[{std::string(file), key.line, key.kind, std::string(function.substr(0, function.find('<'))), key.input}].add(sides);
  }
  return out;
}

}  // namespace rainref::perturbed
