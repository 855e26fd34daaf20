// One pass of a port judged by --only as with the whole port: the same verdict, rounding and first cause, whatever its mistake is.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "faults/hand_port.h"
#include "judge/evaluations.h"
#include "judge/reference_outputs.h"

namespace rainref::faults {
namespace {

using namespace judge;
using capture::Array;
using capture::PassCase;

/// A correct port of a pack that rounds its halves one way, in a folder, and one pass of it at a time that is wrong.
class PortOfPack {
 public:
  PortOfPack(const std::string& pack, HalfMode stores) : pack_(small_packs / pack), stores_(stores) {
    for (const capture::PackCase& entry : pack_.cases) put(entry, right(pack_.read(entry)));
  }

  /// Takes away the files of all other passes.
  void leave(const std::string& pass) const {
    for (const capture::PackCase& entry : pack_.cases)
      if (entry.pass != pass) std::filesystem::remove_all(folder_ / entry.id);
  }
  /// The wrong pass, judged; by itself, or with all others.
  PassJudgement judged(const hand::Pass& p, bool is_alone) const {
    ValidateOptions options;
    if (is_alone) options.only = {p.pass};
    options.explain = [&](const FailedRun& failed) { return failed.pass.name == p.pass ? diagnose(failed) : Explanation(); };
    options.executor = &test_executor();
    return pass_of(validate(pack_, folder_.path(), options), p.pass);
  }
  /// Calls judge() while the pass has the mistake.
  template <class Judge>
  void with(const hand::Pass& p, const std::string& mistake, const Judge& judge) const {
    const auto put_all = [&](const auto& outputs) {
      for (const capture::PackCase& entry : pack_.cases)
        if (entry.pass == p.pass) put(entry, outputs(pack_.read(entry)));
    };
    put_all([&](const PassCase& c) { return hand::given(p, pack_, c, mistake, stores_); });
    judge();
    put_all([&](const PassCase& c) { return right(c); });
  }

 private:
  std::vector<Array> right(const PassCase& c) const {
    const std::unique_ptr<capture::PassModel> model = bound(c.pass, binder(pack_.effect, c.pass), c);
    if (model) return reference_outputs(c, *model, test_executor(), stores_);
    std::vector<Array> out;
    for (const capture::CaseOutput& o : c.outputs) out.push_back(o.array);
    return out;
  }
  void put(const capture::PackCase& entry, const std::vector<Array>& outputs) const {
    for (std::size_t o = 0; o < outputs.size(); ++o) put_array(folder_ / entry.id, "out." + entry.outputs[o].rules.name, outputs[o]);
  }

  capture::Pack pack_;
  HalfMode stores_;
  TemporaryFolder folder_;
};

std::string text_of(const PassJudgement& j) {
  const std::string cause = j.causes.empty() ? "none" : (j.causes[0].is_likely ? "likely " : "may be ") + j.causes[0].name;
  return fmt::format("{} by {}: {}", name(j.status), name(j.half_mode), cause);
}

class HandMadeAlone : public ::testing::TestWithParam<HalfMode> {};

// By --only a pass was judged without the others' votes: where it failed by both roundings, its causes were sought under the wrong one.
TEST_P(HandMadeAlone, IsJudgedAsWithTheWholePort) {
  const std::vector<hand::Pass> passes = hand::known_passes();
  std::string name;
  std::optional<PortOfPack> port;
  int number = GetParam() == HalfMode::rtz ? 0 : 20, judged = 0;
  for (const hand::Pass& p : passes)
    for (const hand::Mistake& m : p.mistakes) {
      if (number++ % 40 != 0 && !hand::measures_all()) continue;
      if (!port || name != p.pack) port.emplace(name = p.pack, GetParam());
      port->with(p, m.mistake, [&] {
        const PassJudgement whole = port->judged(p, false), alone = port->judged(p, true);
        EXPECT_EQ(whole.status, Status::fail) << p.pack << ' ' << p.pass << ": " << m.mistake;
        EXPECT_EQ(text_of(alone), text_of(whole)) << p.pack << ' ' << p.pass << ": " << m.mistake;
        EXPECT_EQ(alone.half_mode_is_open, whole.half_mode_is_open) << p.pack << ' ' << p.pass << ": " << m.mistake;
      });
      ++judged;
    }
  EXPECT_GE(judged, hand::measures_all() ? 165 : 4);
}
INSTANTIATE_TEST_SUITE_P(Stores, HandMadeAlone, ::testing::Values(HalfMode::rne, HalfMode::rtz),
                         [](const auto& about) { return std::string(judge::name(about.param)); });

// Every texel is wrong by any rounding, and no other file tells: the cause that explains more tells, which a truncating port's is by
// truncation.
TEST(HandMadeOpen, CausesAreSoughtUnderEitherRoundingWhereNothingTells) {
  const std::vector<hand::Pass> passes = hand::known_passes();
  const auto normals = std::find_if(passes.begin(), passes.end(),
                                    [](const hand::Pass& p) { return p.pack == "windshield-as-published" && p.pass == "normals"; });
  ASSERT_NE(normals, passes.end());
  for (const HalfMode stores : {HalfMode::rne, HalfMode::rtz}) {
    const PortOfPack port(normals->pack, stores);
    port.with(*normals, "packed for 8 bits", [&] {
      const PassJudgement whole = port.judged(*normals, false);
      port.leave(normals->pass);
      const PassJudgement alone = port.judged(*normals, true);
      EXPECT_FALSE(whole.half_mode_is_open);
      EXPECT_TRUE(alone.half_mode_is_open);
      EXPECT_EQ(alone.half_mode, stores);
      EXPECT_EQ(text_of(alone), text_of(whole));
    });
  }
}

}  // namespace
}  // namespace rainref::faults
