// A port that stores what the packs expect passes under every profile, in every pass.
#include <algorithm>

#include <gtest/gtest.h>

#include "faults/diagnose.h"
#include "judge/mini_port.h"
#include "judge/profiles.h"
#include "judge/support.h"
#include "reports/example_judgement.h"

namespace rainref::judge {
namespace {

class OwnOutputs : public testing::TestWithParam<test::PackPasses> {};
INSTANTIATE_TEST_SUITE_P(Packs, OwnOutputs, testing::ValuesIn(test::proven_packs()), test::name_of_pack_test);

TEST_P(OwnOutputs, PassUnderEveryProfile) {
  const TemporaryFolder folder;
  const capture::Pack pack(test::pack_folder(GetParam().name));
  reports::write_port(pack, folder.path());
  for (const std::string& profile_name : profile_names()) {
    ValidateOptions options;
    options.profile = profile_name;
    options.only = GetParam().passes;
    options.executor = &test_executor();
    options.explain = faults::diagnose;
    const PortJudgement j = validate(pack, folder.path(), options);
    EXPECT_EQ(j.passes.size(), GetParam().passes.size());
    for (const PassJudgement& p : j.passes) {
      const std::string what = GetParam().effect_and_variant() + " " + p.pass;
      std::vector<Status> expected{what == "puddle-as-published ground_noise" ? Status::data : Status::pass};
      // It asks for stores toward zero, which the reference does not make.
      if (profile_name == "d3d") expected.push_back(Status::warn);
      // The article's march has rays without a useful bound.
      if (what == "puddle-as-published surface_hit" && profile_name != "ieee") expected.push_back(Status::untested);
      EXPECT_NE(std::find(expected.begin(), expected.end(), p.status), expected.end()) << what << '\n' << why(j);
      for (const CaseJudgement& c : p.cases)
        for (const OutputJudgement& o : c.outputs) EXPECT_EQ(o.differing, 0) << c.id << ' ' << o.name;
    }
  }
}

}  // namespace
}  // namespace rainref::judge
