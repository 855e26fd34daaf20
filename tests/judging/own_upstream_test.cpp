// A shader that computes two passes at once uses what it computed itself, not the pack's: the report says so.
#include "judging/own_upstream.h"

#include <algorithm>

#include <gmock/gmock.h>

#include "judging/fused_port.h"

namespace rainref::judging {
namespace {

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
  const judge::PassJudgement j = judged_pass(fused.port(), fused.pass, {}, fused.source);
  EXPECT_EQ(j.status, judge::Status::fail);
  for (const judge::Cause& cause : j.causes) EXPECT_THAT(cause.name, testing::Not(testing::HasSubstr("the port's own")));
}

}  // namespace
}  // namespace rainref::judging
