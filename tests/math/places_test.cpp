// One mistake at one place of a text: what it makes of each operation, which operations it concerns, and that the others keep
// their bits.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "math/perturbed.h"

namespace rainref::perturbed {
namespace {

Perturbed d(float x) { return Perturbed::of(x); }

/// What `text` does.
Trace traced(const std::function<Perturbed()>& text, const std::vector<float>* known = nullptr) {
  Trace trace;
  Behaviour b;
  b.trace = &trace;
  b.known = known;
  const Scope scope(b);
  text();
  return trace;
}
/// The text's value with a fault at its last operation.
float with_fault(const std::function<Perturbed()>& text, PlaceFault fault) {
  const Trace trace = traced(text);
  Behaviour b;
  b.places[0] = {trace.nodes.back().shape, -1, fault};
  const Scope scope(b);
  return text().v;
}

struct Case {
  PlaceFault fault;
  std::function<Perturbed()> text;
  float with;
};
// Each value worked out by hand.
const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {PlaceFault::first, [] { return d(5) + d(3); }, 5},
      {PlaceFault::second, [] { return d(5) + d(3); }, 3},
      {PlaceFault::second_negated, [] { return d(5) + d(3); }, 2},
      {PlaceFault::swapped, [] { return d(5) + d(3); }, -2},
      {PlaceFault::first_twice, [] { return d(5) + d(3); }, 13},
      {PlaceFault::second_twice, [] { return d(5) + d(3); }, 11},
      {PlaceFault::first, [] { return d(5) - d(3); }, 5},
      {PlaceFault::second, [] { return d(5) - d(3); }, -3},
      {PlaceFault::second_negated, [] { return d(5) - d(3); }, 8},
      {PlaceFault::swapped, [] { return d(5) - d(3); }, -2},
      {PlaceFault::second_twice, [] { return d(5) - d(3); }, -1},
      {PlaceFault::rooted, [] { return d(5) + d(4); }, 3},
      {PlaceFault::first, [] { return d(5) * d(3); }, 5},
      {PlaceFault::second, [] { return d(5) * d(3); }, 3},
      {PlaceFault::first_squared, [] { return d(5) * d(3); }, 75},
      {PlaceFault::second_squared, [] { return d(5) * d(3); }, 45},
      {PlaceFault::inverted, [] { return d(6) * d(3); }, 2},
      {PlaceFault::negated, [] { return d(5) * d(3); }, -15},
      {PlaceFault::doubled, [] { return d(5) * d(3); }, 30},
      {PlaceFault::halved, [] { return d(5) * d(3); }, 7.5f},
      {PlaceFault::squared, [] { return d(5) * d(3); }, 225},
      {PlaceFault::first, [] { return d(6) / d(3); }, 6},
      {PlaceFault::swapped, [] { return d(6) / d(3); }, 0.5f},
      {PlaceFault::inverted, [] { return d(6) / d(3); }, 18},
      {PlaceFault::first, [] { return -d(5); }, 5},
      {PlaceFault::first, [] { return min(d(5), d(3)); }, 5},
      {PlaceFault::other, [] { return min(d(5), d(3)); }, 5},
      {PlaceFault::other, [] { return max(d(5), d(3)); }, 3},
      {PlaceFault::first, [] { return abs(d(-5)); }, -5},
      {PlaceFault::first, [] { return sqrt(d(9)); }, 9},
      {PlaceFault::first, [] { return square(d(3)); }, 3},
      {PlaceFault::other, [] { return square(d(3)); }, 27},
      {PlaceFault::other, [] { return floor(d(1.75f)); }, 2},
      {PlaceFault::first, [] { return fract(d(1.75f)); }, 1.75f},
      {PlaceFault::other, [] { return exp(d(1)); }, 2},
      {PlaceFault::linear, [] { return exp(d(1)); }, 2},
      {PlaceFault::other, [] { return exp2(d(0)); }, 1},
      {PlaceFault::first, [] { return pow(d(4), d(2)); }, 4},
      {PlaceFault::inverted, [] { return pow(d(4), d(2)); }, 2},
      {PlaceFault::other, [] { return sin(d(0)); }, 1},
      {PlaceFault::other, [] { return cos(d(0)); }, 0},
      {PlaceFault::swapped, [] { return atan2(d(1), d(0)); }, 0},
      {PlaceFault::swapped, [] { return mix(d(1), d(2), d(0.25f)); }, 1.75f},
      {PlaceFault::first, [] { return mix(d(1), d(2), d(0.25f)); }, 1},
      {PlaceFault::added, [] { return mix(d(1), d(2), d(0.25f)); }, 1.5f},
      {PlaceFault::swapped, [] { return smoothstep(0, 1, d(0.25f)); }, 1 - 0.15625f},
      {PlaceFault::other, [] { return smoothstep(0, 1, d(0.25f)); }, 0.25f},
      {PlaceFault::swapped, [] { return select(true, d(1), d(2)); }, 2},
      {PlaceFault::swapped, [] { return select(false, d(1), d(2)); }, 1},
      {PlaceFault::saturated, [] { return d(5) + d(3); }, 1},
      {PlaceFault::zero, [] { return d(5) + d(3); }, 0},
  };
  return all;
}
TEST(Places, EachSlipIsWhatItsNameSays) {
  for (const Case& c : cases()) EXPECT_EQ(with_fault(c.text, c.fault), c.with) << static_cast<int>(c.fault) << ": " << c.text().v;
}
TEST(Places, AMixInGammaSpaceEncodesByThePower) {
  const double encoded = 0.75 * std::pow(0.2, 1 / 2.2) + 0.25 * std::pow(0.8, 1 / 2.2);
  // 4 ULP of a float: three powers, and the rounding of 1 / 2.2.
  EXPECT_NEAR(with_fault([] { return mix(d(0.2f), d(0.8f), d(0.25f)); }, PlaceFault::in_gamma), std::pow(encoded, 2.2), 4 * 0x1p-24);
}
TEST(Places, AConditionMayHoldAlwaysOrNever) {
  const auto smaller = [](float a) { return [a] { return select(d(a) < d(2), d(10), d(20)); }; };
  const Trace trace = traced(smaller(1));
  ASSERT_EQ(trace.nodes[0].op, Op::comparison);
  for (const float a : {1.0f, 3.0f})
    for (const PlaceFault fault : {PlaceFault::always, PlaceFault::never}) {
      Behaviour b;
      b.places[0] = {trace.nodes[0].shape, -1, fault};
      const Scope scope(b);
      EXPECT_EQ(smaller(a)().v, fault == PlaceFault::always ? 10 : 20);
    }
}

