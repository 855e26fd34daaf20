// What the reader of profiles refuses. Their numbers: profile_tables_test.cpp.
#include <gmock/gmock.h>

#include "base/error_of.h"
#include "judge/profiles.h"

namespace rainref::judge {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string refusal(const std::string& toml) {
  return error_of([&] { static_cast<void>(parse_profile(toml, "mine.toml")); });
}

TEST(Profiles, ReaderRefusesWhatIsWrongAndSaysWhere) {
  const std::string head = "name = \"mine\"\nreference = false\n";
  EXPECT_EQ(refusal(head + "division = {ulp = 2.5, source = \"a book\"}\n"), "none");
  EXPECT_THAT(refusal(head + "divison = {ulp = 2.5, source = \"a book\"}\n"), AllOf(HasSubstr("2 mine.toml:3"), HasSubstr("division")));
  EXPECT_THAT(refusal(head + "division = {ulp = 2.5}\n"), AllOf(StartsWith("2 "), HasSubstr("source")));
  EXPECT_THAT(refusal(head + "division = {ulp = -1, source = \"a book\"}\n"), HasSubstr("0 or more"));
  EXPECT_THAT(refusal(head + "flush = {value = \"sometimes\", source = \"a book\"}\n"), HasSubstr("never, may, must"));
  EXPECT_THAT(refusal("reference = true\n"), HasSubstr("name"));
}

TEST(Profiles, AWrongNameGetsTheNearest) {
  EXPECT_THAT(error_of([] { static_cast<void>(profile("vulcan")); }), HasSubstr("vulkan"));
}

}  // namespace
}  // namespace rainref::judge
