// One rounding of half stores for a whole port: how it is found, and what is said of a pass that has another.
#include "judge/half_votes.h"

#include <cmath>

#include <gmock/gmock.h>

#include "base/words.h"
#include "judge/mini_port.h"

namespace rainref::judge {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::vector<HalfMode> open{HalfMode::rne, HalfMode::rtz, HalfMode::either}, asked_rtz{HalfMode::rtz, HalfMode::rne};
HalfVotes votes(const char* pass, std::vector<std::int64_t> failing, const std::vector<HalfMode>& modes = open) {
  return {pass, modes, std::move(failing)};
}
FoundRounding found(const std::vector<HalfVotes>& all, std::size_t k, HalfMode asked = HalfMode::either) {
  return pass_rounding(all[k], all, asked, "some");
}

TEST(HalfVotes, FewestFailingPassesDecide) {
  EXPECT_EQ(port_rounding({votes("a", {0, 9, 0}), votes("b", {0, 0, 0})}), HalfMode::rne);
  EXPECT_EQ(port_rounding({votes("a", {9, 0, 0}), votes("b", {0, 0, 0})}), HalfMode::rtz);
  // A pass that is wrong either way weighs no more than another, however much of it is wrong.
  EXPECT_EQ(port_rounding({votes("a", {3, 0, 0}), votes("b", {5, 0, 0}), votes("bug", {100, 1000, 100})}), HalfMode::rtz);
  // One of each: the one that fewer invocations contradict.
  EXPECT_EQ(port_rounding({votes("a", {0, 7, 0}), votes("b", {9, 0, 0})}), HalfMode::rtz);
  // Nothing tells: the first.
  EXPECT_EQ(port_rounding({votes("a", {0, 0, 0})}), HalfMode::rne);
  EXPECT_EQ(port_rounding({votes("a", {0, 0}, asked_rtz)}), HalfMode::rtz);
  // Nothing fails: what has the reference's bits tells.
  HalfVotes truncated = votes("a", {0, 0, 0}), wrong = votes("b", {1, 0, 0});
  truncated.with_bits = {3, 90, 0};
  EXPECT_EQ(port_rounding({truncated}), HalfMode::rtz);
  truncated.with_bits = {90, 3, 0};
  EXPECT_EQ(port_rounding({truncated}), HalfMode::rne);
  EXPECT_EQ(port_rounding({truncated, wrong}), HalfMode::rtz) << "a failure weighs more";
  // Passes without halves have no vote.
  EXPECT_EQ(port_rounding({{"floats", {HalfMode::rne}, {5}}, votes("a", {4, 0, 0})}), HalfMode::rtz);
  EXPECT_EQ(port_rounding({{"data", {}, {}}}), HalfMode::either);
}

// A shade with a mistake, stored to nearest, was said to store toward zero: 6469 of its texels failed one way and 6465 the other.
TEST(HalfVotes, APassThatFailsEitherWaySaysNothingOfStores) {
  const std::vector<HalfVotes> all{votes("wave_step", {0, 11313, 0}), votes("shade", {6469, 6465, 6465})};
  EXPECT_EQ(port_rounding(all), HalfMode::rne);
  EXPECT_EQ(found(all, 1).mode, 0u);
  EXPECT_EQ(found({votes("shade", {6469, 6465, 6465})}, 0).mode, 0u) << "alone: a difference of a tenth decides";
  EXPECT_EQ(found({votes("shade", {6000, 5400, 5400})}, 0).mode, 1u);
  EXPECT_EQ(found({votes("shade", {6000, 5401, 5401})}, 0).mode, 0u);
}

// Six invocations fewer of thousands are chance; nearly twice as many of the reference's bits are not.
TEST(HalfVotes, BitsDecideWherePassesDoNot) {
  HalfVotes both = votes("both", {0, 0, 0}), wrong = votes("wrong", {1264, 1258, 1258});
  both.with_bits = {900, 500, 900};
  EXPECT_EQ(port_rounding({wrong, both}), HalfMode::rne);
  both.with_bits = {500, 900, 900};
  EXPECT_EQ(port_rounding({wrong, both}), HalfMode::rtz);
  EXPECT_EQ(port_rounding({votes("wrong", {1000, 1200, 1000}), both}), HalfMode::rtz);
  EXPECT_EQ(port_rounding({wrong, both, votes("a", {0, 3, 0})}), HalfMode::rne) << "a pass weighs more";
}

TEST(HalfVotes, APassThatFitsBothFollowsThePort) {
  const std::vector<HalfVotes> all{votes("a", {8, 0, 0}), votes("b", {0, 0, 0})};
  for (std::size_t k : {0, 1}) {
    EXPECT_EQ(found(all, k).mode, 1u);
    EXPECT_EQ(found(all, k).doubt, "");
  }
}

TEST(HalfVotes, APassThatFitsOnlyTheOtherIsDoubtedAndBothAreNamed) {
  const std::vector<HalfVotes> all{votes("a", {8, 0, 0}), votes("odd", {0, 6, 0}), votes("b", {5, 0, 0}), votes("both", {0, 0, 0})};
  EXPECT_EQ(found(all, 1).mode, 0u);
  EXPECT_EQ(found(all, 1).doubt, "stores to binary16 round to nearest in this pass and toward zero in a, b: a port has one rounding");
  for (std::size_t k : {0, 2, 3}) EXPECT_EQ(found(all, k).doubt, "");
}

// An H100 truncates what it stores, while the shader of splat as published rounds each sum to nearest: its port was a WARN.
TEST(HalfVotes, APassThatRoundsInsideHasNoVoteAndNoDoubt) {
  HalfVotes inside = votes("splat", {0, 430, 0});
  inside.rounds_inside = true;
  const std::vector<HalfVotes> all{votes("a", {8, 0, 0}), inside};
  EXPECT_EQ(port_rounding(all), HalfMode::rtz);
  EXPECT_EQ(found(all, 0).doubt, "");
  EXPECT_EQ(found(all, 1).mode, 0u);
  EXPECT_EQ(found(all, 1).doubt, "");
  EXPECT_EQ(port_rounding({inside}), HalfMode::either);
  EXPECT_EQ(found({inside}, 0).mode, 0u) << "alone it is judged by the way that it fits";
  HalfVotes few = inside;
  few.failing = {9, 0, 0};
  EXPECT_EQ(found({few}, 0).mode, 1u);
}

TEST(HalfVotes, AMixtureIsOneOnlyWhereBothFail) {
  EXPECT_EQ(found({votes("a", {4, 5, 0})}, 0).mode, 2u);
  EXPECT_EQ(found({votes("a", {4, 5, 0})}, 0).doubt, "some stores to binary16 round to nearest and some toward zero");
  // Wrong in every way: shown under that which fits best.
  EXPECT_EQ(found({votes("a", {5, 4, 1})}, 0).mode, 1u);
  EXPECT_EQ(found({votes("a", {5, 4, 1})}, 0).doubt, "");
}

TEST(HalfVotes, WhatTheProfileAsksForIsSaid) {
  const std::vector<HalfVotes> all{votes("a", {8, 0}, asked_rtz), votes("both", {0, 0}, asked_rtz), votes("obeys", {0, 3}, asked_rtz),
                                   votes("b", {2, 0}, asked_rtz)};
  EXPECT_EQ(found(all, 0, HalfMode::rtz).doubt, "stores to binary16 round to nearest, where the profile some asks for toward zero");
  EXPECT_EQ(found(all, 1, HalfMode::rtz).doubt, "");
  EXPECT_EQ(found(all, 2, HalfMode::rtz).doubt,
            "stores to binary16 round toward zero in this pass and to nearest in a, b: a port has one rounding");
}

// ---- what was not asked ----------------------------------------------------------------------------------------------
HalfVotes least(const char* pass, std::vector<std::int64_t> failing, std::vector<std::int64_t> undecided,
                const std::vector<HalfMode>& modes = open) {
  HalfVotes v = votes(pass, std::move(failing), modes);
  v.undecided = std::move(undecided);
  return v;
}

TEST(UndecidedVotes, APortThatFitsTheFirstRoundingThroughoutNeedsNoMore) {
  EXPECT_FALSE(first_undecided({least("a", {0, 0, 0}, {0, 900, 0}), least("b", {0, 3, 0}, {0, 900, 0})}, HalfMode::either));
}
TEST(UndecidedVotes, OneThatFitsTheSecondNeedsAPassThatTells) {
  const HalfVotes unknown = least("a", {0, 0, 0}, {900, 0, 0}), tells = least("b", {3, 0, 0}, {900, 0, 0});
  EXPECT_EQ(first_undecided({unknown, unknown}, HalfMode::either), 0u);
  EXPECT_FALSE(first_undecided({unknown, tells}, HalfMode::either));
  // A profile that asks for the first has a doubt to tell of each pass that fails by it.
  EXPECT_EQ(first_undecided({least("b", {3, 0}, {900, 0}, asked_rtz), least("a", {0, 0}, {900, 0}, asked_rtz)}, HalfMode::rtz), 1u);
}
TEST(UndecidedVotes, AWrongPassBesideOthersNeedsNoMoreWhereOneTells) {
  const HalfVotes wrong = least("wrong", {40, 38, 38}, {0, 900, 0}), other = least("a", {0, 0, 0}, {0, 900, 0});
  EXPECT_FALSE(first_undecided({wrong, other, least("b", {0, 7, 0}, {0, 900, 0})}, HalfMode::either));
  EXPECT_EQ(first_undecided({wrong, other}, HalfMode::either), 1u) << "files of other passes could have to tell";
  HalfVotes with_bits = other;
  with_bits.with_bits = {500, 20, 500};
  EXPECT_FALSE(first_undecided({wrong, with_bits}, HalfMode::either)) << "bits tell";
}

// Where nothing is to be asked, whatever the rest holds changes nothing that is found.
TEST(UndecidedVotes, WhatIsFoundHoldsForEveryRest) {
  rainref::test::Words words(7);
  const auto below = [&](std::uint64_t end) { return static_cast<std::int64_t>(words() % end); };
  int settled = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const bool is_asked = words.coin();
    const std::vector<HalfMode>& modes = is_asked ? asked_rtz : open;
    const HalfMode asked = is_asked ? HalfMode::rtz : HalfMode::either;
    std::vector<HalfVotes> all;
    for (std::int64_t k = 1 + below(3); k > 0; --k) {
      HalfVotes v = votes(k == 1 ? "one" : k == 2 ? "two" : "three", {}, modes);
      v.rounds_inside = below(4) == 0;
      const std::size_t leading = words() % 2;
      for (std::size_t m = 0; m < modes.size(); ++m) {
        v.failing.push_back(words.coin() ? 0 : below(20));
        v.undecided.push_back(m == leading || words.coin() ? 0 : below(12));
        v.with_bits.push_back(below(words.coin() ? 3 : 60));
      }
      all.push_back(std::move(v));
    }
    if (const auto k = first_undecided(all, asked)) {
      ASSERT_FALSE(all.at(*k).is_whole()) << "nothing more can be asked of it";
      continue;
    }
    ++settled;
    for (int rest = 0; rest < 20; ++rest) {
      std::vector<HalfVotes> known = all;
      for (HalfVotes& v : known)
        for (std::size_t m = 0; m < modes.size(); ++m) v.failing[m] += below(static_cast<std::uint64_t>(v.undecided[m]) + 1);
      EXPECT_EQ(port_rounding(known), port_rounding(all));
      EXPECT_EQ(is_rounding_open(known), is_rounding_open(all));
      for (std::size_t k = 0; k < all.size(); ++k) {
        const FoundRounding a = found(all, k, asked), b = found(known, k, asked);
        EXPECT_EQ(a.mode, b.mode);
        EXPECT_EQ(a.doubt, b.doubt);
        EXPECT_EQ(all[k].undecided[a.mode], 0) << "the failures that are reported are counted";
      }
    }
  }
  EXPECT_GT(settled, 2000);
}

