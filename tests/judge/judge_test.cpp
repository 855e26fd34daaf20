// The judge on passes made up for it, where every count is known.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "judge/conclude.h"
#include "judge/invocation_judge.h"
#include "judge/judge.h"
#include "judge/reference_outputs.h"
#include "judge/support.h"
#include "reports/figures.h"

namespace rainref::judge {
namespace {

using namespace test;
using capture::Array;
using capture::PassCase;

// ---- a made-up pass ------------------------------------------------------------------------------------------------
// Value (x + 1) / 3 stored in float, and whether its double is above the threshold that column 4 meets but for a
// rounding.
constexpr int columns = 16, rows = 8;
struct ThirdPass {
  int width = columns, height = rows, values = 2;
  int undecided_row = -1;  ///< the first row with more decisions than anyone follows
  int undecided_rows = 1;
  float shift = 0;  ///< of row 7: a bound as wide as this, but under what known devices do
  template <class N>
  void operator()(int x, int y, N* out) const {
    const N third = (N::index(x) + N(1.0f)) / N(3.0f);
    out[0] = third;
    out[1] = select(third > N(5.0f / 3.0f), N(1.0f), N(0.0f));
    if (y >= undecided_row && y < undecided_row + undecided_rows && undecided_row >= 0)
      for (int k = 0; k < 5; ++k) out[1] = select(third / third > N(1.0f), N(1.0f), out[1]);
    if constexpr (std::is_same_v<N, enclosed::Enclosure>) {
      if (y == rows - 1 && enclosed::profile().name != "typical") out[0] = enclosed::Enclosure(out[0].lo - shift, out[0].hi + shift);
    }
  }
};
struct Made {
  PassCase c;
  std::unique_ptr<capture::PassModel> model;
  std::vector<Array> port;
  parallel::Executor executor{2};

