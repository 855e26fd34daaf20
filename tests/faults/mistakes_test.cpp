// How often the diagnosis is right, measured with mistakes that it does not know: passes written by hand, wrong in one thing.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "faults/hand_port.h"
#include "faults/mistakes_kept_aside.h"

namespace rainref::faults {
namespace {

using namespace judge;
using capture::Array;
using capture::PassCase;
using hand::given, hand::known_passes, hand::measures_all;

/// It, judged.
PassJudgement judged(const hand::Pass& p, const std::string& mistake) {
  const capture::Pack pack(small_packs / p.pack);
  TemporaryFolder folder;
  for (const capture::PackCase& entry : pack.cases) {
    if (entry.pass != p.pass) continue;
    const PassCase c = pack.read(entry);
    const std::vector<Array> out = given(p, pack, c, mistake);
    for (std::size_t o = 0; o < out.size(); ++o) put_array(folder / c.folder(), "out." + c.outputs[o].name, out[o]);
  }
  ValidateOptions options;
  options.only = {p.pass};
  options.explain = faults::diagnose;
  options.executor = &test_executor();
  return pass_of(validate(pack, folder.path(), options), p.pass);
}

bool is_right(const hand::Mistake& m, const Cause& c) {
  return std::any_of(m.causes.begin(), m.causes.end(), [&](const std::string& part) {
    return part[0] == '=' ? c.name == part.substr(1) : c.name.find(part) != std::string::npos;
  });
}

// Without a mistake a hand-made pass is a correct port: what it is wrong in is the mistake alone. Those of tests/documents are judged
// there.
TEST(HandMade, APassWithoutAMistakePasses) {
  for (const hand::Pass& p : known_passes()) {
    const PassJudgement j = judged(p, "");
    EXPECT_EQ(j.status, Status::pass) << p.pack << ' ' << p.pass << ' ' << j.reason << ' ' << j.where
                                      << (j.causes.empty() ? "" : j.causes[0].name);
  }
}

// It changes 253 of 1470 texels of windshield-as-published, by up to .0195, and is inside all of their envelopes: what a sampler may round
// hides it there. Strong refraction before a sharp picture shows it.
TEST(HandMade, AnOffsetThatDoesNotFadeWithTheDropFailsWhereRefractionIsStrong) {
  const hand::Pass strong{"windshield-refraction", "composite", hand::composite_published, {}};
  EXPECT_EQ(judged(strong, "").status, Status::pass);
  const PassJudgement j = judged(strong, "offset does not fade");
  EXPECT_EQ(j.status, Status::fail) << j.reason;
}

struct Tally {
  int count = 0, right = 0, right_and_likely = 0, wrong_likely = 0, unknown = 0;
};
/// Every mistake, with a table, where all are measured; else every thirtieth.
Tally measured(const std::vector<hand::Pass>& passes) {
  const bool prints = measures_all();
  int number = 0;
  Tally t;
  for (const hand::Pass& p : passes) {
    for (const hand::Mistake& m : p.mistakes) {
      if (number++ % 30 != 0 && !measures_all()) continue;
      const PassJudgement j = judged(p, m.mistake);
      EXPECT_EQ(j.status, Status::fail) << p.pack << ' ' << p.pass << ": " << m.mistake;
      const bool is_named = !j.causes.empty(), is_likely = is_named && j.causes[0].is_likely, first = is_named && is_right(m, j.causes[0]);
      ++t.count;
      t.right += first;
      t.right_and_likely += first && is_likely;
      t.wrong_likely += is_likely && !first;
      t.unknown += !is_named;
      if (!prints) continue;
      fmt::print("{:<8}{} {}: {}\n", first ? "right" : is_likely ? "WRONG" : is_named ? "may be" : "unknown", p.pack, p.pass, m.mistake);
      if (!j.where.empty()) fmt::print("        where: {}\n", j.where);
      for (const Cause& c : j.causes)
        fmt::print("        {} {}: {} ({} exact, {} near of {})\n", c.is_likely ? "likely" : "may be", c.name, c.sentence, c.explained,
                   c.inside, c.of);
    }
  }
  fmt::print(
      "{} mistakes: the first cause is right for {} ({:.0f} %), {} of these are called likely; a wrong one is called likely for {} ({:.1f} "
      "%); "
      "unknown {}\n",
      t.count, t.right, 100.0 * t.right / t.count, t.right_and_likely, t.wrong_likely, 100.0 * t.wrong_likely / t.count, t.unknown);
  return t;
}

// What is reached: 142 and 17 of 176, far from the 3 % wrong and likely that are aimed at (151 and 0 of 170 before the mistakes of ports
// were learned from). The share of every thirtieth is coarse.
TEST(HandMade, MostMistakesAreNamedFirstAndHardlyAWrongOneIsCalledLikely) {
  const Tally t = measured(known_passes());
  EXPECT_GE(t.count, measures_all() ? 165 : 5);
  EXPECT_GE(t.right * 100, t.count * (measures_all() ? 80 : 70));
  EXPECT_LE(t.wrong_likely * 100, measures_all() ? t.count * 10 : 100);
}
// What is reached: 61 and 18 of 95, far from the 80 % and 3 % that are aimed at. Some of the 18 are the same mistake in words that
// were not foreseen; they count as wrong all the same.
TEST(HandMade, SoAreMistakesThatWereKeptAside) {
  const Tally t = measured(hand::passes_kept_aside());
  EXPECT_GE(t.count, measures_all() ? 90 : 3);
  EXPECT_GE(t.right * 100, t.count * (measures_all() ? 60 : 30));
  EXPECT_LE(t.wrong_likely * 100, t.count * (measures_all() ? 19 : 60));
}

}  // namespace
}  // namespace rainref::faults