// (1 + 2) * (3 + 4) has two sums of one shape; the product is another.
const auto two_sums = [] { return (d(1) + d(2)) * (d(3) + d(4)); };
TEST(Places, OperationsOfOneShapeAreToldApartByTheirOrder) {
  const Trace trace = traced(two_sums);
  ASSERT_EQ(trace.nodes.size(), 3u);
  std::vector<float> values;
  for (const Trace::Node& n : trace.nodes) {
    Behaviour b;
    b.places[0] = {n.shape, n.occurrence, PlaceFault::zero};
    const Scope scope(b);
    values.push_back(two_sums().v);
  }
  EXPECT_EQ(trace.nodes[0].shape, trace.nodes[1].shape);
  EXPECT_NE(trace.nodes[0].shape, trace.nodes[2].shape);
  EXPECT_EQ(trace.nodes[0].occurrence + trace.nodes[1].occurrence, 1);
  EXPECT_EQ(values, (std::vector<float>{0, 0, 0}));
  for (const std::int32_t occurrence : {-1, 0, 1}) {
    Behaviour b;
    b.places[0] = {trace.nodes[0].shape, occurrence, PlaceFault::doubled};
    const Scope scope(b);
    EXPECT_EQ(two_sums().v, occurrence < 0 ? 84 : 42);
  }
}
// Two places at once: both coordinates of a lookup.
TEST(Places, TwoPlacesMayBelongTogether) {
  const auto text = [] { return sqrt(d(16)) * square(d(3)); };
  const Trace trace = traced(text);
  Behaviour b;
  for (const Trace::Node& n : trace.nodes) {
    if (n.op == Op::root) b.places[0] = {n.shape, -1, PlaceFault::first};
    if (n.op == Op::square) b.places[1] = {n.shape, -1, PlaceFault::first};
  }
  const Scope scope(b);
  EXPECT_EQ(text().v, 48);
}

