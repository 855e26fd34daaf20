// What is committed: nothing stray at the top, and sources as clang-format leaves them (.clang-format).
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "base/shell.h"

namespace {

using rainref::output_of;

// An experiment's output, committed by mistake, lies beside the folders.
TEST(Committed, TheTopLevelHoldsFoldersDocumentsAndPresets) {
  const auto [text, status] = output_of("git -C '" RAINREF_SOURCE_DIR "' ls-tree --name-only HEAD");
  if (status != 0) GTEST_SKIP() << "not a checkout: " << text;
  const std::set<std::string> folders{"src", "include", "tests", "bench", "scenes", "presets", "scripts", "docs", "examples"};
  const std::regex files("\\..+|CMakeLists\\.txt|CMakePresets\\.json|pyproject\\.toml|LICENSE|CITATION\\.cff|[A-Z]+\\.md");
  std::istringstream names(text);
  std::size_t found = 0;
  for (std::string name; std::getline(names, name);) {
    if (folders.contains(name))
      ++found;
    else
      EXPECT_TRUE(std::regex_match(name, files)) << name;
  }
  EXPECT_EQ(found, folders.size());
}

// Another version of clang-format formats otherwise, so that of Debian 12 says.
TEST(Committed, EveryFileIsFormatted) {
  const std::string version = output_of("clang-format --version").first;
  if (version.find("version 14.") == std::string::npos) GTEST_SKIP() << "needs clang-format 14: " << version;
  const auto [text, status] =
      output_of("cd '" RAINREF_SOURCE_DIR
                "' && find src include tests bench examples -name '*.h' -o -name '*.cpp' -o -name '*.cu' | xargs clang-format "
                "--dry-run -Werror --ferror-limit=1");
  EXPECT_EQ(status, 0) << "clang-format -i FILE mends it\n" << text;
}

}  // namespace
