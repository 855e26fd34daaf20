// tests/golden/hashes.txt, as the tests of every effect read it.
#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "rainref/executor.h"
#include "source_folder.h"

namespace rainref::golden {

/// Lines that begin with this, in the file's order.
inline std::vector<std::string> recorded(const std::string& start) {
  std::ifstream file(rainref::test::source_folder() + "/tests/golden/hashes.txt");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(start)) lines.push_back(line);
  }
  return lines;
}

/// What golden_lines of the scene's room gives is what was recorded.
template <class Scene>
void expect_as_recorded(const Scene& scene) {
  const std::vector<std::string> expected = recorded(scene.name + " ");
  ASSERT_FALSE(expected.empty()) << "no line of tests/golden/hashes.txt starts with " << scene.name;
  // Line by line, so that the first pass that differs is the one named.
  const std::vector<std::string> found = golden_lines(scene, parallel::Executor(2));
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) ASSERT_EQ(found[i], expected[i]);
}
/// No line of the effect was left behind by a scene that is gone.
template <class Scene>
void expect_every_line_has_a_scene(const std::string& effect, const std::vector<Scene>& scenes) {
  std::set<std::string> names;
  for (const Scene& scene : scenes) names.insert(scene.name);
  const std::vector<std::string> lines = recorded(effect + "/");
  for (const std::string& line : lines) EXPECT_TRUE(names.contains(line.substr(0, line.find(' ')))) << line;
  EXPECT_FALSE(lines.empty());
}
/// A scene's name as a test's.
template <class Parameter>
std::string test_name(const Parameter& parameter) {
  std::string name = parameter.param.name;
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
}

}  // namespace rainref::golden
