// A scene as the command line reads it, of an effect that is the only one.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "scene/effect_table.h"
#include "scene/toml.h"

namespace rainref::test {

/// The scene of a text without its first two lines, which say effect and variant. `values` are those of --set.
inline scene::Config config_of(const std::string& effect, std::span<const scene::Parameter> parameters, const std::string& variant,
                               const std::string& toml, const std::vector<std::string>& values = {}) {
  const scene::EffectTable table{{{effect, {"as-published", "corrected"}, parameters}}};
  return scene::parse(fmt::format("effect = '{}'\nvariant = '{}'\n{}", effect, variant, toml), "test.toml", values, table);
}

}  // namespace rainref::test