TEST(Places, KnownConstantsTellPlacesApartAndOthersDoNot) {
  const auto times = [](float constant) { return [constant] { return Perturbed(constant) * d(3); }; };
  const std::vector<float> known{2, 5};
  EXPECT_NE(traced(times(2), &known).nodes.back().shape, traced(times(5), &known).nodes.back().shape);
  EXPECT_EQ(traced(times(7), &known).nodes.back().shape, traced(times(8), &known).nodes.back().shape);
  EXPECT_EQ(traced(times(2)).nodes.back().shape, traced(times(5)).nodes.back().shape);
}
TEST(Places, ATraceHasTheOperationsAndTheirOperands) {
  const float texel = 9;
  const Trace trace = traced([&] { return Perturbed(2.0f) * Perturbed::load(&texel) + mix(d(1), d(2), d(0.5f)); });
  std::vector<Op> ops;
  for (const Trace::Node& n : trace.nodes) ops.push_back(n.op);
  // The parts of a mix are none of the text; which operand of a sum comes first is the compiler's.
  EXPECT_EQ(ops.size(), 5u);
  const Trace::Node& sum = trace.nodes.back();
  ASSERT_EQ(sum.op, Op::sum);
  EXPECT_EQ(sum.value, 19.5f);
  const Trace::Node& product = trace.nodes[static_cast<std::size_t>(sum.of[0])];
  ASSERT_EQ(product.op, Op::product);
  EXPECT_EQ(trace.nodes[static_cast<std::size_t>(product.of[0])].op, Op::constant);
  EXPECT_EQ(trace.nodes[static_cast<std::size_t>(product.of[1])].value, 9);
  EXPECT_EQ(trace.nodes[static_cast<std::size_t>(sum.of[1])].op, Op::mix);
}
TEST(Places, LoadsAndColumnsAreReplaced) {
  const float texels[] = {9, 8};
  const std::vector<float> loads{NAN, 5};
  Behaviour b;
  b.loads = &loads;
  b.column_offset = -0.5f;
  {
    const Scope scope(b);
    EXPECT_EQ(Perturbed::load(texels).v, 9);  // not a number: as it is
    EXPECT_EQ(Perturbed::load(texels + 1).v, 5);
    EXPECT_EQ(Perturbed::load(texels + 1).v, 8);
    EXPECT_EQ(Perturbed::index(3).v, 2.5f);
  }
  b.column_offset = 10;
  b.is_column_mirrored = true;
  const Scope scope(b);
  EXPECT_EQ(Perturbed::index(3).v, 7);
}

// 300 shapes that collide in any table of fewer than 2^20 places, each met three times.
TEST(Trace, CountsShapesAndFindsTheirValues) {
  Trace t;
  for (int again = 0; again < 2; ++again) {
    constexpr std::uint32_t shapes = 300, apart = 1u << 20;
    for (std::uint32_t k = 0; k < 3 * shapes; ++k) {
      t.add(Op::sum, static_cast<float>(k), k % shapes * apart);
      ASSERT_EQ(t.nodes.size(), k + 1);
      EXPECT_EQ(t.nodes[k].occurrence, static_cast<std::int32_t>(k / shapes));
      EXPECT_EQ(t.met.at(k % shapes * apart), static_cast<std::int32_t>(k / shapes) + 1);
    }
    EXPECT_EQ(t.met.at(1), 0);
    EXPECT_EQ(t.value_met(1, 1, t.nodes.size()), nullptr);
    EXPECT_EQ(*t.value_met(7 * apart, 1, t.nodes.size()), 607);
    EXPECT_EQ(*t.value_met(7 * apart, 3, t.nodes.size()), 7);
    EXPECT_EQ(t.value_met(7 * apart, 4, t.nodes.size()), nullptr);
    EXPECT_EQ(*t.value_met(7 * apart, 1, 607), 307);
    t.clear();
    EXPECT_EQ(t.met.at(7 * apart), 0);
  }
}

}  // namespace
}  // namespace rainref::perturbed
