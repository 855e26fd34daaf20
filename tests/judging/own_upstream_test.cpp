// A shader that computes two passes at once uses what it computed itself, not the pack's: the report says so.
#include "judging/own_upstream.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <map>

#include <gmock/gmock.h>

#include "judge/mini_port.h"
#include "judge/profiles.h"
#include "judging/judge_folder.h"

namespace rainref::judging {
namespace {

using capture::Array, capture::PassCase;

/// Adds to every float of one member of each record, or to every channel of an image.
void add(Array& a, float difference, std::size_t first = 0, std::size_t stride = 1) {
  std::vector<std::byte>& bytes = a.levels[0].edit();
  if (!a.is_records && info(a.format).kind == FormatInfo::float16) {
    for (std::size_t at = 0; at + 2 <= bytes.size(); at += 2) {
      Half half;
      std::memcpy(&half.bits, &bytes[at], 2);
      half = to_half(to_float(half) + difference);
      std::memcpy(&bytes[at], &half.bits, 2);
    }
    return;
  }
  for (std::size_t at = 4 * first; at + 4 <= bytes.size(); at += 4 * stride) {
    float value;
    std::memcpy(&value, &bytes[at], 4);
    value += difference;
    std::memcpy(&bytes[at], &value, 4);
  }
}

/// A pass that takes `buffer` of `source` from its own shader.
struct Fused {
  const char *pack, *source, *buffer, *pass;
  std::function<void(Array&)> own;  ///< what it computes there instead of the pack's

  judge::MiniPort port() const {
    judge::MiniPort made(pack);
    const auto kept = std::make_shared<std::map<int, Array>>();  // by frame
    made.after = [this, kept](const PassCase& c, std::vector<Array>& out) {
      if (c.pass != source) return;
      for (std::size_t o = 0; o < out.size(); ++o)
        if (c.outputs[o].name == buffer) {
          own(out[o]);
          (*kept)[c.frame] = out[o];
        }
    };
    made.before = [this, kept](PassCase& c) {
      if (c.pass != pass || !kept->contains(c.frame)) return;
      for (capture::CaseInput& input : c.inputs)
        if (input.name == buffer) input.array = kept->at(c.frame);
    };
    return made;
  }
};
judge::PassJudgement judged_pass(const judge::MiniPort& port, const std::string& pass) {
  const TemporaryFolder folder;
  port.run(folder.path());
  FolderOptions options;
  options.only = {pass};
  options.executor = &judge::test_executor();
  const Judged all = judge_folder(std::make_shared<const capture::Pack>(port.pack.folder()), {folder.path()}, options);
  EXPECT_EQ(all.judged.passes.size(), 1u);
  return all.judged.passes.at(0);
}

const std::vector<Fused>& fused_passes() {
  static const std::vector<Fused> all{
      {"puddle-as-published", "raindrops", "drops", "wave_step", [](Array& a) { add(a, 0.3f, 0, a.element_bytes() / 4); }},
      {"puddle-as-published", "ground_noise", "noise", "shade", [](Array& a) { add(a, 0.02f); }},
      {"puddle-corrected", "raindrops", "drops", "wave_step", [](Array& a) { add(a, 0.3f, 0, a.element_bytes() / 4); }},
      {"puddle-corrected", "shade", "colour", "display", [](Array& a) { add(a, 0.01f); }},
      {"screen_drops-as-published", "background", "background", "drops", [](Array& a) { add(a, 0.01f); }},
  };
  return all;
}

TEST(OwnUpstream, AFusedPassIsNamed) {
  for (const Fused& fused : fused_passes()) {
    SCOPED_TRACE(fused.pass);
    const judge::PassJudgement j = judged_pass(fused.port(), fused.pass);
    ASSERT_EQ(j.status, judge::Status::fail) << j.reason;
    ASSERT_EQ(j.causes.size(), 1u);
    EXPECT_EQ(j.causes[0].name, std::string("made from the port's own ") + fused.buffer);
    EXPECT_THAT(j.causes[0].sentence, testing::HasSubstr(std::string("a shader that computes ") + fused.source + " itself"));
    EXPECT_TRUE(j.causes[0].is_likely);
    EXPECT_GT(j.causes[0].of, 0);
    EXPECT_EQ(j.causes[0].inside, j.causes[0].of);
    EXPECT_EQ(j.causes[0].explained, j.causes[0].of);
  }
}
// Other values beside the failure are no cause of it.
TEST(OwnUpstream, AnotherMistakeIsNotCalledSo) {
  for (const Fused& fused : fused_passes()) {
    SCOPED_TRACE(fused.pass);
    judge::MiniPort port = fused.port();
    port.before = nullptr;
    const auto dumps = port.after;
    port.after = [&](const PassCase& c, std::vector<Array>& out) {
      dumps(c, out);
      if (c.pass != fused.pass) return;
      std::vector<std::byte>& bytes = out[0].levels[0].edit();
      std::reverse(bytes.begin(), bytes.end());
    };
    const judge::PassJudgement j = judged_pass(port, fused.pass);
    EXPECT_EQ(j.status, judge::Status::fail);
    for (const judge::Cause& cause : j.causes) EXPECT_THAT(cause.name, testing::Not(testing::HasSubstr("the port's own")));
  }
}
// Without a dump of the other pass nothing is said of it.
TEST(OwnUpstream, NothingIsReadThatIsNotThere) {
  const Fused& fused = fused_passes().front();
  const judge::MiniPort port = fused.port();
  const TemporaryFolder folder;
  port.run(folder.path());
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    if (entry.path().filename().string().find("raindrops") != std::string::npos) std::filesystem::remove_all(entry.path());
  FolderOptions options;
  options.only = {fused.pass};
  options.executor = &judge::test_executor();
  const Judged all = judge_folder(std::make_shared<const capture::Pack>(port.pack.folder()), {folder.path()}, options);
  EXPECT_EQ(all.judged.passes.at(0).status, judge::Status::fail);
  for (const judge::Cause& cause : all.judged.passes.at(0).causes)
    EXPECT_THAT(cause.name, testing::Not(testing::HasSubstr("the port's own")));
}

}  // namespace
}  // namespace rainref::judging
