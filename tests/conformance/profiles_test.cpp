// The profiles as built in: those of the data files, each with its sources; and what the reader refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "conformance/profiles.h"
#include "math/profiles.h"
#include "rainref/error.h"

namespace rainref::conformance {
namespace {

using enclosed::Accuracy;
using enclosed::Profile;

auto parts(const Accuracy& a) { return std::tuple(a.ulp, a.ulp_per_x, a.relative, a.absolute); }
auto parts(const Profile& p) {
  return std::tuple(std::tuple(p.name, p.reference, p.basic, p.contraction, p.flush, parts(p.division), parts(p.sqrt),
                               parts(p.inverse_sqrt), p.sqrt_is_inherited),
                    std::tuple(parts(p.exp), parts(p.exp2), parts(p.log), parts(p.log2), parts(p.log_near_one),
                               parts(p.log2_near_one), parts(p.pow), p.pow_is_inherited),
                    std::tuple(parts(p.sin_cos), p.sin_cos_domain, p.sin_cos_beyond, parts(p.atan2), p.subtexel_bits,
                               p.coordinate_bits, p.lod_bits, parts(p.unorm_load)),
                    std::tuple(p.half_store, p.half_overflow, p.unorm_store_ulp, p.srgb_store_ulp));
}

// Against a reader of the same files that shares no code with this one.
TEST(Profiles, AreThoseOfTheDataFiles) {
  std::vector<std::string> names = profile_names();
  EXPECT_EQ(std::count(names.begin(), names.end(), "typical"), 0);
  names.push_back("typical");
  std::sort(names.begin(), names.end());
  std::vector<std::string> expected = rainref::test::profile_names();
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(names, expected);
  for (const std::string& name : names)
    EXPECT_EQ(parts(profile(name)), parts(rainref::test::profile_named(name))) << name;
}

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
}  // namespace rainref::conformance
