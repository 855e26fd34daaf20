// The judge on passes made up for it, where every count is known, and on the small packs, whose reference must pass.
#include <gtest/gtest.h>

#include <cstring>

#include <fmt/format.h>

#include "conformance/judge.h"
#include "conformance/support.h"

namespace rainref::conformance {
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
  int undecided_row = -1;  ///< a row with more decisions than anyone follows
  float shift = 0;         ///< of row 7: a bound as wide as this
  template <class N>
  void operator()(int x, int y, N* out) const {
    const N third = (N::index(x) + N(1.0f)) / N(3.0f);
    out[0] = third;
    out[1] = select(third > N(5.0f / 3.0f), N(1.0f), N(0.0f));
    if (y == undecided_row)
      for (int k = 0; k < 5; ++k) out[1] = select(third / third > N(1.0f), N(1.0f), out[1]);
    if constexpr (std::is_same_v<N, enclosed::Enclosure>) {
      if (y == rows - 1) out[0] = enclosed::Enclosure(out[0].lo - shift, out[0].hi + shift);
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
    store_value(s, value, Rounding::rne, port[0].levels[0].data() + s.offset(x, y));
  }
  ModeJudgements all(const char* name, const char* typical = nullptr) const {
    return judge_case(c, model.get(), port,
                      {&profile(name), typical ? &profile(typical) : nullptr, &executor, std::nullopt});
  }
  CaseJudgement judged(const char* name, const char* typical = nullptr) const {
    return all(name, typical).judgements[0];
  }
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
  float far = 7.0f / 3.0f;
  for (int k = 0; k < 3; ++k) far = std::nextafterf(far, 9);
  m.put(6, 2, 0, far);
  const CaseJudgement j = m.judged("vulkan", "typical");
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
TEST(Judge, MoreThanOnePercentVacuousIsUntested) {
  ThirdPass pass;
  pass.undecided_row = 5;
  EXPECT_EQ(Made(pass).judged("vulkan").status, Status::untested);
  EXPECT_EQ(Made(pass).judged("ieee").status, Status::pass);
  pass.undecided_row = -1;
  pass.shift = 8.0f / 16 / 2.1f;  // just under 1/16 of the range
  EXPECT_EQ(Made(pass).judged("vulkan").outputs[0].vacuous, 0);
  EXPECT_EQ(Made(pass).judged("vulkan").outputs[0].loose, columns);
  pass.shift = 8.0f / 16 / 1.9f;
  EXPECT_EQ(Made(pass).judged("vulkan").outputs[0].vacuous, columns);
  EXPECT_EQ(Made(pass).judged("vulkan").status, Status::untested);
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
      for (int x = 0; x < columns; ++x)
        m.put(x, y, 0, to_float(to_half(static_cast<float>(x + 1) / 3.0f, Rounding::rtz)));
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

// ---- the small packs -----------------------------------------------------------------------------------------------
// Every envelope holds the reference, stored as the profile has it; no small pack leaves a pass untested.
TEST(Judge, TheReferenceOfTheSmallPacksPasses) {
  const parallel::Executor executor;
  std::vector<std::string> profiles = inexact_profiles();
  profiles.push_back("ieee");
  for (const BoundPass& pass : enveloped_passes()) {
    for (const BoundCase& b : pass.cases) {
      for (const std::string& name : profiles) {
        const enclosed::Profile& p = profile(name);
        std::vector<Array> port = b.expected();
        if (p.half_store == enclosed::StoreRounding::rtz) {
          for (int y = 0; y < b.model->height(); ++y)
            for (int x = 0; x < b.model->width(); ++x) {
              std::vector<plain::Plain<float>> values(b.slots.size());
              b.model->evaluate(x, y, values.data());
              for (std::size_t v = 0; v < values.size(); ++v) {
                const Slot& s = b.slots[v];
                if (s.kind == FormatInfo::float16)
                  store_value(s, values[v].v, Rounding::rtz,
                              port[static_cast<std::size_t>(s.output)].levels[0].data() + s.offset(x, y));
              }
            }
        }
        const CaseJudgement j =
            judge_case(*b.c, b.model.get(), port, {&p, nullptr, &executor, std::nullopt}).judgements[0];
        EXPECT_TRUE(j.status == Status::pass || (is_known_loose(pass.pass, name) && j.status == Status::untested && j.failing == 0))
            << b.c->folder() << ' ' << name << ": " << j.reason << ", failing " << j.failing;
      }
    }
  }
}

}  // namespace
}  // namespace rainref::conformance
