// The windshield's splat: its envelopes hold a device to one rounding.
#include <cstring>

#include "judge/invocation_judge.h"
#include "judge/mini_port.h"
#include "judge/reference_outputs.h"
#include "judge/support.h"

namespace rainref::judge {
namespace {

using namespace test;

// A blending unit that rounds one way and a judge that has seen it: a sum that is rounded once only is outside.
TEST(WindshieldSurface, SplatHoldsADeviceToOneRounding) {
  const std::vector<BoundPass> passes = enveloped_passes({shipped_pack("windshield-as-published", {"splat"})});
  ASSERT_EQ(passes.size(), 1u);
  int differing = 0, rejected = 0;
  for (const BoundCase& b : passes[0].cases) {
    EXPECT_TRUE(b.model->rounds_inside());
    capture::PassCase once = *b.c;
    const std::int32_t add = 0;
    std::memcpy(once.uniforms.data() + 36, &add, sizeof add);  // SplatUniforms::blend
    const auto other = binder("windshield", "splat")(once);
    EXPECT_FALSE(other->rounds_inside());
    const std::vector<capture::Array> stored = reference_outputs(once, *other, test_executor());
    const InvocationJudge judge(*b.c, *b.model, profile("vulkan"), HalfMode::rne);
    for (int y = 0; y < b.model->height(); ++y)
      for (int x = 0; x < b.model->width(); ++x) {
        const bool differs = b.slots[0].code(stored[0], x, y) != b.slots[0].code(b.c->outputs[0].array, x, y);
        differing += differs;
        rejected += differs && judge.accepts(x, y, stored) != Accepted::as_written;
        if (!differs) {
          EXPECT_EQ(judge.accepts(x, y, stored), Accepted::as_written) << x << ' ' << y;
        }
      }
  }
  EXPECT_GT(differing, 0);
  EXPECT_GT(2 * rejected, differing);
}

}  // namespace
}  // namespace rainref::judge
