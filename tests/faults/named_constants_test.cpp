// What is tried in place of a number of a pass.
#include <algorithm>

#include <gtest/gtest.h>

#include "faults/generators.h"

namespace rainref::faults {
namespace {

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

}  // namespace
}  // namespace rainref::faults
