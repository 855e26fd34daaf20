// The packs of the scenes in tests/packs and their passes, found by their files: a new pack is in every proof without an edit.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "source_folder.h"

namespace rainref::test {

/// Scenes that packs are made of, and their pictures.
inline std::filesystem::path pack_sources() { return source_folder() + "/tests/packs"; }
/// The scene that a pack is made of.
inline std::filesystem::path pack_scene(const std::string& name) { return pack_sources() / (name + ".toml"); }
inline std::filesystem::path pack_folder(const std::string& name) { return std::filesystem::path(packs_folder()) / name; }

/// Some passes of a pack.
struct PackPasses {
  std::string name, effect, variant;
  std::vector<std::string> passes;  ///< in ascending order

  bool has(const std::string& pass) const { return std::find(passes.begin(), passes.end(), pass) != passes.end(); }
  /// "windshield-corrected": plain packs are called so.
  std::string effect_and_variant() const { return effect + "-" + variant; }
  friend void PrintTo(const PackPasses& p, std::ostream* out) { *out << p.name; }
};

/// The pack of every scene of tests/packs with all its passes. Packs of an effect and a variant alone come first, those of richer scenes
/// after them, each in ascending order. Throws where there is no scene, or a pack was not made.
inline const std::vector<PackPasses>& shipped_packs() {
  static const std::vector<PackPasses> all = [] {
    std::vector<PackPasses> found;
    for (const auto& file : std::filesystem::directory_iterator(pack_sources())) {
      if (file.path().extension() != ".toml") continue;
      PackPasses p;
      p.name = file.path().stem().string();
      std::ifstream scene(file.path());
      for (std::string line; std::getline(scene, line);)
        for (const auto& [key, value] : {std::pair<std::string, std::string*>{"effect", &p.effect}, {"variant", &p.variant}})
          if (const std::string begin = key + " = \""; line.starts_with(begin))
            *value = line.substr(begin.size(), line.find('"', begin.size()) - begin.size());
      // Every output has a file of its own, in a folder of its pass.
      if (!std::filesystem::exists(pack_folder(p.name)))
        throw std::runtime_error(pack_folder(p.name).string() + ": was not made: build the target packs");
      for (const auto& folder : std::filesystem::directory_iterator(pack_folder(p.name)))
        if (folder.is_directory()) p.passes.push_back(folder.path().filename().string().substr(p.effect.size() + 1));
      std::sort(p.passes.begin(), p.passes.end());
      found.push_back(std::move(p));
    }
    if (found.empty()) throw std::runtime_error(pack_sources().string() + ": no scenes");
    const auto order = [](const PackPasses& p) { return std::pair(p.name != p.effect_and_variant(), p.name); };
    std::sort(found.begin(), found.end(), [&](const PackPasses& a, const PackPasses& b) { return order(a) < order(b); });
    return found;
  }();
  return all;
}
/// One of them, with all its passes or with these. Throws where no pack is called so.
inline PackPasses shipped_pack(const std::string& name, std::vector<std::string> passes = {}) {
  for (PackPasses p : shipped_packs()) {
    if (p.name != name) continue;
    if (!passes.empty()) p.passes = std::move(passes);
    return p;
  }
  throw std::runtime_error("no pack " + name);
}

/// Every pass and variant of the shipped packs once, in the first pack that has it: what the proofs go by. With RAINREF_ALL_PACKS=1 in
/// each pack that has it.
inline const std::vector<PackPasses>& proven_packs() {
  static const std::vector<PackPasses> all = [] {
    if (std::getenv("RAINREF_ALL_PACKS")) return shipped_packs();
    std::vector<PackPasses> some;
    std::set<std::string> met;
    for (PackPasses p : shipped_packs()) {
      std::erase_if(p.passes, [&](const std::string& pass) { return !met.insert(p.effect_and_variant() + " " + pass).second; });
      if (!p.passes.empty()) some.push_back(std::move(p));
    }
    return some;
  }();
  return all;
}
/// The effects that have packs, in ascending order.
inline const std::vector<std::string>& packed_effects() {
  static const std::vector<std::string> all = [] {
    std::set<std::string> names;
    for (const PackPasses& p : shipped_packs()) names.insert(p.effect);
    return std::vector<std::string>(names.begin(), names.end());
  }();
  return all;
}
/// Those of an effect.
inline std::vector<PackPasses> packs_of(std::string_view effect, std::vector<PackPasses> packs) {
  std::erase_if(packs, [&](const PackPasses& p) { return p.effect != effect; });
  return packs;
}

/// The name of a test whose parameter is a pack.
inline constexpr auto name_of_pack_test = [](const auto& tested) {
  std::string name = tested.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
};

}  // namespace rainref::test
