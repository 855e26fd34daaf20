// The recorded hashes of every pass, variant and storage.
#include <gtest/gtest.h>

#include "golden/golden_check.h"
#include "rainy_glass/golden_scenes.h"

namespace rainref::rainy_glass {
namespace {

class RainyGlassGolden : public testing::TestWithParam<GoldenScene> {};

TEST_P(RainyGlassGolden, HashesAreAsRecorded) { golden::expect_as_recorded(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Scenes, RainyGlassGolden, testing::ValuesIn(golden_scenes()),
                         [](const auto& param) { return golden::test_name(param); });

TEST(RainyGlassGoldenFile, EveryRecordedLineBelongsToAScene) { golden::expect_every_line_has_a_scene("rainy_glass", golden_scenes()); }

}  // namespace
}  // namespace rainref::rainy_glass
