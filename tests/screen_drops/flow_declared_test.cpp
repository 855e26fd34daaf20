// What the flowing layer declares: scene keys; passes that recorders see as declared and conformance computes anew.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/error_of.h"
#include "capture/capture_recorder.h"
#include "math/half.h"
#include "rainref/error.h"
#include "scene/effect_table.h"
#include "scene/toml.h"
#include "screen_drops/flow.h"
#include "screen_drops/flow_support.h"

namespace rainref::screen_drops {
namespace {

using namespace test;
using capture::PassCase;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

const std::vector<std::string> variants{"as-published", "corrected"};

FlowSettings settings_of(const std::vector<std::string>& values, const std::string& variant = "corrected") {
  const std::vector<scene::Parameter> all = flow_parameters();
  const scene::EffectTable table{{{"screen_drops", variants, all}}};
  return flow_settings(scene::parse("effect = 'screen_drops'\nvariant = '" + variant + "'\nseed = 5\n", "scene", values, table),
                       {0.5, 0.25}, Rounding::rtz);
}
std::string refusal(const std::vector<std::string>& values, const std::string& variant = "corrected") {
  return error_of([&] { settings_of(values, variant); });
}

TEST(FlowDeclared, KeysAreSoundAndOfCorrectedAlone) {
  const std::vector<scene::Parameter> all = flow_parameters();
  scene::validate(all, variants);
  for (const scene::Parameter& p : all) EXPECT_FALSE(p.used_by("as-published")) << p.key;
  EXPECT_THAT(refusal({"flow.capacity=9"}, "as-published"), StartsWith("2 "));
}

TEST(FlowDeclared, DefaultsAreThoseOfTheSettings) {
  const FlowSettings s = settings_of({}), d;
  EXPECT_EQ(s.fps, d.fps);
  EXPECT_EQ(s.substeps, d.substeps);
  EXPECT_EQ(s.gravity, d.gravity);
  EXPECT_EQ(s.wind, d.wind);
  EXPECT_EQ(s.warm_up, d.warm_up);
  EXPECT_EQ(s.pane, (std::array{0.5, 0.25}));
  EXPECT_EQ(s.drops.seed, 5u);
  EXPECT_TRUE(s.drops.corrected);
  EXPECT_EQ(s.drops.lifetime, d.drops.lifetime);
  EXPECT_EQ(s.splat.rounding, Rounding::rtz);
  EXPECT_EQ(s.splat.width, 1024);
  EXPECT_EQ(s.splat.height, 576);
}

TEST(FlowDeclared, ScenesSetEveryKey) {
  const FlowSettings s =
      settings_of({"flow.capacity=77", "flow.substeps=4", "flow.warm_up=2.5", "rain.wind=7", "world.gravity=1.62",
                   "flow.height_size=[64, 32]", "flow.kernel=quartic", "flow.receding_angle=30", "rain.rate=44", "run.fps=30"});
  EXPECT_EQ(s.drops.capacity, 77);
  EXPECT_EQ(s.substeps, 4);
  EXPECT_EQ(s.warm_up, 2.5);
  EXPECT_EQ(s.wind, 7);
  EXPECT_EQ(s.gravity, 1.62);
  EXPECT_EQ(s.splat.width, 64);
  EXPECT_EQ(s.splat.height, 32);
  EXPECT_EQ(s.splat.kernel, drops::SplatKernel::quartic);
  EXPECT_EQ(s.drops.receding_deg, 30);
  EXPECT_EQ(s.drops.rain_rate, 44);
  EXPECT_EQ(s.fps, 30);
}

TEST(FlowDeclared, RefusesWhatCannotBe) {
  EXPECT_THAT(refusal({"rain.wind=-1"}), AllOf(StartsWith("2 "), HasSubstr("rain.wind")));
  EXPECT_THAT(refusal({"flow.substeps=0"}), AllOf(StartsWith("2 "), HasSubstr("flow.substeps")));
  EXPECT_THAT(refusal({"flow.wind_drag=1"}), AllOf(StartsWith("2 "), HasSubstr("flow.wind_drag")));  // nothing blows along the pane
  EXPECT_EQ(refusal({"flow.receding_angle=60"}), "2 flow.receding_angle is 60 degrees: expected at most flow.advancing_angle = 50");
}

const capture::EffectInfo& flow_effect() {
  static const capture::EffectInfo info = [] {
    capture::EffectInfo i;
    i.name = "screen_drops";
    i.passes = flow_passes();
    i.buffers = flow_buffers();
    i.records = flow_records();
    return i;
  }();
  return info;
}
std::vector<PassCase> captured() {
  FlowSettings s = wet_pane();
  s.substeps = 2;
  s.warm_up = 3;
  s.drops.neck_time = 1;
  const parallel::Executor executor(2);
  std::vector<PassCase> cases;
  capture::CaptureRecorder recorder(
      flow_effect(), "corrected", true, [](int, std::string_view) { return true; }, [&](PassCase c) { cases.push_back(std::move(c)); });
  Flow flow(s, executor);
  for (int n = 0; n < 3; ++n) flow.simulate(&recorder);
  return cases;
}

TEST(FlowDeclared, RecordersSeeThePassesAndWhatTheyTakeAsDeclared) {
  const std::vector<PassCase> cases = captured();
  std::string order;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const PassCase& c = cases[i];
    if (c.frame == 1) order += c.pass + std::to_string(c.step) + ' ';
    const capture::PassInfo& info = flow_effect().pass(c.pass);
    EXPECT_EQ(c.uniforms.size(), info.block("corrected").size);
    ASSERT_EQ(c.inputs.size(), info.reads.size()) << c.pass;
    for (std::size_t k = 0; k < info.reads.size(); ++k) {
      const capture::ReadInfo& read = info.reads[k];
      EXPECT_EQ(c.inputs[k].name, read.buffer);
      if (read.from.empty()) continue;
      // The run that is said to have written it did.
      std::size_t j = i;
      while (j > 0 && cases[j - 1].pass != read.from) --j;
      if (j == 0) continue;  // before the first frame
      EXPECT_EQ(cases[j - 1].step != c.step || cases[j - 1].frame != c.frame, read.previous || c.pass == "splat") << c.folder();
      ASSERT_NE(cases[j - 1].output(read.buffer), nullptr) << c.folder() << ' ' << read.buffer;
      EXPECT_EQ(cases[j - 1].output(read.buffer)->array.levels, c.inputs[k].array.levels) << c.folder() << ' ' << read.buffer;
    }
  }
  EXPECT_EQ(order, "spawn0 integrate0 necks0 merge0 spawn1 integrate1 necks1 merge1 splat0 ");
}

std::string by_id(std::vector<std::byte> bytes) {
  std::vector<Drop> all(bytes.size() / sizeof(Drop));
  if (!all.empty()) std::memcpy(all.data(), bytes.data(), bytes.size());
  std::sort(all.begin(), all.end(), [](const Drop& a, const Drop& b) { return a.id < b.id; });
  return bytes_of(all);
}
TEST(FlowDeclared, EvaluationsGiveWhatThePassesGave) {
  int lists = 0, images = 0;
  for (const PassCase& c : captured()) {
    const std::vector<capture::PassEvaluations> all = flow_evaluations();
    const auto evaluation = std::find_if(all.begin(), all.end(), [&](const auto& r) { return r.pass == c.pass; });
    ASSERT_NE(evaluation, all.end()) << c.pass;
    const auto model = evaluation->bind ? evaluation->bind(c) : nullptr;
    for (const capture::CaseOutput& o : c.outputs) {
      const auto& stored = o.array.levels.at(0);
      if (o.name == "drops") {
        ASSERT_GT(o.array.width, 50);
        const std::vector<std::byte> again =
            model ? *model->keyed("drops")->reference() : evaluation->recompute(c).at(0).levels.at(0).all();
        EXPECT_EQ(by_id(again), by_id(stored)) << c.folder();
        ++lists;
        continue;
      }
      if (o.name == "necks") {  // in ascending id
        EXPECT_GT(o.array.width, 0);
        EXPECT_EQ(*model->keyed("necks")->reference(), stored) << c.folder();
        ++lists;
        continue;
      }
      ASSERT_EQ(model->width(), o.array.width);
      double sum = 0;
      for (int y = 0; y < o.array.height; ++y) {
        for (int x = 0; x < o.array.width; ++x) {
          scalar::Scalar<float> value;
          model->evaluate(x, y, &value);
          const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(o.array.width) + static_cast<std::size_t>(x);
          float found = 0;
          if (o.name == "film") {
            std::memcpy(&found, stored.data() + 4 * at, 4);
          } else {
            Half half;
            std::memcpy(&half, stored.data() + 2 * at, 2);
            found = to_float(half);
            value.v = to_float(to_half(value.v, Rounding::rne));
          }
          ASSERT_EQ(found, value.v) << c.folder() << ' ' << o.name << ' ' << x << ' ' << y;
          sum += found;
        }
      }
      EXPECT_GT(sum, 0) << o.name;
      ++images;
    }
  }
  EXPECT_EQ(lists, 3 * 2 * (3 + 1));
  EXPECT_EQ(images, 3 * (2 + 1));
}

}  // namespace
}  // namespace rainref::screen_drops