  explicit Made(ThirdPass pass, Format format = Format::rg32f) : model(capture::model_of(pass)) {
    c.effect = "made_up";
    c.pass = "third";
    capture::CaseOutput out;
    out.name = "thirds";
    out.range = {0, 8};
    out.array.format = format;
    out.array.width = columns;
    out.array.height = rows;
    out.array.levels.emplace_back(static_cast<std::size_t>(columns * rows * info(format).texel_bytes()));
    c.outputs = {out};
    c.outputs[0].array = reference_outputs(c, *model, executor)[0];
    port = {c.outputs[0].array};
  }
  void put(int x, int y, int channel, float value) {
    const Slot s = slots_of(c)[static_cast<std::size_t>(channel)];
    store_value(s, value, Rounding::rne, port[0].levels[0].edit().data() + s.offset(x, y));
  }
  ModeJudgements all(const char* name, const char* typical = nullptr) const {
    return judge_case(c, model.get(), port, {&profile(name), typical ? &profile(typical) : nullptr, &executor, std::nullopt});
  }
  CaseJudgement judged(const char* name, const char* typical = nullptr) const { return all(name, typical).judgements[0]; }
};

TEST(Judge, TheReferencePassesAndIsCounted) {
  for (const char* name : {"ieee", "vulkan", "cuda"}) {
    const CaseJudgement j = Made({}).judged(name, "typical");
    EXPECT_EQ(j.status, Status::pass) << j.reason;
    EXPECT_EQ(j.invocations, columns * rows);
    EXPECT_EQ(j.outputs[0].elements, 2 * columns * rows);
    EXPECT_EQ(j.outputs[0].differing, 0);
    EXPECT_EQ(j.outputs[0].vacuous, 0);
    // 5/3 computed and 5/3 compared with it: open under vulkan only, in one column.
    EXPECT_EQ(j.ambiguous, std::string(name) == "vulkan" ? rows : 0);
  }
}
TEST(Judge, OneUlpIsOutsideUnderIeeeAndInsideUnderVulkan) {
  Made m({});
  m.put(6, 2, 0, std::nextafterf(7.0f / 3.0f, 9));
  const CaseJudgement exact = m.judged("ieee");
  EXPECT_EQ(exact.status, Status::fail);
  EXPECT_EQ(exact.failing, 1);
  ASSERT_EQ(exact.outputs[0].worst.size(), 1u);
  const Failure& f = exact.outputs[0].worst[0];
  EXPECT_EQ(std::tuple(f.x, f.y, f.channel, f.distance), std::tuple(6, 2, 0, 1u));
  EXPECT_EQ(exact.outputs[0].map[2 * columns + 6], 3);
  const CaseJudgement loose = m.judged("vulkan", "typical");
  EXPECT_EQ(loose.status, Status::pass);
  EXPECT_EQ(loose.outputs[0].differing, 1);
  EXPECT_EQ(loose.outputs[0].map[2 * columns + 6], 1);
}
TEST(Judge, InsideTheProfileButNotTypicalWarns) {
  Made m({});
  m.put(6, 2, 0, std::nextafterf(7.0f / 3.0f, 9));
  // In the place of what GPUs do, who divide about as coarsely as Vulkan allows: devices that round.
  const CaseJudgement j = m.judged("vulkan", "ieee");
  EXPECT_EQ(j.status, Status::warn);
  EXPECT_EQ(j.outputs[0].atypical, 1);
  EXPECT_EQ(j.outputs[0].map[2 * columns + 6], 2);
}
TEST(Judge, ADecisionIsOneOrTheOtherNotBetween) {
  Made m({});
  m.put(4, 3, 1, 1);
  const CaseJudgement other = m.judged("vulkan");
  EXPECT_EQ(other.status, Status::pass);
  EXPECT_EQ(other.other_branch, 1);
  m.put(4, 3, 1, 0.5f);
  EXPECT_EQ(m.judged("vulkan").failing, 1);
  m.put(4, 3, 1, 0);
  m.put(8, 3, 1, 0);  // settled
  EXPECT_EQ(m.judged("vulkan").failing, 1);
}
/// The sign of a stored zero.
void negate_zero(Made& m, int x, int y, int channel) {
  const Slot s = slots_of(m.c)[static_cast<std::size_t>(channel)];
  std::byte* at = m.port[0].levels[0].edit().data() + s.offset(x, y) + s.channel_bytes - 1;
  ASSERT_EQ(*at, std::byte{0});
  *at = std::byte{0x80};
}
TEST(Judge, NegativeZeroIsAnotherZeroUnderIeeeAlone) {
  for (const Format format : {Format::rg32f, Format::rg16f}) {
    Made m({}, format);
    negate_zero(m, 1, 2, 1);
    const CaseJudgement exact = m.judged("ieee");
    EXPECT_EQ(exact.status, Status::fail);
    EXPECT_EQ(exact.failing, 1);
    ASSERT_EQ(exact.outputs[0].worst.size(), 1u);
    const Failure& f = exact.outputs[0].worst[0];
    EXPECT_EQ(std::tuple(f.x, f.y, f.channel, f.distance), std::tuple(1, 2, 1, 1u));
    const reports::FailureText text = reports::failure_text(exact.outputs[0], f);
    EXPECT_EQ(text.got, format == Format::rg32f ? "-0 (0x80000000)" : "-0 (0x8000)");
    EXPECT_EQ(text.accepted, format == Format::rg32f ? "0 (0x00000000)" : "0 (0x0000)");
    EXPECT_EQ(InvocationJudge(m.c, *m.model, profile("ieee"), HalfMode::rne).accepts(1, 2, m.port), Accepted::no);
    const CaseJudgement loose = m.judged("vulkan", "typical");
    EXPECT_EQ(loose.status, Status::pass);
    EXPECT_EQ(loose.outputs[0].differing, 1);
    EXPECT_EQ(loose.outputs[0].map[2 * columns + 1], 1);
    EXPECT_EQ(InvocationJudge(m.c, *m.model, profile("vulkan"), HalfMode::rne).accepts(1, 2, m.port), Accepted::as_written);
    m.c.outputs[0].judge = capture::Judge::bits;
    EXPECT_EQ(m.judged("vulkan").failing, 1);
  }
}
// ieee compares with what the pack holds, however that was stored.
TEST(Judge, IeeeTakesThePacksOwnRounding) {
  Made m({}, Format::rg16f);
  m.c.outputs[0].store_rounding = Rounding::rtz;
  m.c.outputs[0].array = reference_outputs(m.c, *m.model, m.executor)[0];
  EXPECT_NE(m.c.outputs[0].array.levels, m.port[0].levels);
  EXPECT_EQ(m.judged("ieee").status, Status::fail);
  m.port[0] = m.c.outputs[0].array;
  EXPECT_EQ(m.judged("ieee").status, Status::pass);
}

/// The same pass, its second value a count that nobody can reproduce.
class Counting : public capture::ModelOf<ThirdPass> {
 public:
  using ModelOf::ModelOf;
  std::optional<std::array<double, 2>> free_range(int v) const override {
    if (v != 1) return std::nullopt;
    return std::array<double, 2>{0, 100};
  }
};
TEST(Judge, AFreeValueIsHeldToItsRange) {
  ThirdPass pass;
  pass.undecided_row = 5;
  for (const int row : {2, 5}) {
    Made m(pass);
    m.model = std::make_unique<Counting>(pass);
    const auto judged_with = [&](float count) {
      m.put(6, row, 1, count);
      const CaseJudgement j = m.judged("vulkan");
      EXPECT_EQ(j.outputs[0].free, columns * rows) << count;
      EXPECT_EQ(InvocationJudge(m.c, *m.model, profile("vulkan"), HalfMode::rne).accepts(6, row, m.port) != Accepted::no, j.failing == 0)
          << count;
      return j;
    };
    for (const float count : {0.0f, 41.5f, 100.0f}) EXPECT_EQ(judged_with(count).failing, 0) << count;
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (const float count : {-7.0f, std::nextafterf(100, 101), 1e30f, infinity, -infinity, std::numeric_limits<float>::quiet_NaN()}) {
      const CaseJudgement j = judged_with(count);
      EXPECT_EQ(j.status, Status::fail) << count;
      EXPECT_EQ(j.outputs[0].failing, 1) << count;
      ASSERT_EQ(j.outputs[0].worst.size(), 1u) << count;
      const Failure& f = j.outputs[0].worst[0];
      EXPECT_EQ(std::tuple(f.x, f.y, f.channel), std::tuple(6, row, 1));
      if (std::isnan(count)) continue;
      EXPECT_THAT(reports::failure_text(j.outputs[0], f).accepted, testing::StartsWith("0 (0x00000000) to 100 ("));
    }
    // Under exact rules nothing is free.
    m.put(6, row, 1, 41);
    EXPECT_EQ(m.judged("ieee").failing, 1);
  }
}

TEST(Judge, NotANumberFailsEvenWhereAnythingElsePasses) {
  ThirdPass pass;
  pass.undecided_row = 5;
  Made m(pass);
  m.put(3, 5, 0, 77);
  EXPECT_EQ(m.judged("vulkan").failing, 0);
  EXPECT_EQ(m.judged("vulkan").gave_up, columns);
  m.put(3, 5, 0, std::numeric_limits<float>::quiet_NaN());
  const CaseJudgement j = m.judged("vulkan");
  EXPECT_EQ(j.status, Status::fail);
  EXPECT_TRUE(j.outputs[0].worst[0].not_a_number);
}
// What a profile leaves without a useful bound is judged by what known devices do; where that bounds less than half, nothing is said.
TEST(Judge, UnboundedElementsAreHeldToWhatDevicesDo) {
  ThirdPass pass;
  pass.shift = 8.0f / 16 / 2.1f;  // just under 1/16 of the range
  EXPECT_EQ(Made(pass).judged("vulkan").outputs[0].vacuous, 0);
  EXPECT_EQ(Made(pass).judged("vulkan").outputs[0].loose, columns);
  pass.shift = 8.0f / 16 / 1.9f;
  Made m(pass);
  CaseJudgement j = m.judged("vulkan", "typical");
  EXPECT_EQ(j.outputs[0].vacuous, columns);
  EXPECT_EQ(j.outputs[0].typical, columns);
  EXPECT_EQ(j.outputs[0].unbounded, 0);
  EXPECT_EQ(j.status, Status::pass);
  m.put(6, rows - 1, 0, 7.0f / 3.0f + 0.01f);
  j = m.judged("vulkan", "typical");
  EXPECT_EQ(j.outputs[0].typical, columns - 1);
  EXPECT_EQ(j.outputs[0].atypical, 1);
  EXPECT_EQ(j.failing, 0);
  EXPECT_EQ(j.status, Status::warn);
  // Without known devices nothing bounds them.
  EXPECT_EQ(m.judged("vulkan").outputs[0].unbounded, columns);
}
TEST(Judge, WhereLessThanHalfIsBoundedItIsUntested) {
  ThirdPass pass;
  pass.undecided_row = 3;
  pass.undecided_rows = 4;  // of 8
  CaseJudgement j = Made(pass).judged("vulkan", "typical");
  EXPECT_EQ(j.outputs[0].unbounded, j.outputs[0].elements / 2);
  EXPECT_EQ(j.status, Status::pass);
  pass.undecided_rows = 5;
  j = Made(pass).judged("vulkan", "typical");
  EXPECT_EQ(j.status, Status::untested);
  EXPECT_EQ(j.reason, "62.50 % of the elements have no useful bound, neither from the profile nor from what known devices do");
  EXPECT_EQ(Made(pass).judged("ieee").status, Status::pass);
}
// To the element, and free elements do not count.
TEST(Judge, TheLimitIsHalf) {
  CaseJudgement j;
  j.outputs.resize(2);
  j.outputs[0].elements = 700;
  j.outputs[0].free = 100;
  j.outputs[1].elements = 300;
  j.outputs[1].unbounded = 300;
  const auto concluded = [&] {
    conclude(j, profile("vulkan"));
    return j.status;
  };
  j.outputs[0].unbounded = 150;
  EXPECT_EQ(concluded(), Status::pass) << j.reason;
  j.outputs[0].unbounded = 151;
  EXPECT_EQ(concluded(), Status::untested);
  // What lies outside is worse.
  j.failing = 1;
  EXPECT_EQ(concluded(), Status::fail);
}
// Not those of the first alone; and who the known devices are, and which of the census is not among them.
TEST(Judge, AWarningCountsAllCases) {
  PassJudgement pass;
  pass.cases.resize(3);
  for (CaseJudgement& c : pass.cases) c.outputs.resize(1);
  pass.cases[0].rearranged = 45;
  pass.cases[0].rearranged_distance = 28;
  pass.cases[1].rearranged = 2360;
  pass.cases[1].rearranged_distance = 40;
  pass.cases[2].outputs[0].atypical = 3;
  for (CaseJudgement& c : pass.cases) {
    c.outputs[0].elements = 5000;
    conclude(c, profile("vulkan"));
    EXPECT_EQ(c.status, Status::warn);
  }
  conclude(pass, profile("vulkan"));
  EXPECT_EQ(pass.status, Status::warn);
  EXPECT_NE(pass.reason.find("2405 invocations lie outside the formula as written, by up to 40 codes, inside its rearrangements"),
            std::string::npos)
      << pass.reason;
  EXPECT_NE(pass.reason.find("3 elements lie inside the profile vulkan but outside what known devices do (typical: two NVIDIA chips, "),
            std::string::npos)
      << pass.reason;
  EXPECT_NE(pass.reason.find("outside it lie SwiftShader (exp2, "), std::string::npos) << pass.reason;
  // As failures they keep their reasons.
  PortJudgement port;
  port.passes = {pass};
  conclude(port);
  EXPECT_EQ(port.status, Status::warn);
  fail_warnings(port);
  EXPECT_EQ(port.status, Status::fail);
  EXPECT_EQ(port.passes[0].status, Status::fail);
  EXPECT_EQ(port.passes[0].reason, "a warning, which is to fail: " + pass.reason);
  for (const CaseJudgement& c : port.passes[0].cases) EXPECT_TRUE(c.broken && c.status == Status::fail);
}
// The reason of a failure that is counted is that of all cases, or none.
TEST(Judge, AReasonOfOneCaseIsNoneOfAnother) {
  PassJudgement pass;
  pass.cases.resize(2);
  for (CaseJudgement& c : pass.cases) c.failing = c.expanded = 10;
  const auto concluded = [&] {
    pass.reason.clear();
    for (CaseJudgement& c : pass.cases) conclude(c, profile("vulkan"));
    conclude(pass, profile("vulkan"));
    return pass.reason;
  };
  EXPECT_NE(concluded().find("would explain the 20 invocations outside"), std::string::npos) << pass.reason;
  pass.cases[1].expanded = 9;
  EXPECT_EQ(concluded(), "");
}
TEST(Judge, HalfStoresAreJudgedByEachRounding) {
  Made m({}, Format::rg16f);
  const auto failing = [&] {
    const ModeJudgements j = m.all("vulkan");
    EXPECT_EQ(j.modes, (std::vector<HalfMode>{HalfMode::rne, HalfMode::rtz, HalfMode::either}));
    return std::tuple(j.judgements[0].failing > 0, j.judgements[1].failing > 0, j.judgements[2].failing > 0);
  };
  EXPECT_EQ(failing(), std::tuple(false, true, false));
  const auto cut = [&](int from, int to) {
    for (int y = from; y < to; ++y)
      for (int x = 0; x < columns; ++x) m.put(x, y, 0, to_float(to_half(static_cast<float>(x + 1) / 3.0f, Rounding::rtz)));
  };
  cut(0, rows / 2);
  EXPECT_EQ(failing(), std::tuple(true, true, false));
  cut(0, rows);
  EXPECT_EQ(failing(), std::tuple(true, false, false));
  EXPECT_EQ(m.all("d3d").modes.front(), HalfMode::rtz);
  EXPECT_EQ(m.judged("d3d").failing, 0);
}
TEST(Judge, BitsAreBits) {
  Made m({});
  m.put(1, 1, 0, std::nextafterf(2.0f / 3.0f, 9));
  EXPECT_EQ(m.judged("vulkan").status, Status::pass);
  m.c.outputs[0].judge = capture::Judge::bits;
  const CaseJudgement j = m.judged("vulkan");
  EXPECT_EQ(j.failing, 1);
  EXPECT_EQ(std::tuple(j.outputs.back().worst[0].x, j.outputs.back().worst[0].y), std::tuple(1, 1));
  m.c.outputs[0].judge = capture::Judge::input_only;
  EXPECT_EQ(m.judged("vulkan").status, Status::data);
}

}  // namespace
}  // namespace rainref::judge
