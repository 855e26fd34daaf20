// Which of several causes is believed, and when the first is called likely.
#include "faults/diagnosis.h"

#include <cstring>
#include <map>
#include <memory>

#include <gtest/gtest.h>

#include "faults/diagnose.h"

namespace rainref::faults {
namespace {

using judge::Cause;

/// A mistake whose words say nothing; "another value of c" is a number fitted to what the port stored.
What what_of(const std::string& name) {
  What what;
  if (name == "another value of c")
    what = {Kind::another_value, {"c"}};
  else
    what.name = name;
  return what;
}

/// A run of 100 failing texels of which each mistake explains so many, and what each gives elsewhere.
class Told : public Replay {
 public:
  std::map<std::string, int> first, second, third;
  std::map<std::string, double> misfits;
  std::map<std::string, std::vector<float>> numbers;
  int asked_for_more = 0;

  std::vector<Fault> plain() override { return of(first); }
  std::vector<Fault> deeper() override { return ++asked_for_more, of(second); }
  std::vector<Fault> fitted() override { return ++asked_for_more, of(third); }
  std::vector<Tried> causes(const std::vector<Fault>& all) const override {
    std::vector<Tried> out;
    for (const Fault& d : all)
      for (const auto* stage : {&first, &second, &third})
        if (const auto at = stage->find(name_of(d)); at != stage->end()) {
          const auto left = misfits.find(name_of(d));
          out.push_back({d, {"", "", at->second, 100, at->second, false, true}, left == misfits.end() ? 0 : left->second});
          out.back().fault = &d;
        }
    return out;
  }
  std::unique_ptr<Replay> elsewhere() const override { return std::make_unique<Told>(*this); }
  std::vector<float> given(const Fault& d) const override { return numbers.at(d.name); }

