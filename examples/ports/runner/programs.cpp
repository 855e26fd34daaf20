#include "ports/runner/programs_json.h"

#include <algorithm>
#include <numeric>

#include <nlohmann/json.hpp>

namespace port_runner {
namespace {

using nlohmann::json;
using Names = std::vector<std::string>;

// A value as a message shows it: not pages of it.
std::string shown(const json& value) {
  const std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  return text.size() <= 60 ? text : text.substr(0, 57) + "...";
}

// A value of the file, and where it stands: "programs / puddle.wave_step.corrected/2 / inputs".
struct Place {
  const fs::path& file;
  std::string key;
  const json& value;

  [[noreturn]] void refuse(const std::string& expected, const std::string& hint = "") const {
    fail("expected " + expected + ", found " + shown(value) + hint);
  }
  [[noreturn]] void fail(const std::string& what) const { throw FileError(file.string() + ": " + (key.empty() ? "" : key + ": ") + what); }
  Place inside(const std::string& name, const json& of) const { return {file, key.empty() ? name : key + " / " + name, of}; }
  const json* find(const std::string& name) const {
    const auto found = value.find(name);
    return found == value.end() ? nullptr : &*found;
  }

  /// An object with these keys and no other.
  void object(const Names& required, const Names& optional = {}) const {
    if (!value.is_object()) refuse("an object");
    Names known = required;
    known.insert(known.end(), optional.begin(), optional.end());
    for (const auto& [name, unused] : value.items()) {
      if (std::find(known.begin(), known.end(), name) == known.end())
        fail("unknown key '" + name + "', expected one of " + joined(known) + did_you_mean(name, known));
    }
    for (const std::string& name : required) {
      if (!value.contains(name)) fail("the key '" + name + "' is missing");
    }
  }
  std::string text() const {
    if (!value.is_string() || value.get<std::string>().empty()) refuse("a text");
    return value;
  }
  bool flag() const {
    if (!value.is_boolean()) refuse("true or false");
    return value;
  }
  std::uint32_t whole(std::uint32_t from, std::uint32_t to) const {
    if (!value.is_number_integer() || value < from || value > to)
      refuse("a whole number from " + std::to_string(from) + " to " + std::to_string(to));
    return value;
  }
  Names texts() const {
    if (!value.is_array()) refuse("a list of texts");
    Names all;
    for (const json& one : value) {
      if (!one.is_string()) refuse("a list of texts");
      all.push_back(one);
    }
    return all;
  }
};

Fact read_fact(const Place& from, const Names& inputs) {
  from.object({"id", "key", "input"});
  const auto at = [&](const char* name) { return from.inside(name, *from.find(name)); };
  const Fact fact{at("id").whole(0, 0xffffffffu), at("key").text(), at("input").text()};
  const Names keys{"address_u", "address_v", "present"};
  if (std::find(keys.begin(), keys.end(), fact.key) == keys.end()) at("key").refuse("one of " + joined(keys), did_you_mean(fact.key, keys));
  if (std::find(inputs.begin(), inputs.end(), fact.input) == inputs.end())
    at("input").refuse("one of the program's inputs, " + joined(inputs), did_you_mean(fact.input, inputs));
  return fact;
}

Program read_program(const Place& from, const fs::path& folder) {
  from.object({"spirv", "inputs", "outputs"}, {"constants", "lists", "one_group", "group", "capacity"});
  const auto at = [&](const char* name) { return from.inside(name, *from.find(name)); };
  Program p;
  const std::string file = at("spirv").text();
  p.spirv = folder / fs::path(std::u8string(file.begin(), file.end()));
  p.inputs = at("inputs").texts();
  p.outputs = at("outputs").texts();
  if (p.outputs.empty()) at("outputs").refuse("at least one output");
  if (from.find("constants") != nullptr) {
    const Place constants = at("constants");
    if (!constants.value.is_array()) constants.refuse("a list of constants");
    for (std::size_t i = 0; i < constants.value.size(); ++i)
      p.constants.push_back(read_fact(constants.inside(std::to_string(i), constants.value[i]), p.inputs));
  }
  if (from.find("lists") != nullptr) {
    p.lists = at("lists").texts();
    for (const std::string& name : p.lists)
      if (std::find(p.inputs.begin(), p.inputs.end(), name) == p.inputs.end())
        at("lists").refuse("some of the program's inputs, " + joined(p.inputs), did_you_mean(name, p.inputs));
  }
  if (from.find("one_group") != nullptr) p.one_group = at("one_group").flag();
  if (from.find("group") != nullptr) {
    const Place group = at("group");
    if (p.one_group) group.fail("expected none beside one_group: there is one workgroup, of any size");
    if (!group.value.is_array() || group.value.size() != 2) group.refuse("two whole numbers, such as [8, 8]");
    for (std::size_t i = 0; i < 2; ++i) p.group[i] = group.inside(std::to_string(i), group.value[i]).whole(1, 1024);
  }
  if (from.find("capacity") != nullptr) p.capacity = at("capacity").whole(1, 1u << 24);
  return p;
}

}  // namespace

std::string joined(const Names& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}
std::string did_you_mean(const std::string& text, const Names& names) {
  const auto distance = [](const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
      std::size_t diagonal = row[0];
      row[0] = i + 1;
      for (std::size_t j = 0; j < b.size(); ++j) {
        const std::size_t changed = diagonal + (a[i] != b[j]);
        diagonal = row[j + 1];
        row[j + 1] = std::min({row[j] + 1, row[j + 1] + 1, changed});
      }
    }
    return row.back();
  };
  std::string nearest;
  std::size_t least = std::max<std::size_t>(2, text.size() / 3) + 1;
  for (const std::string& name : names) {
    const std::size_t away = distance(text, name);
    if (away < least) {
      nearest = name;
      least = away;
    }
  }
  return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

std::map<std::string, Program> programs_of(const json& all, const fs::path& folder) {
  const fs::path file = folder / "bindings.json";
  const Place top{file, "", all};
  top.object({"programs"});
  const Place programs = top.inside("programs", all["programs"]);
  if (!programs.value.is_object()) programs.refuse("an object");
  std::map<std::string, Program> out;
  for (const auto& [formula, from] : programs.value.items()) out.emplace(formula, read_program(programs.inside(formula, from), folder));
  return out;
}
std::int32_t address_number(const std::string& address) {
  const char* const names[] = {"clamp", "repeat", "border", "mirror"};
  const auto name = std::find(std::begin(names), std::end(names), address);
  return name == std::end(names) ? -1 : static_cast<std::int32_t>(name - std::begin(names));
}

}  // namespace port_runner
