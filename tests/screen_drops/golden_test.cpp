// The recorded hashes of every pass, variant and rounding.
#include <gtest/gtest.h>

#include "golden/golden_check.h"
#include "screen_drops/golden_scenes.h"

namespace rainref::screen_drops {
namespace {

class ScreenDropsGolden : public testing::TestWithParam<GoldenScene> {};

TEST_P(ScreenDropsGolden, HashesAreAsRecorded) { golden::expect_as_recorded(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Scenes, ScreenDropsGolden, testing::ValuesIn(golden_scenes()),
                         [](const auto& param) { return golden::test_name(param); });

TEST(ScreenDropsGoldenFile, EveryRecordedLineBelongsToAScene) { golden::expect_every_line_has_a_scene("screen_drops", golden_scenes()); }

}  // namespace
}  // namespace rainref::screen_drops