 private:
  static std::vector<Fault> of(const std::map<std::string, int>& stage) {
    std::vector<Fault> out;
    for (const auto& [name, explained] : stage) out.emplace_back(what_of(name));
    return out;
  }
};

TEST(Replay, OneCauseThatExplainsAllIsLikelyAndNothingElseIsAsked) {
  Told run;
  run.first = {{"a", 100}, {"b", 60}};
  run.second = {{"c", 100}};
  const std::vector<Cause> causes = diagnosed(run, nullptr);
  ASSERT_FALSE(causes.empty());
  EXPECT_EQ(causes[0].name, "a");
  EXPECT_TRUE(causes[0].is_likely);
  EXPECT_EQ(run.asked_for_more, 0);
}
TEST(Replay, PastTheLimitTheBestSoFarIsSaidAndNoneIsLikely) {
  Told run;
  run.first = {{"a", 100}, {"b", 60}};
  run.second = {{"c", 100}};
  const SearchLimit far(1e6), over(1e-12);
  run.limit(far);
  EXPECT_TRUE(diagnosed(run, nullptr)[0].is_likely);
  EXPECT_FALSE(far.was_met());
  run.limit(over);
  EXPECT_EQ(diagnosed(run, nullptr)[0].name, "a");
  EXPECT_FALSE(diagnosed(run, nullptr)[0].is_likely);
  run.first = {{"b", 60}};
  EXPECT_EQ(diagnosed(run, nullptr)[0].name, "b");
  EXPECT_EQ(run.asked_for_more, 0);
  EXPECT_TRUE(over.was_met());
  // Nothing is known of what there is no time for.
  const parallel::Executor executor(1);
  int asked = 0;
  const auto ask = [&](const Fault& d) { return ++asked, untried(d, 100, false); };
  EXPECT_EQ(tried(run, executor, {Fault(what_of("a"))}, 100, false, ask).size(), 1u);
  EXPECT_EQ(asked, 0);
  run.limit(far);
  static_cast<void>(tried(run, executor, {Fault(what_of("a"))}, 100, false, ask));
  EXPECT_EQ(asked, 1);
}
TEST(Replay, MoreIsAskedWherePlainCausesExplainLittle) {
  Told run;
  run.first = {{"a", 60}};
  run.second = {{"b", 70}};
  run.third = {{"another value of c", 100}};
  EXPECT_EQ(diagnosed(run, nullptr)[0].name, "another value of c");
  EXPECT_EQ(run.asked_for_more, 2);
}
// The same mistake by another name is no rival.
TEST(Replay, ARivalIsAnotherMistakeElsewhere) {
  Told run;
  run.first = {{"a", 100}, {"b", 100}};
  run.numbers = {{"", {0, 0}}, {"a", {1, 2}}, {"b", {1, 2}}};
  EXPECT_TRUE(diagnosed(run, nullptr)[0].is_likely);
  run.numbers["b"] = {1, 3};
  EXPECT_EQ(diagnosed(run, nullptr)[0].name, "a");
  EXPECT_FALSE(diagnosed(run, nullptr)[0].is_likely);
}
// Where neither shows they are alike whatever they are; most of a picture may be so.
TEST(Replay, ARivalIsLookedForWhereTheMistakesShow) {
  Told run;
  run.first = {{"a", 100}, {"b", 100}};
  std::vector<float> numbers(1000, 7.0f);
  run.numbers[""] = run.numbers["a"] = numbers;
  run.numbers["a"][0] = 8;
  run.numbers["b"] = run.numbers["a"];
  EXPECT_TRUE(diagnosed(run, nullptr)[0].is_likely);
  run.numbers["b"][0] = 9;
  EXPECT_FALSE(diagnosed(run, nullptr)[0].is_likely);
}
// Within wide envelopes several mistakes come near; the one that is meant leaves hardly anything.
TEST(Replay, OfCausesThatComeNearTheNearestIsTaken) {
  Told run;
  run.first = {{"a", 100}, {"b", 100}};
  run.misfits = {{"a", 0.3}, {"b", 0.01}};
  run.numbers = {{"", {0}}, {"a", {1}}, {"b", {2}}};
  EXPECT_EQ(diagnosed(run, nullptr)[0].name, "b");
  EXPECT_TRUE(diagnosed(run, nullptr)[0].is_likely);
}
// What passed tells too: of two that explain what fails the one that leaves it as it is is meant, however far-fetched.
TEST(Replay, OfCausesThatExplainAsMuchTheOneThatBreaksNothingIsTaken) {
  const auto cause = [](What what, std::int64_t bad) {
    Tried t(std::move(what), {"", "", 40, 100, 99, false, true}, 0.01);
    t.bad = bad;
    return t;
  };
  const What difference{Kind::difference_the_other_way, {"a - b"}}, input{Kind::input_is_another, {"a", "b"}};
  EXPECT_EQ(best_causes({cause(difference, 12), cause(input, 0)})[0].name, "input a is b");
  EXPECT_EQ(best_causes({cause(difference, 0), cause(input, 0)})[0].name, "difference the other way: a - b");
}
// A channel that is never written is as plain as what can be left out in few places.
TEST(Replay, AChannelThatIsNeverWrittenIsPlain) {
  const auto how_far = [](Kind kind) { return far_fetched(Tried(What{kind, {"drops", "z"}}, {"", "", 1, 1, 1, true, true})); };
  EXPECT_LT(how_far(Kind::output_without_channel), 0);
  EXPECT_EQ(how_far(Kind::input_without_channel), 0);
  EXPECT_EQ(how_far(Kind::drawn), 0);
}
// A list that is as it was before the pass: many mistakes keep a pass from doing anything.
TEST(Replay, WhereNothingWasDoneNoCauseIsLikely) {
  const auto cause = [](Kind kind) { return Tried(What{kind, {"count"}}, {"", "", 48, 48, 48, true, true}); };
  EXPECT_TRUE(best_causes({cause(Kind::uniform_is_zero)})[0].is_likely);
  EXPECT_FALSE(best_causes({cause(Kind::uniform_is_zero), cause(Kind::list_one_step_late)})[0].is_likely);
}
TEST(Replay, AFittedNumberIsNoRivalOfAMistakeWithAName) {
  const auto cause = [](const char* name, int exact) { return Tried(what_of(name), {"", "", exact, 100, 100, false, true}, 0.001); };
  EXPECT_EQ(best_causes({cause("a", 10), cause("another value of c", 40)})[0].name, "a");
  EXPECT_EQ(best_causes({cause("a", 10), cause("another value of c", 95)})[0].name, "another value of c");
}
TEST(Replay, WhatExplainsBothRunsIsBelieved) {
  Told run, other;
  run.first = {{"a", 100}, {"b", 100}};
  run.numbers = {{"", {0}}, {"a", {1}}, {"b", {2}}};
  other.first = {{"a", 10}, {"b", 100}};
  const std::vector<Cause> causes = diagnosed(run, &other);
  EXPECT_EQ(causes[0].name, "b");
  EXPECT_TRUE(causes[0].is_likely);
  EXPECT_EQ(causes[0].of, 200);
  EXPECT_EQ(causes[0].explained, 200);
}
// Where nothing explains the other run, it shows something else.
TEST(Replay, AnotherRunThatNothingExplainsDecidesNothing) {
  Told run, other;
  run.first = {{"a", 100}};
  other.first = {{"a", 0}};
  EXPECT_EQ(diagnosed(run, &other)[0].of, 100);
  EXPECT_TRUE(diagnosed(run, &other)[0].is_likely);
}

// The same failures judged by another rounding: what explains nothing under one is not tried under the other.
TEST(Replay, ASecondRoundingIsSearchedAmongWhatExplainsSomethingByTheFirst) {
  Told run, by_other;
  run.first = {{"a", 40}, {"b", 0}};
  run.second = {{"c", 60}, {"d", 5}};
  by_other.first = {{"a", 90}, {"b", 100}};
  by_other.second = {{"c", 100}, {"d", 100}};
  run.numbers = by_other.numbers = {{"", {0}}, {"a", {1}}, {"b", {2}}, {"c", {3}}, {"d", {4}}};
  Diagnosis first(run, nullptr);
  first.search();
  Diagnosis second(by_other, nullptr);
  second.search_among(first);
  const std::vector<Cause> causes = second.causes();
  ASSERT_FALSE(causes.empty());
  EXPECT_EQ(causes[0].name, "c");
  for (const Cause& c : causes) EXPECT_TRUE(c.name == "a" || c.name == "c") << c.name;
  EXPECT_EQ(by_other.asked_for_more, 0);
}
// The rounding may make the other run the one with most failures: its mistakes of the same names are tried.
TEST(Replay, ASecondRoundingMayBeginWithTheOtherRun) {
  Told run, other;
  run.first = {{"a", 60}, {"b", 0}};
  other.first = {{"a", 70}, {"b", 100}};
  run.numbers = other.numbers = {{"", {0}}, {"a", {1}}, {"b", {2}}};
  Diagnosis first(run, &other);
  first.search();
  run.first = {{"a", 100}, {"b", 100}};
  other.first = {{"a", 90}, {"b", 100}};
  Diagnosis second(other, &run);
  second.search_among(first, true);
  const std::vector<Cause> causes = second.causes();
  ASSERT_EQ(causes.size(), 1u);
  EXPECT_EQ(causes[0].name, "a");
  EXPECT_EQ(causes[0].explained, 190);
  EXPECT_EQ(causes[0].of, 200);
}

TEST(Replay, AVariedCaseHasOtherNumbers) {
  capture::PackPass pass;
  scene::Member m;
  m.name = "gain";
  m.scalar = scene::Scalar::float32;
  m.components = 1;
  m.offset = 0;
  pass.block.members = {m};
  capture::PassCase c;
  c.uniforms.resize(4);
  const float gain = 2;
  std::memcpy(c.uniforms.data(), &gain, 4);
  float other;
  std::memcpy(&other, varied(pass, c).uniforms.data(), 4);
  EXPECT_GT(other, 2);
  EXPECT_LT(other, 2.5f);
}

}  // namespace
}  // namespace rainref::faults
