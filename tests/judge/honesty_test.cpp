// The envelopes are honest: nothing that a conforming device computes or stores lies outside, for every pass and
// profile.
//
// RAINREF_EVALUATIONS sets how many devices are drawn for each pass; scripts/full/envelopes draws a million.
#include <cstring>

#include "capture/bound_texture.h"
#include "judge/devices.h"
#include "windshield/uniforms.h"

namespace rainref::judge {
namespace {

using namespace test;

TEST(Honesty, WithoutVariationsAPerturbedIsTheReference) { expect_reference(enveloped_passes()); }

TEST(Honesty, NoConformingDeviceIsOutside) { expect_honest(enveloped_passes()); }

// The proof can fail.
TEST(Honesty, DevicesOfALooserProfileAreOutside) { expect_looser_outside(enveloped_passes()); }

// Of two pictures a device takes one. With a pane moved until a texel lies on its edge, to the last bit, it may be either.
TEST(Honesty, ATexelOnTheEdgeOfAPaneMayShowEitherPicture) {
  for (const BoundPass& pass : enveloped_passes()) {
    if (pass.pass != "join_panes") continue;
    const BoundCase& from = pass.cases.back();
    const auto moved = [&](float by) {
      auto c = std::make_unique<capture::PassCase>(*from.c);
      auto u = capture::uniforms_of<windshield::CompositeUniforms>(*c);
      u.u_row[2] += by;
      std::memcpy(c->uniforms.data(), &u, sizeof u);
      auto model = bound(c->pass, binder(c->effect, c->pass), *c);
      return BoundCase{std::move(c), std::move(model), from.slots};
    };
    const auto values = [&](const BoundCase& b, int texel) {
      std::vector<scalar::Scalar<float>> out(b.slots.size());
      b.model->evaluate(texel % b.model->width(), texel / b.model->width(), out.data());
      std::vector<float> given;
      for (const auto& v : out) given.push_back(v.v);
      return given;
    };
    float near = 0, far = 64;
    const BoundCase here = moved(near), beyond = moved(far);
    int texel = 0;
    while (values(here, texel) == values(beyond, texel)) ++texel;
    const std::vector<float> pane = values(here, texel);
    for (float middle = far / 2; middle != near && middle != far; middle = near + (far - near) / 2)
      (values(moved(middle), texel) == pane ? near : far) = middle;
    for (const float by : {near, far}) {
      const BoundCase edge = moved(by);
      Tally tally;
      judge_devices(edge, profile("vulkan"), profile("vulkan"), 0, 20000, tally);
      EXPECT_EQ(tally.outside, 0) << pass.name() << ' ' << tally.first;
      EXPECT_GT(tally.differing, 0) << pass.name();
    }
  }
}

}  // namespace
}  // namespace rainref::judge
