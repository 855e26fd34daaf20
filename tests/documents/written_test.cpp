// The printed formula is the judged formula: every pass, written from the documents alone, is judged PASS, and FAIL with one wrong
// constant.
#include <gtest/gtest.h>

#include "documents/judged_written.h"
#include "shipped_packs.h"

namespace rainref::documents {
namespace {

class PrintedFormulasOf : public testing::TestWithParam<rainref::test::PackPasses> {
 protected:
  const Pack pack{small_packs / GetParam().name};
  const std::string effect_and_variant = GetParam().effect_and_variant();
};

TEST_P(PrintedFormulasOf, AreThereForEachPass) {
  for (const std::string& pass : GetParam().passes) EXPECT_TRUE(written(effect_and_variant, pass)) << pass << " is written by nobody";
}

// Under ieee to the bit: the printed order of operations is the judged one.
TEST_P(PrintedFormulasOf, AreJudgedRight) {
  for (const char* profile : {"vulkan", "ieee"}) expect_pass(judged(pack, without_mistake, profile, GetParam().passes), effect_and_variant);
}

// What no port is judged by is compared here: floats in the printed order give the same bits.
TEST_P(PrintedFormulasOf, GiveTheDataToTheBit) {
  for (const PackCase& entry : pack.cases) {
    const Written* w = written(effect_and_variant, entry.pass);
    if (!w || !w->wrong.empty() || !GetParam().has(entry.pass)) continue;
    const PassCase c = pack.read(entry);
    const std::vector<capture::Array> arrays = given(*w, pack, c, "");
    for (std::size_t o = 0; o < arrays.size(); ++o) {
      EXPECT_EQ(c.outputs[o].judge, capture::Judge::input_only) << entry.pass;
      EXPECT_EQ(arrays[o].levels, c.outputs[o].array.levels) << c.folder() << ' ' << c.outputs[o].name;
    }
  }
}

TEST_P(PrintedFormulasOf, AreJudgedWrongWithOneWrongConstant) {
  const auto wrong_constant = [](const Written& w) { return w.wrong; };
  const PortJudgement j = judged(pack, wrong_constant, "vulkan", GetParam().passes);
  int wrong = 0;
  for (const PassJudgement& p : j.passes) {
    const Written* w = written(effect_and_variant, p.pass);
    if (!w || w->wrong.empty()) continue;
    EXPECT_EQ(p.status, Status::fail) << p.pass << ": " << w->wrong << ' ' << name(p.status) << ' ' << p.reason;
    ++wrong;
  }
  EXPECT_GT(wrong, 0);
}

INSTANTIATE_TEST_SUITE_P(SmallPacks, PrintedFormulasOf, testing::ValuesIn(rainref::test::proven_packs()), rainref::test::name_of_pack_test);

}  // namespace
}  // namespace rainref::documents
