// Mistakes in the order of steps, and in what is drawn of random words.
#include "faults/order_faults.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "faults/bits_replay.h"
#include "faults/draw_faults.h"
#include "judge/evaluations.h"
#include "judge/support.h"

namespace rainref::faults {
namespace {

using perturbed::Op;
using perturbed::Perturbed;
using perturbed::Rewrite;
using perturbed::RewriteKind;
using perturbed::Trace;

/// What f gives, and what with a rewrite at the first place of `op`.
template <class F>
float rewritten(const F& f, Op op, Rewrite r) {
  Trace trace;
  perturbed::Behaviour following;
  following.trace = &trace;
  {
    const perturbed::Scope scope(following);
    f();
  }
  for (const Trace::Node& n : trace.nodes)
    if (n.op == op && r.shape == 0) r.shape = n.shape;
  Trace again;
  following.trace = &again;
  const perturbed::Scope scope(following);
  const perturbed::RewriteScope rewriting(r);
  return f().v;
}
/// 2 * 3 + 5.
Perturbed damped_sum() { return Perturbed(2.0f) * Perturbed(3.0f) + Perturbed(5.0f); }
/// (3 + 5) * 2.
Perturbed scaled_sum() { return (Perturbed(3.0f) + Perturbed(5.0f)) * Perturbed(2.0f); }

TEST(OrderFaults, AFactorMovesOverTheSumAndInto) {
  EXPECT_EQ(rewritten(damped_sum, Op::sum, {}), 11);
  EXPECT_EQ(rewritten(damped_sum, Op::sum, {RewriteKind::over_all, 0, -1, 0, {0, -1}}), (3 + 5) * 2);
  EXPECT_EQ(rewritten(damped_sum, Op::sum, {RewriteKind::over_all, 0, -1, 0, {1, -1}}), (2 + 5) * 3);
  EXPECT_EQ(rewritten(scaled_sum, Op::product, {RewriteKind::over_first, 0, -1, 0, {-1, -1}}), 3 * 2 + 5);
  EXPECT_EQ(rewritten(scaled_sum, Op::product, {RewriteKind::over_second, 0, -1, 0, {-1, -1}}), 3 + 5 * 2);
}
// x += (v + a) dt in place of v alone: the operand of the product is a part of what it should be, elsewhere the sum stays.
TEST(OrderFaults, AValueOfBeforeIsUsedAtOnePlaceAlone) {
  const auto step = [] {
    const Perturbed velocity = Perturbed(7.0f) + Perturbed(4.0f);
    return velocity * Perturbed(10.0f) - velocity;
  };
  EXPECT_EQ(rewritten(step, Op::product, {RewriteKind::part, 0, -1, 0, {0, -1}}), 7 * 10 - 11);
  EXPECT_EQ(rewritten(step, Op::difference, {RewriteKind::part, 0, -1, 1, {1, -1}}), 11 * 10 - 4);
  EXPECT_EQ(rewritten(step, Op::difference, {RewriteKind::part, 0, -1, 1, {0, 0}}), 11 * 10 - 11) << "a leaf has no parts";
}

// A port of whole numbers that draws with a mistake is told which, by the first cause, and nothing else is as good.
TEST(DrawFaults, EachIsNamed) {
  const capture::Pack pack(judge::test::pack_folder("puddle-corrected"));
  std::vector<Fault> all;
  add_draw_faults(all);
  const parallel::Executor one(1);
  int named = 0;
  for (const capture::PackCase& entry : pack.cases) {
    if (entry.pass != "raindrops") continue;
    const capture::PassCase c = pack.read(entry);
    const capture::PassEvaluations& evaluations = *judge::evaluations_of(c.effect, c.pass);
    EXPECT_EQ(evaluations.recompute(c)[0].levels, c.outputs[0].array.levels);
    for (const Fault& d : all) {
      capture::Array port;
      {
        const random::DrawsScope scope(*d.draws);
        port = evaluations.recompute(c)[0];
      }
      BitsReplay run(pack.pass("raindrops"), c, nullptr, evaluations, port, 0, one);
      if (!run.fails()) continue;
      const std::vector<judge::Cause> causes = diagnosed(run, nullptr);
      ASSERT_FALSE(causes.empty()) << d.name;
      EXPECT_TRUE(std::any_of(causes.begin(), causes.end(), [&](const judge::Cause& cause) { return cause.name == d.name; })) << d.name;
      named += causes[0].name == d.name;
    }
  }
  EXPECT_GT(named, 10);
}

}  // namespace
}  // namespace rainref::faults
