// The recorded hashes of every pass, variant and rounding.
#include <gtest/gtest.h>

#include "edge_splash/golden_scenes.h"
#include "golden/golden_check.h"

namespace rainref::edge_splash {
namespace {

class Golden : public testing::TestWithParam<GoldenScene> {};

TEST_P(Golden, HashesAreAsRecorded) { golden::expect_as_recorded(GetParam()); }

INSTANTIATE_TEST_SUITE_P(EdgeSplash, Golden, testing::ValuesIn(golden_scenes()),
                         [](const auto& param) { return golden::test_name(param); });

TEST(Golden, EveryRecordedLineBelongsToAScene) { golden::expect_every_line_has_a_scene("edge_splash", golden_scenes()); }

}  // namespace
}  // namespace rainref::edge_splash
