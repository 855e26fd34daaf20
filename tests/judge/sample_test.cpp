// Widths and shares are a sample's: how it is drawn, and what is told by it.
#include "judge/sample.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <gmock/gmock.h>

#include "judge/judge.h"
#include "judge/mini_port.h"
#include "judge/reference_outputs.h"
#include "judge/support.h"

namespace rainref::judge {
namespace {

using capture::Array;
using capture::PassCase;
using testing::HasSubstr;

// ---- a made-up pass ------------------------------------------------------------------------------------------------
/// A third of the column, without a bound in the first rows: there are more decisions than anyone follows.
struct OpenRows {
  int width = 200, height = 150, values = 1;
  int open_rows = 0;
  template <class N>
  void operator()(int x, int y, N* out) const {
    const N third = (N::index(x) + N(1.0f)) / N(3.0f);
    out[0] = third;
    for (int k = 0; y < open_rows && k < 5; ++k) out[0] = select(third / third > N(1.0f), N(1.0f), out[0]);
  }
};
struct Made {
  PassCase c;
  std::unique_ptr<capture::PassModel> model;
  std::vector<Array> port;

  explicit Made(int open_rows, int width = 200, Format format = Format::r32f) {
    OpenRows pass;
    pass.width = width;
    pass.open_rows = open_rows;
    model = capture::model_of(pass);
    c.effect = "made_up";
    c.pass = "open_rows";
    capture::CaseOutput out;
    out.name = "thirds";
    out.range = {0, 80};
    out.array.format = format;
    out.array.width = pass.width;
    out.array.height = pass.height;
    out.array.levels.emplace_back(static_cast<std::size_t>(pass.width * pass.height * info(format).texel_bytes()));
    c.outputs = {out};
    c.outputs[0].array = reference_outputs(c, *model, test_executor())[0];
    port = {c.outputs[0].array};
  }
  CaseJudgement judged(std::int64_t sample) const {
    return judge_case(c, model.get(), port, {&profile("vulkan"), &profile("typical"), &test_executor(), std::nullopt, sample})
        .judgements[0];
  }
};

// ---- the sample ----------------------------------------------------------------------------------------------------
TEST(Sample, OneOfEachStratumIsDrawn) {
  const Made made(0);
  const Sample sample(made.c, *made.model, 1000);
  EXPECT_EQ(sample.stride(), 30);
  std::set<std::int64_t> drawn;
  sample.each(1, [&](int x, int y) { drawn.insert(static_cast<std::int64_t>(y) * 200 + x); });
  EXPECT_EQ(drawn.size(), 1000u);
  std::int64_t stratum = 0;
  for (const std::int64_t at : drawn) EXPECT_EQ(at / 30, stratum++);
  for (int y = 0; y < 150; ++y)
    for (int x = 0; x < 200; ++x) EXPECT_EQ(sample.has(x, y), drawn.contains(static_cast<std::int64_t>(y) * 200 + x));
  // What lies between them is the rest, wherever one begins and ends.
  for (const std::int64_t first : {0, 1, 29, 30, 31, 4567})
    for (const std::int64_t last : {4567, 4600, 29999, 30000}) {
      std::vector<std::int64_t> rest, expected;
      sample.each_left_out(first, last, [&](std::int64_t begin, std::int64_t end) {
        EXPECT_LT(begin, end);
        for (std::int64_t at = begin; at < end; ++at) rest.push_back(at);
      });
      for (std::int64_t at = first; at < last; ++at)
        if (!drawn.contains(at)) expected.push_back(at);
      EXPECT_EQ(rest, expected) << first << ' ' << last;
    }
}
TEST(Sample, SmallRunsAreAskedWhole) {
  const Made made(0);
  for (const std::int64_t least : {0, 15001, 30000, 1000000}) {
    EXPECT_TRUE(Sample(made.c, *made.model, least).is_whole()) << least;
    EXPECT_EQ(Sample(made.c, *made.model, least).margin(1), 0);
  }
  EXPECT_FALSE(Sample(made.c, *made.model, 15000).is_whole());
}
TEST(Sample, IsDrawnByThePackAndNotByThePort) {
  const auto drawn = [](const Made& made) {
    std::set<std::pair<int, int>> found;
    Sample(made.c, *made.model, 1000).each(1, [&](int x, int y) { found.emplace(x, y); });
    return found;
  };
  Made made(0);
  const auto first = drawn(made);
  made.port[0].levels[0].edit()[5] ^= std::byte{1};
  EXPECT_EQ(drawn(made), first);
  made.c.outputs[0].array.levels[0].edit()[5] ^= std::byte{1};
  EXPECT_NE(drawn(made), first);
}
TEST(Sample, RunsShareWhatAPassIsAsked) {
  EXPECT_EQ(sample_of_run(least_sample, 2073600, 2073600), least_sample);
  EXPECT_EQ(sample_of_run(least_sample, 2073600, 8 * 2073600), least_sample / 8);
  EXPECT_EQ(sample_of_run(least_sample, 2073600, 100 * 2073600), 1024) << "enough to tell whether half has a bound";
  EXPECT_EQ(sample_of_run(least_sample, 1000, 16000), 0) << "a pass of fewer is asked whole";
  EXPECT_EQ(sample_of_run(0, 2073600, 2073600), 0);
}
TEST(Sample, TheMarginHoldsForEveryShare) {
  const Made made(0);
  const Sample sample(made.c, *made.model, 1000);
  for (int share = 1; share < 10; ++share) {
    std::int64_t count = 0;
    sample.each(1, [&](int x, int y) { count += (7 * x + 13 * y) % 10 < share; });
    EXPECT_LT(std::abs(static_cast<double>(count * sample.stride()) - 3000.0 * share), sample.margin(1));
  }
  EXPECT_NEAR(sample.margin(1) / 30000, std::sqrt(40 * std::log(2.0) / 2000), 1e-12);
}

// ---- shares --------------------------------------------------------------------------------------------------------
TEST(SampledVerdict, SharesAreThoseOfTheSampleAndWhatDiffersIsAllAsked) {
  Made made(15);
  for (int k = 0; k < 40; ++k) change_at<float>(made.port[0].levels[0].edit().data() + 4 * (8000 + 97 * k), [](float v) { return v + 1; });
  const CaseJudgement all = made.judged(0), some = made.judged(1000);
  EXPECT_EQ(all.failing, 40);
  EXPECT_EQ(all.stride, 1);
  EXPECT_EQ(some.stride, 30);
  EXPECT_EQ(some.failing, 40);
  EXPECT_EQ(some.outputs[0].elements, 30000);
  EXPECT_EQ(some.outputs[0].sampled(), 1000);
  EXPECT_EQ(some.outputs[0].quantities[0].sampled(), 1000);
  EXPECT_EQ(some.outputs[0].map, all.outputs[0].map);
  EXPECT_NEAR(static_cast<double>(some.gave_up), static_cast<double>(all.gave_up) / 30, 3) << "strata lie in rows: few hold both kinds";
  EXPECT_EQ(some.outputs[0].vacuous, some.gave_up);
  EXPECT_NEAR(some.outputs[0].median_width, all.outputs[0].median_width, 1);
}
// If most of 1000 sampled invocations fail, the rest would say no more. If one in 30 fails, the sample has fewer than the 400 that the
// search for causes wants, so all is judged.
TEST(SampledVerdict, WhatFailsMuchIsJudgedByItsSampleAlone) {
  for (const int every : {1, 2, 30}) {
    Made made(0);
    for (int k = 0; k < 30000; k += every) change_at<float>(made.port[0].levels[0].edit().data() + 4 * k, [](float v) { return v + 1; });
    const CaseJudgement all = made.judged(0), some = made.judged(1000);
    EXPECT_EQ(some.status, all.status) << every;
    EXPECT_EQ(all.failing, 30000 / every);
    EXPECT_FALSE(all.is_of_sample);
    ASSERT_EQ(some.is_of_sample, every < 30);
    if (every == 30) {
      EXPECT_EQ(some.failing, all.failing);
      continue;
    }
    EXPECT_EQ(some.invocations, 1000);
    EXPECT_EQ(some.outputs[0].elements, 1000);
    EXPECT_EQ(some.outputs[0].sampled(), 1000);
    EXPECT_EQ(some.outputs[0].worst.size(), OutputJudgement::max_failures);
    EXPECT_NEAR(static_cast<double>(some.failing) * 30, static_cast<double>(all.failing), Sample(made.c, *made.model, 1000).margin(1));
    const Sample sample(made.c, *made.model, 1000);
    for (int y = 0; y < 150; ++y)
      for (int x = 0; x < 200; ++x) {
        const auto at = static_cast<std::size_t>(200 * y + x);
        EXPECT_EQ(some.outputs[0].map[at], sample.has(x, y) ? all.outputs[0].map[at] : OutputJudgement::not_judged) << x << ' ' << y;
      }
  }
}
// A port that cuts its halves fails much where they are taken as rounded; it passes, and all of it is judged.
TEST(SampledVerdict, WhatOneRoundingHoldsIsJudgedWhole) {
  Made made(0, 200, Format::r16f);
  made.port[0] = reference_outputs(made.c, *made.model, test_executor(), HalfMode::rtz)[0];
  const ModeJudgements j = judge_case(made.c, made.model.get(), made.port,
                                      {&profile("vulkan"), &profile("typical"), &test_executor(), std::nullopt, 1000, nullptr, true});
  ASSERT_EQ(j.judgements.size(), 3u);
  for (const CaseJudgement& one : j.judgements) EXPECT_FALSE(one.is_of_sample);
  EXPECT_GT(j.judgements[0].failing, 9000) << "two thirds of the thirds are no halves, and half of these round up";
  EXPECT_EQ(j.judgements[1].failing, 0);
}
TEST(SampledVerdict, UntestedIsToldByTheSampleWhereItsMarginAllows) {
  const CaseJudgement bounded = Made(15).judged(1000), open = Made(120).judged(1000);
  EXPECT_EQ(bounded.status, Status::pass) << bounded.reason;
  EXPECT_EQ(bounded.stride, 30);
  EXPECT_EQ(open.status, Status::untested);
  EXPECT_EQ(open.stride, 30);
  EXPECT_THAT(open.reason, HasSubstr("by a sample of them"));
}
TEST(SampledVerdict, CloseToAHalfAllAreAsked) {
  for (const int rows : {70, 75, 76, 80}) {
    const CaseJudgement j = Made(rows).judged(1000);
    EXPECT_EQ(j.stride, 1) << rows;
    EXPECT_EQ(j.status, rows > 75 ? Status::untested : Status::pass) << rows;
  }
}

}  // namespace
}  // namespace rainref::judge
