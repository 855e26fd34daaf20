#include "scene/unexercised.h"

#include <vector>

#include "rainref/error.h"
#include "scene/check.h"

namespace rainref::scene {
namespace {

constexpr std::string_view table = "unexercised.";

}  // namespace

bool is_unexercised(std::string_view key) { return key.starts_with(table); }

void take_unexercised(const RawEntry& raw, Unexercised& to) {
  const auto expect_pairs = [&](const RawValue& found) {
    refuse({Origin::file, found.at}, raw.key, "expected pairs of an alternative and the reason why no run takes it, found " + found.text());
  };
  const auto* pairs = std::get_if<std::vector<RawValue>>(&raw.value.data);
  if (!pairs) expect_pairs(raw.value);
  for (const RawValue& pair : *pairs) {
    const auto* both = std::get_if<std::vector<RawValue>>(&pair.data);
    if (!both || both->size() != 2) expect_pairs(pair);
    const auto *alternative = std::get_if<std::string>(&both->front().data), *reason = std::get_if<std::string>(&both->back().data);
    if (!alternative || !reason || alternative->empty() || reason->empty()) expect_pairs(pair);
    if (!to[raw.key.substr(table.size())].emplace(*alternative, *reason).second)
      refuse({Origin::file, pair.at}, raw.key, "'" + *alternative + "' is there twice");
  }
}

Unexercised unexercised(std::string_view toml, const std::string& file) {
  Unexercised out;
  for (const RawEntry& raw : read_toml(toml, file))
    if (is_unexercised(raw.key)) take_unexercised(raw, out);
  return out;
}

}  // namespace rainref::scene