// ---- whole ports ---------------------------------------------------------------------------------------------------
PortJudgement truncating(const char* stores_only, const ValidateOptions& options = {}) {
  MiniPort port("windshield-corrected");
  port.stores = HalfMode::rtz;
  port.stores_only = stores_only;
  return judged(port, options);
}

TEST(PortRounding, TwoPassesThatDifferAreAWarning) {
  const PortJudgement j = truncating("normals");
  EXPECT_EQ(j.status, Status::warn) << why(j);
  const PassJudgement& odd = pass_of(j, "normals");
  EXPECT_EQ(odd.status, Status::warn) << why(j);
  EXPECT_EQ(odd.half_mode, HalfMode::rtz);
  EXPECT_THAT(odd.reason, AllOf(HasSubstr("round toward zero in this pass and to nearest in"), HasSubstr("composite")));
  for (const char* pass : {"splat", "wipe_texture", "composite"}) {
    EXPECT_EQ(pass_of(j, pass).status, Status::pass) << why(j);
    EXPECT_EQ(pass_of(j, pass).half_mode, HalfMode::rne) << pass;
  }
}
// By --only such a pass was a PASS: the others had no vote.
TEST(PortRounding, OnePassThatDiffersIsAWarningByItselfToo) {
  ValidateOptions options;
  options.only = {"normals"};
  const PassJudgement odd = pass_of(truncating("normals", options), "normals");
  EXPECT_EQ(odd.status, Status::warn) << odd.reason;
  EXPECT_EQ(odd.half_mode, HalfMode::rtz);
  EXPECT_THAT(odd.reason, AllOf(HasSubstr("round toward zero in this pass and to nearest in"), HasSubstr("composite")));
}
TEST(PortRounding, APortThatTruncatesThroughoutPasses) {
  const PortJudgement j = truncating("");
  EXPECT_EQ(j.status, Status::pass) << why(j);
  for (const char* pass : {"normals", "composite"}) EXPECT_EQ(pass_of(j, pass).half_mode, HalfMode::rtz) << pass;
}

