// Causes are typed: their words, and how they are ranked, come from one catalogue.
#include "faults/what.h"

#include <set>

#include <gtest/gtest.h>

#include "math/perturbed.h"

namespace rainref::faults {
namespace {

std::vector<std::string> of_each(const char* end) {
  std::vector<std::string> out;
  for (int k = 0; k < 6; ++k) out.push_back("p" + std::to_string(k) + end);
  return out;
}

TEST(Words, EveryKindHasANameASentenceAndAHead) {
  for (auto kind = static_cast<int>(Kind::fused); kind < static_cast<int>(Kind::count); ++kind) {
    const What what{static_cast<Kind>(kind), of_each("")};
    EXPECT_FALSE(name_of(what).empty()) << kind;
    EXPECT_FALSE(sentence_of(what).empty()) << kind;
    EXPECT_FALSE(head_of(what).empty()) << kind;
    EXPECT_EQ((name_of(what) + sentence_of(what)).find_first_of("{}"), std::string::npos) << name_of(what) << ": " << sentence_of(what);
    EXPECT_TRUE(name_of(what).starts_with(head_of(what))) << name_of(what);
  }
}
TEST(Words, EveryFaultOfTheArithmeticHasItsKind) {
  const int first = static_cast<int>(perturbed::Fault::fused);
  const auto name = [&](perturbed::Fault f) { return name_of({behind(Kind::fused, static_cast<int>(f) - first)}); };
  EXPECT_EQ(name(perturbed::Fault::fused), "fused multiply-add");
  EXPECT_EQ(name(perturbed::Fault::normalize_missing), "normalize missing");
  EXPECT_EQ(name(perturbed::Fault::level_below), "mip level below");
}
TEST(Words, SayWhatAMistakeReaches) {
  What what{Kind::term_left_out, {"a + b", "b"}};
  EXPECT_EQ(name_of(what), "term left out: b");
  EXPECT_EQ(sentence_of(what), "of a + b the term b is left out");
  what.reach = Reach::both;
  EXPECT_EQ(name_of(what), "term left out: b, in both components");
  EXPECT_EQ(sentence_of(what), "of a + b the term b is left out, and so in the other component");
  what.reach = Reach::one_alike;
  what.where = {"3", "2"};
  EXPECT_EQ(name_of(what), "term left out: b");
  EXPECT_EQ(sentence_of(what), "of a + b the term b is left out (one of 3 alike, number 2)");
}
TEST(Words, OfAnExpressionTheNameKnowsWhatItLeavesOut) {
  EXPECT_EQ(gaps_in_name({Kind::term_left_out, {"... + ...", "... * b"}}), 1);
  EXPECT_TRUE(names_plain_numbers({Kind::condition_left_out, {"a", "b"}}));
  EXPECT_FALSE(names_plain_numbers({Kind::condition_left_out, {"abs(a)", "b"}}));
  EXPECT_FALSE(names_plain_numbers({Kind::condition_left_out, {"a or c", "b"}}));
}
// A number that has another value without a plain reason, and a literal that is rather typed wrong.
TEST(Words, NumbersAreRankedByTheirKind) {
  EXPECT_TRUE(What({Kind::number_times_pi, {"speed"}}).is_odd_number());
  EXPECT_FALSE(What({Kind::number_doubled, {"speed"}}).is_odd_number());
  EXPECT_FALSE(What({Kind::number_times_pi, {"speed"}, Reach::all}).is_odd_number());
  What fitted{Kind::another_value, {"the literal 4"}}, inverted{Kind::number_inverted, {"the literal 4"}};
  EXPECT_EQ(weight_of(fitted), 4);
  EXPECT_EQ(weight_of(inverted), 0);
  fitted.is_literal = inverted.is_literal = true;
  EXPECT_EQ(weight_of(fitted), 3);
  EXPECT_EQ(weight_of(inverted), 2);
}

}  // namespace
}  // namespace rainref::faults
