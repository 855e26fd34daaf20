// The envelopes are tight: no more than a few times as wide as what conforming devices really spread over, before
// storage.
#include "judge/spread.h"

namespace rainref::judge {
namespace {

using namespace test;

class Tightness : public testing::TestWithParam<PackPasses> {};

TEST_P(Tightness, TheMedianEnvelopeIsAtMostFourTimesTheSpread) { expect_tight(enveloped_passes({GetParam()})); }

INSTANTIATE_TEST_SUITE_P(Packs, Tightness, testing::ValuesIn(proven_packs()), name_of_pack_test);

}  // namespace
}  // namespace rainref::judge
