// The recorded hashes of every pass, variant and rounding.
#include <gtest/gtest.h>

#include <fstream>
#include <set>

#include "edge_splash/golden_scenes.h"

namespace rainref::edge_splash {
namespace {

std::vector<std::string> recorded(const std::string& start) {
  std::ifstream file(RAINREF_SOURCE_DIR "/tests/golden/hashes.txt");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(start)) lines.push_back(line);
  }
  return lines;
}

class Golden : public testing::TestWithParam<GoldenScene> {};

TEST_P(Golden, HashesAreAsRecorded) {
  const std::vector<std::string> expected = recorded(GetParam().name + " ");
  ASSERT_FALSE(expected.empty()) << "no line of tests/golden/hashes.txt starts with " << GetParam().name;
  // Line by line, so that the first pass that differs is the one named.
  const std::vector<std::string> found = golden_lines(GetParam(), parallel::Executor(2));
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) ASSERT_EQ(found[i], expected[i]);
}

INSTANTIATE_TEST_SUITE_P(EdgeSplash, Golden, testing::ValuesIn(golden_scenes()), [](const auto& param) {
  std::string name = param.param.name;
  for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name;
});

TEST(Golden, EveryRecordedLineBelongsToAScene) {
  std::set<std::string> names;
  for (const GoldenScene& scene : golden_scenes()) names.insert(scene.name);
  const std::vector<std::string> lines = recorded("edge_splash/");
  for (const std::string& line : lines) EXPECT_TRUE(names.contains(line.substr(0, line.find(' ')))) << line;
  EXPECT_FALSE(lines.empty());
}

}  // namespace
}  // namespace rainref::edge_splash
