// Plans in a folder of their own, and their cells.
#pragma once

#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error_of.h"
#include "base/temporary_folder.h"
#include "simulation/small_scenes.h"
#include "sweep/cells.h"
#include "sweep/frames.h"
#include "sweep/work.h"

namespace rainref::sweep {

struct OpenedPlan {
  std::unique_ptr<Plan> plan;
  Cells cells;
  explicit OpenedPlan(const std::filesystem::path& file) : plan(std::make_unique<Plan>(read_plan(file))), cells(*plan) {}
};

/// A folder with a.toml, a puddle of a few texels, and its store.
class Plans : public testing::Test {
 protected:
  Plans() { put(folder / "a.toml", scene("puddle", "corrected")); }

  static std::string scene(const std::string& effect, const std::string& variant) {
    const SceneText text = small(effect, variant);
    std::string toml;
    for (const std::string& s : text.set) {
      const std::size_t equals = s.find('=');
      const std::string value = s.substr(equals + 1);
      const bool is_text = value.find_first_not_of("0123456789.[], ") != std::string::npos && value != "true" && value != "false";
      toml += s.substr(0, equals) + " = " + (is_text ? "'" + value + "'" : value) + "\n";
    }
    return toml;
  }
  std::filesystem::path plan(const std::string& text, const std::string& name = "plan.toml") const {
    put(folder / name, text);
    return folder / name;
  }
  /// What is said of a plan that is refused, without the folder before its name.
  std::string refusal(const std::string& text) const {
    const std::filesystem::path file = plan(text);
    std::string said = error_of([&] { OpenedPlan{file}; });
    const std::string path = folder.path().generic_string() + "/";
    for (std::size_t at = 0; (at = said.find(path, at)) != std::string::npos;) said.erase(at, path.size());
    return said;
  }
  std::vector<std::string> ids(const std::string& text, const std::string& name = "plan.toml") const {
    std::vector<std::string> all;
    const OpenedPlan opened(plan(text, name));
    for (const Cell& cell : opened.cells.all()) all.push_back(cell.id);
    return all;
  }
  /// Makes every cell of a shard as the command line does.
  Counts make(const OpenedPlan& opened, const Store& at, WorkOptions options = {}) const {
    return work(
        opened.cells, at, options,
        [&](const Cell& cell, Names& names) { return make_frames(opened.cells, cell, at, executor, names, [](const std::string&) {}); },
        [](const Cell&, Outcome, const std::string&) {});
  }

  TemporaryFolder folder;
  Store store{folder / "out"};
  parallel::Executor executor{1};
};

}  // namespace rainref::sweep
