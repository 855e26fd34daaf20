// What a profile leaves without a bound fails where there is much of it that no device comes to.
#include "judge/beyond.h"

#include <gmock/gmock.h>

#include "faults/mistakes_drops_and_maps.h"
#include "judge/judge.h"
#include "judge/mini_port.h"
#include "judge/profiles.h"
#include "judge/support.h"

namespace rainref::judge {
namespace {

using capture::Array;
using capture::PassCase;
using testing::HasSubstr;

// ---- mistakes --------------------------------------------------------------------------------------------------------
// WGSL promises nothing of a sine beyond pi, which places every published drop: 39 % of the pass has no bound.
struct PublishedDrops {
  capture::Pack pack{small_packs / "screen_drops-as-published"};

  /// The pass as written from its document, with a mistake, on uniforms that `change` has changed.
  PassJudgement judged(const std::string& mistake, const std::function<void(PassCase&)>& change = nullptr) const {
    const TemporaryFolder folder;
    for (const capture::PackCase& entry : pack.cases) {
      if (entry.pass != "drops") continue;
      PassCase c = pack.read(entry);
      std::vector<Array> out;
      for (const capture::CaseOutput& o : c.outputs) out.push_back(o.array);
      if (change) change(c);
      const faults::hand::Run run(c, pack.pass("drops").block, mistake);
      const std::vector<Slot> slots = slots_of(c);
      for (int y = 0; y < out[0].height; ++y)
        for (int x = 0; x < out[0].width; ++x) {
          float values[8];
          faults::hand::screen_drops_published(run, x, y, values);
          for (std::size_t v = 0; v < slots.size(); ++v) {
            const Slot& s = slots[v];
            store_value(s, values[v], s.store_rounding, out[static_cast<std::size_t>(s.output)].levels[0].edit().data() + s.offset(x, y));
          }
        }
      for (std::size_t o = 0; o < out.size(); ++o) put_array(folder / c.folder(), "out." + c.outputs[o].name, out[o]);
    }
    ValidateOptions options;
    options.profile = "webgpu";
    options.only = {"drops"};
    options.executor = &test_executor();
    return pass_of(validate(pack, folder.path(), options), "drops");
  }
};

TEST(Beyond, TheDocumentsPassIsGood) {
  const PassJudgement j = PublishedDrops().judged("");
  EXPECT_EQ(j.status, Status::pass) << j.reason;
  EXPECT_GT(j.cases[0].outputs[0].vacuous + j.cases[0].outputs[1].vacuous, 100);
}
TEST(Beyond, LayersInTheWrongOrderFail) {
  const PassJudgement j = PublishedDrops().judged("layers the other way");
  EXPECT_EQ(j.status, Status::fail) << j.reason;
}
TEST(Beyond, TimeInMillisecondsFails) {
  const PublishedDrops drops;
  const std::size_t time = uniform_offset(drops.pack, "drops", "time");
  const PassJudgement j =
      drops.judged("", [&](PassCase& c) { change_at<float>(c.uniforms.data() + time, [](float seconds) { return 1000 * seconds; }); });
  EXPECT_EQ(j.status, Status::fail) << j.reason;
  EXPECT_THAT(j.reason, HasSubstr("elements that webgpu leaves without a bound are farther off than the coarsest device"));
  // They are failing elements as any: in the map, in the list of the worst with what is accepted there.
  std::int64_t failing = 0;
  for (const CaseJudgement& c : j.cases)
    for (const OutputJudgement& o : c.outputs) {
      failing += o.failing;
      EXPECT_EQ(std::count(o.map.begin(), o.map.end(), 4), 0);
      if (o.failing > 0) {
        EXPECT_FALSE(o.worst.empty());
        EXPECT_GT(o.worst[0].distance, 0u);
        EXPECT_GT(std::count(o.map.begin(), o.map.end(), 3), 0);
      }
    }
  EXPECT_GT(failing, 100);
}

// ---- devices ---------------------------------------------------------------------------------------------------------
/// The coarsest device of docs/devices, as WebGPU may have it.
enclosed::Profile coarse_device() {
  enclosed::Profile p = profile("webgpu");
  p.sin_cos = {};
  p.sin_cos.absolute = 0x1.83p-13;  // 2^-12.4, SwiftShader's, at any argument
  p.sin_cos_beyond = 0x1p-22;
  p.atan2_domain = 0;
  return p;
}
/// What a device of these rules stores for a pass of a small pack.
CaseJudgement judged_device(const test::BoundCase& b, const enclosed::Profile& rules, std::uint64_t seed) {
  const perturbed::Variations variations = perturbed::variations_of(rules);
  std::vector<Array> port = b.expected();
  test::Words words(seed);
  const HalfMode mode = seed % 2 == 0 ? HalfMode::rne : HalfMode::rtz;
  for (int y = 0; y < b.model->height(); ++y)
    for (int x = 0; x < b.model->width(); ++x) {
      const std::vector<float> values = test::conforming_values(*b.model, x, y, variations, words());
      for (std::size_t v = 0; v < values.size(); ++v) {
        const Slot& s = b.slots[v];
        test::store_conforming(s, values[v], rules, mode, words,
                               port[static_cast<std::size_t>(s.output)].levels[0].edit().data() + s.offset(x, y));
      }
    }
  return judge_case(*b.c, b.model.get(), port, {&profile("webgpu"), &profile("typical"), &test_executor(), mode}).judgements[0];
}
/// Passes of the small packs that WebGPU leaves elements of without a bound.
std::vector<test::BoundPass> passes_without_bounds() {
  std::vector<test::BoundPass> all = test::enveloped_passes();
  std::erase_if(all, [](const test::BoundPass& pass) {
    // A march is held to the port's own end, and splat rounds on its way: neither stores one value of a device's.
    const capture::PassModel& model = *pass.cases.front().model;
    return model.needs_port() || model.rounds_inside() || std::none_of(pass.cases.begin(), pass.cases.end(), [](const test::BoundCase& b) {
             const CaseJudgement j =
                 judge_case(*b.c, b.model.get(), b.expected(), {&profile("webgpu"), &profile("typical"), &test_executor(), HalfMode::rne})
                     .judgements[0];
             return std::any_of(j.outputs.begin(), j.outputs.end(), [](const OutputJudgement& o) { return o.vacuous > 0; });
           });
  });
  return all;
}

// No false alarm: nothing fails of what such a device stores.
TEST(Beyond, CoarseDevicesDoNotFail) {
  std::int64_t found = 0;
  for (const test::BoundPass& pass : passes_without_bounds())
    for (const test::BoundCase& b : pass.cases)
      for (std::uint64_t seed = 0; seed < 3; ++seed) {
        const CaseJudgement j = judged_device(b, coarse_device(), seed);
        EXPECT_EQ(j.failing, 0) << pass.name() << ' ' << b.c->folder() << ' ' << j.reason;
        for (const OutputJudgement& o : j.outputs) EXPECT_EQ(o.beyond, 0) << pass.name();
        ++found;
      }
  EXPECT_GT(found, 5);
}
TEST(Beyond, AFewAreNoShare) {
  EXPECT_FALSE(is_gross(15, 20));
  EXPECT_TRUE(is_gross(16, 20));
  EXPECT_FALSE(is_gross(20, 4000));
  EXPECT_TRUE(is_gross(21, 4000));
  EXPECT_FALSE(is_gross(0, 0));
}

}  // namespace
}  // namespace rainref::judge
