// The recorded hashes of every pass, variant and storage.
#include <gtest/gtest.h>

#include "golden/golden_check.h"
#include "puddle/golden_scenes.h"

namespace rainref::puddle {
namespace {

class Golden : public testing::TestWithParam<GoldenScene> {};

TEST_P(Golden, HashesAreAsRecorded) { golden::expect_as_recorded(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Puddle, Golden, testing::ValuesIn(golden_scenes()), [](const auto& param) { return golden::test_name(param); });

TEST(Golden, EveryRecordedLineBelongsToAScene) { golden::expect_every_line_has_a_scene("puddle", golden_scenes()); }

}  // namespace
}  // namespace rainref::puddle
