// Wrong variables and numbers typed wrong: mistakes in passes written by hand, none of them in a set.
#include "faults/generators.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "faults/mistakes_puddle.h"
#include "judge/mini_port.h"

namespace rainref::faults {
namespace {

using namespace judge;
using capture::Array;
using capture::PassCase;
using perturbed::Change;
using perturbed::Op;
using perturbed::Perturbed;
using perturbed::Put;
using perturbed::Substitution;
using perturbed::Substitutions;
using testing::HasSubstr;

/// What f gives with another operand at the first place of `op`; the source is the `back`-th last number of that value.
template <class F>
float substituted(const F& f, Op op, Substitution s, float source) {
  perturbed::Trace trace;
  perturbed::Behaviour following;
  following.trace = &trace;
  const std::vector<float> known{2, 3, 5};
  following.known = &known;
  {
    const perturbed::Scope scope(following);
    f();
  }
  for (const perturbed::Trace::Node& n : trace.nodes) {
    if (n.op == op && s.shape == 0) s.shape = n.shape;
    if (n.op == Op::constant && n.value == source) s.source = n.shape;
  }
  Substitutions all{{s}};
  all.start();
  perturbed::Behaviour other;
  other.known = &known;
  other.substitutions = &all;
  const perturbed::Scope scope(other);
  return f().v;
}
Substitution other(std::int8_t operand, std::int32_t back, Change change = Change::none, Put how = Put::instead, float number = 0) {
  Substitution s;
  s.operand = operand;
  s.back = back;
  s.change = change;
  s.how = how;
  s.number = number;
  return s;
}

// (2 * 3) + 5: one operand alone is another value, at one place alone.
TEST(Substitutions, AnOperandIsAnotherValueOfTheInvocation) {
  const auto sum = [] {
    const Perturbed product = Perturbed(2.0f) * Perturbed(3.0f);
    return product + Perturbed(5.0f);
  };
  EXPECT_EQ(substituted(sum, Op::sum, other(0, 0, Change::none, Put::instead, 7), 0), 7 + 5);
  EXPECT_EQ(substituted(sum, Op::sum, other(1, 1), 3), 6 + 3);
  EXPECT_EQ(substituted(sum, Op::sum, other(0, 1, Change::negated), 2), -2 + 5);
  EXPECT_EQ(substituted(sum, Op::sum, other(1, 1, Change::squared, Put::times), 2), 6 + 5 * 4);
  EXPECT_EQ(substituted(sum, Op::sum, other(1, 1, Change::halved, Put::plus), 3), 6 + (5 + 1.5f));
  EXPECT_EQ(substituted(sum, Op::product, other(1, 1), 2), 2 * 2 + 5);
  EXPECT_EQ(substituted(sum, Op::product, other(1, 1), 5), 11) << "what comes later is not there yet";
}

/// A pass of the puddle by hand, with a mistake, judged.
PassJudgement judged(const std::string& name, const hand::Loop loop, const std::string& mistake) {
  const capture::Pack pack(small_packs / "puddle-corrected");
  TemporaryFolder folder;
  for (const capture::PackCase& entry : pack.cases) {
    if (entry.pass != name) continue;
    const PassCase c = pack.read(entry);
    std::vector<Array> out;
    for (const capture::CaseOutput& o : c.outputs) out.push_back(o.array);
    const std::vector<Slot> slots = slots_of(c);
    const hand::Run run(c, pack.pass(name).block, mistake);
    std::vector<float> values(slots.size());
    for (int y = 0; y < out[0].height; ++y)
      for (int x = 0; x < out[0].width; ++x) {
        if (!loop(run, x, y, values.data())) continue;
        for (std::size_t v = 0; v < slots.size(); ++v)
          store_value(slots[v], values[v], slots[v].store_rounding,
                      out[static_cast<std::size_t>(slots[v].output)].levels[0].edit().data() + slots[v].offset(x, y));
      }
    for (std::size_t o = 0; o < out.size(); ++o) put_array(folder / c.folder(), "out." + c.outputs[o].name, out[o]);
  }
  ValidateOptions options;
  options.only = {name};
  options.explain = faults::diagnose;
  options.executor = &test_executor();
  return pass_of(validate(pack, folder.path(), options), name);
}
/// The first cause of a mistake, with what it says.
std::string first_cause(const std::string& name, const hand::Loop loop, const std::string& mistake) {
  const PassJudgement j = judged(name, loop, mistake);
  EXPECT_EQ(j.status, Status::fail) << mistake;
  return j.causes.empty() ? "unknown" : j.causes[0].name + ": " + j.causes[0].sentence;
}

TEST(Solved, AWrongVariableIsNamed) {
  EXPECT_THAT(first_cause("wave_step", hand::wave_step_corrected, "velocity for the laplacian"),
              HasSubstr("wrong value: wave.x - wave.y for "));
}
TEST(Fitted, ANumberTypedWrongIsToldAsTyped) {
  EXPECT_THAT(first_cause("display", hand::puddle_display, "1.505 for 1.055"), HasSubstr("about 1.505 in the port"));
}
TEST(Outputs, ASquareAndAGreyPictureAreNamed) {
  EXPECT_THAT(first_cause("display", hand::puddle_display, "result squared"), HasSubstr("squared: the result"));
  EXPECT_THAT(first_cause("display", hand::puddle_display, "green for all"), HasSubstr("picture with its y for each"));
}

}  // namespace
}  // namespace rainref::faults
