// Mistakes in the order of steps, and in what is drawn of random words.
#include "faults/generators.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "faults/bits_replay.h"
#include "faults/diagnosis.h"
#include "faults/draw_faults.h"
#include "faults/place_faults.h"
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
  const perturbed::RewriteScope rewriting({r});
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
/// floor(2.75) + 5.5, and floor(2.75 + 5.5).
Perturbed sum_of_floor() { return floor(Perturbed(2.75f)) + Perturbed(5.5f); }
Perturbed floor_of_sum() { return floor(Perturbed(2.75f) + Perturbed(5.5f)); }
/// max(2 * 3, 5).
Perturbed damped_maximum() { return max(Perturbed(2.0f) * Perturbed(3.0f), Perturbed(5.0f)); }
/// (3 + 5) / 2.
Perturbed mean() { return (Perturbed(3.0f) + Perturbed(5.0f)) / Perturbed(2.0f); }

TEST(OrderFaults, AFunctionMovesOverTheSumAndInto) {
  EXPECT_EQ(rewritten(sum_of_floor, Op::sum, {RewriteKind::function_of_all, 0, -1, 0, {-1, -1}}), 8);
  EXPECT_EQ(rewritten(floor_of_sum, Op::floor, {RewriteKind::function_of_first, 0, -1, 0, {-1, -1}}), 2 + 5.5f);
  EXPECT_EQ(rewritten(floor_of_sum, Op::floor, {RewriteKind::function_of_second, 0, -1, 0, {-1, -1}}), 2.75f + 5);
}
TEST(OrderFaults, AFactorMovesOverAMaximumAndADivisorIntoASum) {
  EXPECT_EQ(rewritten(damped_maximum, Op::maximum, {RewriteKind::over_all, 0, -1, 0, {0, -1}}), 2 * 5);
  EXPECT_EQ(rewritten(mean, Op::quotient, {RewriteKind::over_first, 0, -1, 0, {-1, -1}}), 1.5f + 5);
}

/// min(max(9, 0), 1) * 2: without the clamp 18.
TEST(OrderFaults, AClampIsLeftOutWhole) {
  const auto held = [] {
    const Perturbed inner = max(Perturbed(9.0f), Perturbed(0.0f));
    return min(inner, Perturbed(1.0f)) * Perturbed(2.0f);
  };
  EXPECT_EQ(rewritten(held, Op::product, {}), 2);
  EXPECT_EQ(rewritten(held, Op::product, {RewriteKind::part, 0, -1, 0, {0, 0}}), 18);
}
/// 3 * sqrt(16) and sqrt(3 * 16), min(max(4 * 2, 0), 1), and a loop of two choices that both hold.
TEST(OrderFaults, AnOperationAndThatOfItsOperandAreExchanged) {
  const auto late = [] { return sqrt(Perturbed(4.0f) * Perturbed(16.0f)); };
  EXPECT_EQ(rewritten(late, Op::root, {RewriteKind::commuted, 0, -1, 0, {1, -1}}), 4 * 4);
  const auto held = [] { return min(max(Perturbed(4.0f) * Perturbed(2.0f), Perturbed(0.0f)), Perturbed(1.0f)); };
  EXPECT_EQ(rewritten(held, Op::minimum, {RewriteKind::commuted_outer_2, 0, -1, 0, {1, -1}}), 4 * 1);
  const auto scaled = [] { return Perturbed(0.5f) * min(max(Perturbed(4.0f), Perturbed(0.0f)), Perturbed(1.0f)); };
  EXPECT_EQ(rewritten(scaled, Op::product, {RewriteKind::commuted_inner_2, 0, -1, 1, {0, -1}}), 1);
  const auto last = [] {
    const Perturbed one = select(Perturbed(0.0f) < Perturbed(1.0f), Perturbed(7.0f), Perturbed(5.0f));
    return select(Perturbed(0.0f) < Perturbed(2.0f), Perturbed(9.0f), one);
  };
  EXPECT_EQ(rewritten(last, Op::choice, {}), 9);
  EXPECT_EQ(rewritten(last, Op::choice, {RewriteKind::first_wins, 0, -1, 1, {-1, -1}}), 7);
}

/// The faults of a pass that the order of steps makes, at some texels of a case of a small pack.
std::vector<Fault> orders_of(const std::string& pack_name, const std::string& pass, std::vector<Probe>& probes) {
  const capture::Pack pack(judge::test::pack_folder(pack_name));
  for (const capture::PackCase& entry : pack.cases) {
    if (entry.pass != pass) continue;
    const capture::PassCase c = pack.read(entry);
    const judge::Bind bind = judge::binder(c.effect, pass);
    const auto model = bind(c);
    const std::vector<float> known = constants_everywhere(*model);
    probes = probes_of({pack.pass(pass), c, bind, *model}, {{5, 5}, {9, 7}}, known);
    std::vector<Fault> out;
    add_order_faults(out, probes, known);
    return out;
  }
  return {};
}
// The two components of a vector stand at two places: a mistake in the vector is made at both, and said once.
TEST(OrderFaults, OfAVectorEachComponentHasTheMistake) {
  std::vector<Probe> probes;
  const std::vector<Fault> all = orders_of("windshield-corrected", "composite", probes);
  EXPECT_FALSE(vectors_of(probes[0]).empty());
  for (const std::vector<std::size_t>& v : vectors_of(probes[0])) {
    EXPECT_TRUE(v.size() == 2 || v.size() == 3);
    for (const std::size_t at : v) EXPECT_EQ(probes[0].trace.nodes[at].op, probes[0].trace.nodes[v[0]].op);
  }
  const auto of_vectors = std::count_if(all.begin(), all.end(), [](const Fault& d) {
    return name_of(d).ends_with(", in all components") && d.rewrites && (*d.rewrites)[1].kind == (*d.rewrites)[0].kind;
  });
  EXPECT_GT(of_vectors, 0);
}
// The place along a blade is held between its ends: what is left out is named as the clamp, not as a value of before.
TEST(OrderFaults, AClampHasItsName) {
  std::vector<Probe> probes;
  const std::vector<Fault> all = orders_of("windshield-as-published", "wipe_texture", probes);
  EXPECT_TRUE(std::any_of(all.begin(), all.end(), [](const Fault& d) { return name_of(d).starts_with("clamp left out: min(max("); }));
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
  add_draw_faults(all, {random::Purpose::puddle_drop_count, random::Purpose::puddle_drop});
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
      ASSERT_FALSE(causes.empty()) << name_of(d);
      // Any other words may by chance draw the same count; and the step, which is no sum of two terms, is as well another number.
      const bool is_one_of_many = d.draws->only == random::Purpose::puddle_drop_count || d.draws->moved[0] > 1;
      EXPECT_TRUE(is_one_of_many ||
                  std::any_of(causes.begin(), causes.end(), [&](const judge::Cause& cause) { return cause.name == name_of(d); }))
          << name_of(d);
      EXPECT_EQ(causes[0].explained, causes[0].of) << name_of(d);
      named += causes[0].name == name_of(d);
    }
  }
  EXPECT_GT(named, 10);
}

}  // namespace
}  // namespace rainref::faults