TEST(HalfVotes, OthersAreAskedWhereAPassFailsEitherWayAndNoneTells) {
  EXPECT_TRUE(is_rounding_open({votes("wrong", {9, 8, 7})}));
  EXPECT_TRUE(is_rounding_open({votes("wrong", {9, 8, 7}), votes("both", {0, 0, 0})}));
  EXPECT_FALSE(is_rounding_open({votes("wrong", {9, 8, 7}), votes("a", {8, 0, 0})}));
  EXPECT_FALSE(is_rounding_open({votes("both", {0, 0, 0})}));
  HalfVotes bits = votes("both", {0, 0, 0}), few = bits;
  bits.with_bits = {100, 180, 180};
  few.with_bits = {100, 110, 110};
  EXPECT_FALSE(is_rounding_open({votes("wrong", {9, 8, 7}), bits}));
  EXPECT_TRUE(is_rounding_open({votes("wrong", {9, 8, 7}), few}));
  EXPECT_FALSE(is_rounding_open({{"floats", {HalfMode::rne}, {5}}}));
}

// A port that truncates, judged by one pass that is wrong: its failures cannot tell, the other passes' files can.
TEST(HalfVotes, OnePassAloneIsJudgedByTheRoundingOfTheWholePort) {
  MiniPort port("windshield-as-published");
  port.stores = HalfMode::rtz;
  const std::size_t keep = uniform_offset(port.pack, "wipe_texture", "keep");
  port.before = [&](capture::PassCase& c) {
    if (c.pass == "wipe_texture") change_at<float>(c.uniforms.data() + keep, [](float v) { return std::sqrt(v); });
  };
  TemporaryFolder folder;
  port.run(folder.path());
  ValidateOptions options;
  options.explain = faults::diagnose;
  options.executor = &test_executor();
  const PassJudgement whole = pass_of(validate(port.pack, folder.path(), options), "wipe_texture");
  options.only = {"wipe_texture"};
  const PortJudgement j = validate(port.pack, folder.path(), options);
  EXPECT_EQ(j.passes.size(), 1u);
  EXPECT_TRUE(j.notes.empty());
  const PassJudgement alone = pass_of(j, "wipe_texture");
  EXPECT_EQ(whole.half_mode, HalfMode::rtz);
  EXPECT_EQ(alone.half_mode, HalfMode::rtz);
  ASSERT_FALSE(whole.causes.empty());
  ASSERT_FALSE(alone.causes.empty());
  EXPECT_EQ(alone.causes[0].name, whole.causes[0].name);
  // Where the others' files are missing or no files, nothing tells, and nothing is said of them.
  for (const capture::PackCase& entry : port.pack.cases)
    if (entry.pass != "wipe_texture") std::filesystem::remove_all(folder / entry.id);
  EXPECT_TRUE(validate(port.pack, folder.path(), options).files.empty());
}

}  // namespace
}  // namespace rainref::judge
