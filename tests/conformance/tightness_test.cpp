// The envelopes are tight: no more than a few times as wide as what conforming devices really spread over, before
// storage.
#include "conformance/spread.h"

namespace rainref::conformance {
namespace {

using namespace test;

TEST(Tightness, TheMedianEnvelopeIsAtMostFourTimesTheSpread) { expect_tight(enveloped_passes()); }

}  // namespace
}  // namespace rainref::conformance
