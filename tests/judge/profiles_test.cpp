// What the reader of profiles refuses. Their numbers: profile_tables_test.cpp.
#include <gtest/gtest.h>

#include "judge/profiles.h"
#include "rainref/error.h"

namespace rainref::judge {
namespace {

std::string refusal(const std::string& toml) {
  try {
    static_cast<void>(parse_profile(toml, "mine.toml"));
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ExitCode::usage);
    return e.what();
  }
  return "";
}
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Profiles, ReaderRefusesWhatIsWrongAndSaysWhere) {
  const std::string head = "name = \"mine\"\nreference = false\n";
  EXPECT_EQ(refusal(head + "division = {ulp = 2.5, source = \"a book\"}\n"), "");
  const std::string unknown = refusal(head + "divison = {ulp = 2.5, source = \"a book\"}\n");
  EXPECT_TRUE(has(unknown, "mine.toml:3") && has(unknown, "division")) << unknown;
  const std::string unsourced = refusal(head + "division = {ulp = 2.5}\n");
  EXPECT_TRUE(has(unsourced, "source")) << unsourced;
  const std::string negative = refusal(head + "division = {ulp = -1, source = \"a book\"}\n");
  EXPECT_TRUE(has(negative, "0 or more")) << negative;
  const std::string choice = refusal(head + "flush = {value = \"sometimes\", source = \"a book\"}\n");
  EXPECT_TRUE(has(choice, "never, may, must")) << choice;
  EXPECT_TRUE(has(refusal("reference = true\n"), "name"));
}

TEST(Profiles, AWrongNameGetsTheNearest) {
  try {
    static_cast<void>(profile("vulcan"));
    FAIL();
  } catch (const Error& e) {
    EXPECT_TRUE(has(e.what(), "vulkan")) << e.what();
  }
}

}  // namespace
}  // namespace rainref::judge
