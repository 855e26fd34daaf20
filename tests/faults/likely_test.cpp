// Causes that were called likely and were none.
#include <algorithm>

#include <gtest/gtest.h>

#include "faults/diagnose.h"
#include "faults/generators.h"
#include "judge/mini_port.h"

namespace rainref::faults {
namespace {

using namespace judge;
using capture::PassCase;

std::vector<Kind> tried_for(const Constant& constant) {
  std::vector<Fault> made;
  add_named_constants(made, {constant}, constant.is_literal);
  std::vector<Kind> kinds;
  for (const Fault& f : made) kinds.push_back(f.kind);
  return kinds;
}
bool has(const std::vector<Kind>& kinds, Kind kind) { return std::find(kinds.begin(), kinds.end(), kind) != kinds.end(); }

// "The literal 1e-12 inverted: it is 1000000000000" was called likely of a merge that forgot a term.
TEST(NamedConstants, AGuardIsLeftOutAtMost) {
  EXPECT_EQ(tried_for({1e-12f, "the literal 1e-12", true, true, false, "the"}), std::vector<Kind>{Kind::number_left_out});
}
TEST(NamedConstants, AFactorIsTriedInverted) {
  EXPECT_TRUE(has(tried_for({4, "the literal 4", true, true, false, "the"}), Kind::number_inverted));
  EXPECT_TRUE(has(tried_for({0x1p-16f, "the literal 1.5258789e-05", true, true, false, "the"}), Kind::number_inverted)) << "a scale";
  EXPECT_TRUE(has(tried_for({1e-5f, "film_rate", false, false, false, "film_rate"}), Kind::number_inverted)) << "a uniform";
}

// That a list stays empty is what is seen. It was called likely, and the search was over.
TEST(ListCauses, AnEmptyListIsNoLikelyCause) {
  MiniPort port("windshield-corrected");
  port.after = [](const PassCase& c, std::vector<capture::Array>& gave) {
    if (c.pass != "integrate") return;
    gave[0].width = 0;
    gave[0].levels[0].edit().clear();
  };
  ValidateOptions options;
  options.only = {"integrate"};
  options.explain = diagnose;
  const PassJudgement j = pass_of(judged(port, options), "integrate");
  EXPECT_EQ(j.status, Status::fail);
  ASSERT_FALSE(j.causes.empty());
  for (const Cause& c : j.causes) EXPECT_FALSE(c.is_likely && c.name == "drops not written") << c.sentence;
}

// What only has lines would otherwise stand before "not a number" or "made from the port's own", and a report says that the cause is
// unknown.
TEST(UnknownCause, GivesWayToAFoundOne) {
  const Cause lines{"cause unknown", ""}, nan{"not a number", "", 0, 4};
  std::vector<Cause> causes{lines, nan};
  keep_found(causes);
  ASSERT_EQ(causes.size(), 1u);
  EXPECT_EQ(causes[0].name, "not a number");
  causes = {lines};
  keep_found(causes);
  EXPECT_EQ(causes.size(), 1u);
}

}  // namespace
}  // namespace rainref::faults
