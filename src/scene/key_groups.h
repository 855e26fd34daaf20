// How keys are grouped for people: tables, those that most scenes set, and tables that repeat another.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace rainref::scene {

/// "puddle" of "puddle.damping"; "" for a key without a table.
std::string table_of(std::string_view key);
/// The few keys that most scenes set, of any effect. Descriptions show them first.
std::span<const std::string_view> basic_keys();
bool is_basic(std::string_view key);
/// The table whose keys this numbered one has once more, for another part of the scene: "wipers" of "pane_1_wipers"; "" for other tables.
/// Descriptions show them once.
std::string repeated_table(std::string_view table);

}  // namespace rainref::scene
