// The diagnosis is decided by kinds and columns: no source of the room reads a name or a sentence.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>

namespace {

namespace fs = std::filesystem;

// text.cpp reads expressions of the pass, members.h the names of uniforms; of causes they know nothing.
TEST(Causes, NoSourceAsksWhatATextBeginsWithEndsWithOrContains) {
  const std::set<std::string> read_texts{"text.cpp", "members.h"};
  const std::regex asks(
      R"(\.(starts_with|ends_with|substr|compare|find_first_of|find_first_not_of|find_last_of)\(|\.(r?find|contains)\(["'])");
  const fs::path room = fs::path(RAINREF_SOURCE_DIR) / "src/faults";
  int lines = 0;
  for (const auto& entry : fs::directory_iterator(room)) {
    if (read_texts.contains(entry.path().filename().string())) continue;
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line); ++lines) {
      // Members of this name are no quantities of the pass.
      const bool is_of_padding = line.find("\"padding\"") != std::string::npos;
      EXPECT_TRUE(is_of_padding || !std::regex_search(line, asks)) << entry.path().filename() << ": " << line;
    }
  }
  EXPECT_GT(lines, 5000);
}

}  // namespace
