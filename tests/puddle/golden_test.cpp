// The recorded hashes of every pass, variant and storage.
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "puddle/golden_scenes.h"

namespace rainref::puddle {
namespace {

std::vector<std::string> recorded(const std::string& scene) {
  std::ifstream file(RAINREF_SOURCE_DIR "/tests/golden/hashes.txt");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(scene + " ")) lines.push_back(line);
  }
  return lines;
}

class Golden : public testing::TestWithParam<GoldenScene> {};

TEST_P(Golden, HashesAreAsRecorded) {
  const std::vector<std::string> expected = recorded(GetParam().name);
  ASSERT_FALSE(expected.empty()) << "no line of tests/golden/hashes.txt starts with " << GetParam().name;
  // Line by line, so that the first pass that differs is the one named.
  const std::vector<std::string> found = golden_lines(GetParam(), parallel::Executor(2));
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) ASSERT_EQ(found[i], expected[i]);
}

INSTANTIATE_TEST_SUITE_P(Puddle, Golden, testing::ValuesIn(golden_scenes()), [](const auto& param) {
  std::string name = param.param.name;
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
});

TEST(Golden, EveryRecordedLineBelongsToAScene) {
  std::set<std::string> names;
  for (const GoldenScene& scene : golden_scenes()) names.insert(scene.name);
  std::ifstream file(RAINREF_SOURCE_DIR "/tests/golden/hashes.txt");
  int lines = 0;
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("puddle/")) continue;  // another effect's
    EXPECT_TRUE(names.contains(line.substr(0, line.find(' ')))) << line;
    ++lines;
  }
  EXPECT_GT(lines, 0);
}

}  // namespace
}  // namespace rainref::puddle
