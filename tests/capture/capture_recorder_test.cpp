// A capture holds each run of a pass in order, with its inputs as they were before the pass.
#include "capture/capture_recorder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/example_capture.h"
#include "capture/hashing.h"

namespace rainref::capture {
namespace {

using testing::ElementsAre;

std::uint16_t half_at(const Array& a, std::size_t i) {
  std::uint16_t bits;
  std::memcpy(&bits, a.levels[0].data() + 2 * i, 2);
  return bits;
}

TEST(CaptureRecorder, MakesACaseOfEveryRunInOrder) {
  std::vector<std::string> folders;
  for (const PassCase& c : example_cases()) folders.push_back(c.folder());
  EXPECT_THAT(folders, ElementsAre("puddle.drip/0000.0", "puddle.blur/0000.0", "puddle.drip/0000.1", "puddle.blur/0000.1",
                                   "puddle.drip/0001.0", "puddle.blur/0001.0", "puddle.drip/0001.1", "puddle.blur/0001.1"));
}

TEST(CaptureRecorder, InputsAreThoseBeforeThePassOverwroteThem) {
  const std::vector<PassCase> cases = example_cases();
  EXPECT_EQ(half_at(cases[1].input("picture")->array, 0), 0);
  EXPECT_EQ(half_at(cases[1].output("picture")->array, 0), 110);
  for (std::size_t i = 3; i < cases.size(); i += 2)
    EXPECT_EQ(cases[i].input("picture")->array.levels, cases[i - 2].output("picture")->array.levels);
}

TEST(CaptureRecorder, KeepsWhatWasRecorded) {
  const PassCase c = example_cases()[5];
  EXPECT_EQ(c.effect, "puddle");
  EXPECT_TRUE(c.corrected());
  EXPECT_EQ(c.frame, 1);
  EXPECT_EQ(c.step, 0);
  EXPECT_EQ(c.level, -1);
  EXPECT_EQ(c.time, 0.5f);
  EXPECT_EQ(c.dt, 0.25f);
  ASSERT_EQ(c.uniforms.size(), sizeof(BlurUniforms));
  BlurUniforms u;
  std::memcpy(&u, c.uniforms.data(), sizeof u);
  EXPECT_EQ(u.reach, -3);
  const CaseInput& picture = *c.input("picture");
  EXPECT_EQ(picture.address_u, Address::border);
  EXPECT_EQ(picture.address_v, Address::border);
  EXPECT_THAT(picture.border, ElementsAre(0.5f, 0.25f, 0, 0));
  EXPECT_FALSE(picture.linear);
  EXPECT_EQ(picture.array.format, Format::rg16f);
  EXPECT_EQ(picture.array.width, 5);
  EXPECT_EQ(picture.array.height, 3);
  EXPECT_EQ(c.output("picture")->store_rounding, Rounding::rtz);
  EXPECT_EQ(c.output("picture")->judge, Judge::envelope);
  EXPECT_EQ(example_cases()[4].output("drips")->judge, Judge::bits);
  EXPECT_EQ(c.input("none"), nullptr);
}

TEST(CaptureRecorder, TexturesComeWithAllLevels) {
  const PassCase c = example_cases()[1];
  const CaseInput& sky = *c.input("sky");
  EXPECT_EQ(sky.address_u, Address::repeat);
  EXPECT_EQ(sky.address_v, Address::clamp);
  EXPECT_TRUE(sky.linear);
  EXPECT_EQ(sky.mip_filter, Filter::nearest);
  const ExampleRun run;
  const Texture& t = run.sky();
  ASSERT_EQ(sky.array.levels.size(), 3u);  // 7x4, 3x2, 1x1
  for (int level = 0; level < 3; ++level) {
    EXPECT_EQ(sky.array.level_width(level), t.width[level]);
    EXPECT_EQ(sky.array.level_height(level), t.height[level]);
    const auto& bytes = sky.array.levels[static_cast<std::size_t>(level)];
    ASSERT_EQ(bytes.size(), static_cast<std::size_t>(t.width[level] * t.height[level]) * 16);
    EXPECT_EQ(std::memcmp(bytes.data(), t.texels + 4 * t.offset[level], bytes.size()), 0);
  }
}

TEST(CaptureRecorder, RecordsComeWithTheirLayout) {
  const PassCase c = example_cases()[7];
  const Array& drips = c.input("drips")->array;
  EXPECT_TRUE(drips.is_records);
  EXPECT_EQ(drips.record.name, "DripRecord");
  EXPECT_EQ(drips.width, 2);
  EXPECT_EQ(drips.levels[0].size(), 16u);
}

// The bytes that `rainref hash` hashes.
TEST(CaptureRecorder, OutputsHashAsTheHashRecorderDoes) {
  HashRecorder hashes;
  ExampleRun().run(hashes);
  const std::vector<PassCase> cases = example_cases();
  for (const HashLine& line : hashes.take_lines()) {
    Hasher hasher;
    for (const PassCase& c : cases) {
      if (c.frame == line.frame && c.pass == line.pass) hasher.add(c.output(line.buffer)->array.levels[0]);
    }
    EXPECT_EQ(hasher.finish().text(), line.hash.text()) << line.text();
  }
}

TEST(CaptureRecorder, TakesOnlyWhatIsWanted) {
  std::vector<std::string> folders;
  CaptureRecorder recorder(
      example_info(), "corrected", false, [](int frame, std::string_view pass) { return frame == 1 && pass == "blur"; },
      [&](const PassCase& c) {
        folders.push_back(c.folder());
        EXPECT_TRUE(c.inputs.empty());
        EXPECT_EQ(c.uniforms.size(), sizeof(BlurUniforms));
      });
  ExampleRun().run(recorder);
  EXPECT_THAT(folders, ElementsAre("puddle.blur/0001.0", "puddle.blur/0001.1"));
}

TEST(CaptureRecorder, RefusesWhatTheEffectDoesNotDeclare) {
  const auto capture = [](const char* variant, auto&& tell) {
    CaptureRecorder recorder(
        example_info(), variant, true, [](int, std::string_view) { return true; }, [](const PassCase&) {});
    return error_of([&] { tell(recorder); });
  };
  const Image image(Format::r8, 2, 2);
  const PassOutput unknown[] = {{"fog", image}}, known[] = {{"picture", image}};
  EXPECT_EQ(capture("corrected", [&](Recorder& r) { r.pass({0, 0, "blur", known, 0}); }), "5 pass blur of frame 0 did not start");
  EXPECT_EQ(capture("corrected",
                    [&](Recorder& r) {
                      r.before({0, 0, "blur", {}, {}, 0, 0});
                      r.pass({0, 1, "blur", known, 0});
                    }),
            "5 pass blur of frame 0 did not start");
  EXPECT_EQ(capture("corrected",
                    [&](Recorder& r) {
                      r.before({0, 0, "blur", {}, {}, 0, 0});
                      r.pass({0, 0, "blur", unknown, 0});
                    }),
            "5 buffer 'fog' is not declared");
  EXPECT_EQ(capture("as-published",
                    [&](Recorder& r) {
                      r.before({0, 0, "drip", {}, {}, 0, 0});
                      r.pass({0, 0, "drip", known, 0});
                    }),
            "5 pass drip is not declared for as-published");
  const float three[] = {1, 2, 3};
  EXPECT_EQ(capture("corrected",
                    [&](Recorder& r) {
                      const RecordView wrong{three, 1, 12};
                      const PassInput inputs[] = {{"drips", wrong}};
                      r.before({0, 0, "blur", inputs, {}, 0, 0});
                    }),
            "5 record DripRecord: declared with 8 bytes, found 12");
}

TEST(RecorderList, TellsAll) {
  int cases = 0;
  CaptureRecorder a(
      example_info(), "corrected", true, [](int, std::string_view) { return true; }, [&](const PassCase&) { ++cases; });
  HashRecorder b;
  RecorderList both({&a, &b});
  ExampleRun().run(both);
  EXPECT_EQ(cases, 8);
  EXPECT_EQ(b.take_lines().size(), 4u);
}

TEST(PassInfo, NamesFormulasAndJudges) {
  const EffectInfo& info = example_info();
  EXPECT_EQ(formula(info, info.pass("blur"), *info.pass("blur").variant("corrected")), "puddle.blur.corrected/2");
  EXPECT_EQ(judge_text(info.pass("blur")), "as-published: input_only; corrected: envelope");
  EXPECT_EQ(judge_text(info.pass("drip")), "bits");
  EXPECT_THAT(info.pass_names("as-published"), ElementsAre("blur"));
  EXPECT_EQ(error_of([&] { info.pass("fog"); }), "5 pass 'fog' is not declared");
  EXPECT_EQ(error_of([&] { info.pass("drip").block("as-published"); }), "5 pass 'drip' does not run as as-published");
}

}  // namespace
}  // namespace rainref::capture
