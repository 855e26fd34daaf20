// The envelopes are honest: nothing that a conforming device computes or stores lies outside, for every pass and
// profile.
//
// RAINREF_EVALUATIONS sets how many devices are drawn for each pass; scripts/full/envelopes draws a million.
#include "judge/devices.h"

namespace rainref::judge {
namespace {

using namespace test;

TEST(Honesty, WithoutVariationsAPerturbedIsTheReference) { expect_reference(enveloped_passes()); }

TEST(Honesty, NoConformingDeviceIsOutside) { expect_honest(enveloped_passes()); }

// The proof can fail.
TEST(Honesty, DevicesOfALooserProfileAreOutside) { expect_looser_outside(enveloped_passes()); }

}  // namespace
}  // namespace rainref::judge
