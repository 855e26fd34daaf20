// The windshield's passes that draw textures and pictures: their envelopes are honest and tight, and hold the small packs' own
// outputs.
#include "conformance/devices.h"
#include "conformance/spread.h"
#include "conformance/windshield_surface.h"

namespace rainref::conformance {
namespace {

using namespace test;

TEST(WindshieldSurface, WithoutLibertiesADeviantIsTheReference) { expect_reference(surface_passes()); }
TEST(WindshieldSurface, NoConformingDeviceIsOutside) { expect_honest(surface_passes()); }
TEST(WindshieldSurface, DevicesOfALooserProfileAreOutside) { expect_looser_outside(surface_passes()); }
TEST(WindshieldSurface, TheMedianEnvelopeIsAtMostFourTimesTheSpread) { expect_tight(surface_passes()); }

}  // namespace
}  // namespace rainref::conformance
