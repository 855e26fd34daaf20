// The line that a mistake stands in, on invocations made by hand: what the rules say, with nothing of a shader or of a pass.
#include "faults/shader_line.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace rainref::faults {
namespace {

using perturbed::Op;
using perturbed::Trace;

/// Adds an operation; its number. Each has a shape of its own, so that the reference with and without the mistake agree on it.
int add(Trace& t, Op op, float value, std::initializer_list<int> of = {}) {
  Trace::Node n{op, value, static_cast<std::uint32_t>(t.nodes.size()) + 1, 0};
  std::copy(of.begin(), of.end(), n.of.begin());
  std::transform(of.begin(), of.end(), n.with.begin(), [&](int operand) { return t.nodes[static_cast<std::size_t>(operand)].value; });
  t.nodes.push_back(n);
  return static_cast<int>(t.nodes.size()) - 1;
}
int add(capture::ProgramTrace& t, std::uint32_t instruction, Op op, float value, std::initializer_list<int> of = {}, int call = -1) {
  t.steps.push_back({instruction, call, 0});
  return add(t.values, op, value, of);
}

/// Eight invocations, whose inputs are unlike.
template <class Make>
std::vector<Followed> followed(const Make& make) {
  std::vector<Followed> out(8);
  for (std::size_t k = 0; k < out.size(); ++k) {
    const auto x = static_cast<float>(k);
    make(out[k], 0.3f + 0.17f * x, 1.9f - 0.11f * x * x, 0.01f * (x - 3) * (x - 3) * (x - 3));
  }
  return out;
}
/// (a b) + c, of which the mistake makes `first` + c.
void add_reference(Followed& f, float a, float b, float c, float first) {
  for (Trace* t : {&f.right, &f.wrong}) {
    const int na = add(*t, Op::load, a), nb = add(*t, Op::load, b), nc = add(*t, Op::load, c);
    const float product = t == &f.right ? a * b : first;
    const int p = add(*t, Op::product, product, {na, nb});
    add(*t, Op::sum, product + c, {p, nc});
  }
}

TEST(ShaderLine, IsTheFirstValueThatTheMistakeMakes) {
  const auto all = followed([](Followed& f, float a, float b, float c) {
    add_reference(f, a, b, c, a + b);
    const int na = add(f.port, 10, Op::load, a), nb = add(f.port, 11, Op::load, b), nc = add(f.port, 12, Op::load, c);
    const int wrong = add(f.port, 13, Op::sum, a + b, {na, nb});
    add(f.port, 14, Op::sum, a + b + c, {wrong, nc});
  });
  const auto lines = lines_of_mistake(all).lines;
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines[0].at, 13u);
  EXPECT_EQ(lines[0].until, 13u);
}
TEST(ShaderLine, IsFoundWhereThePortSumsInAnotherOrder) {
  // What the port computes is c + (a + b), with a as 2 (a / 2): values that the reference has not, and the mistake neither.
  const auto all = followed([](Followed& f, float a, float b, float c) {
    add_reference(f, a, b, c, a + b);
    const int nc = add(f.port, 9, Op::load, c), na = add(f.port, 10, Op::load, a), nb = add(f.port, 11, Op::load, b);
    const int half = add(f.port, 12, Op::product, a / 2, {na});
    const int twice = add(f.port, 13, Op::sum, a / 2 + a / 2, {half, half});
    const int wrong = add(f.port, 14, Op::sum, b + a, {nb, twice});
    add(f.port, 15, Op::sum, c + (b + a), {nc, wrong});
  });
  const auto lines = lines_of_mistake(all).lines;
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines[0].at, 14u);
}
TEST(ShaderLine, LiesBetweenTwoWhereAStepIsLeftOut) {
  const auto all = followed([](Followed& f, float a, float b, float c) {
    add_reference(f, a, b, c, a);
    const int na = add(f.port, 10, Op::load, a), nc = add(f.port, 12, Op::load, c);
    const int copy = add(f.port, 13, Op::stored, a, {na});
    add(f.port, 17, Op::sum, a + c, {copy, nc});
  });
  const auto lines = lines_of_mistake(all).lines;
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines[0].at, 13u);
  EXPECT_EQ(lines[0].until, 17u);
}
TEST(ShaderLine, OfAConstantIsWhereItIsSet) {
  // A factor of 2 is 3 in the port, which sets it at instruction 7 and takes it at 9.
  const auto all = followed([](Followed& f, float a, float, float) {
    for (Trace* t : {&f.right, &f.wrong}) {
      const float k = t == &f.right ? 2.0f : 3.0f;
      const int nk = add(*t, Op::constant, k), na = add(*t, Op::load, a);
      add(*t, Op::product, k * a, {nk, na});
    }
    const int given = add(f.port, capture::ProgramTrace::given, Op::constant, 3.0f), na = add(f.port, 5, Op::load, a);
    const int set = add(f.port, 7, Op::stored, 3.0f, {given});
    add(f.port, 9, Op::product, 3.0f * a, {set, na});
  });
  const auto lines = lines_of_mistake(all).lines;
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines[0].at, 7u);
}
/// a < b ? a b : c, and with the mistake the other way. `is_choice`: the mistake is in the choice.
void add_decision(Followed& f, float a, float b, float c, bool is_choice) {
  for (Trace* t : {&f.right, &f.wrong}) {
    const bool is_wrong = t == &f.wrong, is_less = (a < b) != (is_wrong && !is_choice), takes_product = (a < b) != is_wrong;
    const int na = add(*t, Op::load, a), nb = add(*t, Op::load, b), nc = add(*t, Op::load, c);
    const int product = add(*t, Op::product, a * b, {na, nb});
    const int less = add(*t, Op::comparison, is_less, {na, nb});
    const int chosen = add(*t, Op::choice, takes_product ? a * b : c, {product, nc, less});
    add(*t, Op::stored, takes_product ? a * b : c, {chosen});
  }
}
TEST(ShaderLine, OfAConditionTheOtherWayIsItsComparison) {
  // The port branches: what it chooses is a copy, which the reference has too.
  for (const bool is_choice : {false, true}) {
    const auto all = followed([&](Followed& f, float a, float b, float c) {
      add_decision(f, a, b, c, is_choice);
      const int na = add(f.port, 10, Op::load, a), nb = add(f.port, 11, Op::load, b), nc = add(f.port, 12, Op::load, c);
      add(f.port, 13, Op::comparison, b < c, {nb, nc});
      add(f.port, 15, Op::comparison, b <= a, {nb, na});
      const int taken = b <= a ? add(f.port, 16, Op::product, a * b, {na, nb}) : nc;
      f.port.outputs = {add(f.port, 18, Op::stored, b <= a ? a * b : c, {taken})};
      f.outputs = {0};
    });
    const auto lines = lines_of_mistake(all).lines;
    ASSERT_FALSE(lines.empty()) << is_choice;
    EXPECT_EQ(lines[0].at, 15u) << is_choice;
    EXPECT_EQ(lines[0].until, 15u) << is_choice;
  }
}
TEST(ShaderLine, OfARoundingIsKnownByWhatIsRounded) {
  // The half is left out: int(a) in place of floor(a + 1/2), whose values other operations have too.
  const auto all = followed([](Followed& f, float a, float b, float) {
    const float x = 1.6f + a / 20;
    for (Trace* t : {&f.right, &f.wrong}) {
      const bool is_wrong = t == &f.wrong;
      const int nx = add(*t, Op::load, x), one = add(*t, Op::load, 1), nb = add(*t, Op::load, b);
      const int sum = add(*t, Op::sum, is_wrong ? x : x + 0.5f, {nx});
      const int whole = add(*t, Op::floor, std::floor(is_wrong ? x : x + 0.5f), {sum});
      add(*t, Op::product, std::floor(is_wrong ? x : x + 0.5f) * b, {whole, nb, one});
    }
    const int nx = add(f.port, 10, Op::load, x), nb = add(f.port, 11, Op::load, b), one = add(f.port, 12, Op::load, 1);
    const int whole = add(f.port, 13, Op::stored, std::floor(x), {nx}), copy = add(f.port, 14, Op::stored, 1, {one});
    f.port.outputs = {add(f.port, 20, Op::product, std::floor(x) * b, {nb, whole, copy})};
    f.outputs = {0};
  });
  const auto lines = lines_of_mistake(all).lines;
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines[0].at, 13u);
}
TEST(ShaderLine, LiesBehindWhatRemainsWhereNothingElseIsNew) {
  // max(a - b, c) without its max, which decides nothing in these invocations but what is stored.
  const auto all = followed([](Followed& f, float a, float b, float) {
    for (Trace* t : {&f.right, &f.wrong}) {
      const int na = add(*t, Op::load, a), nb = add(*t, Op::load, b), nc = add(*t, Op::load, 9);
      const int difference = add(*t, Op::difference, a - b, {na, nb});
      const int held = add(*t, Op::maximum, t == &f.right ? 9 : a - b, {difference, nc});
      add(*t, Op::stored, t == &f.right ? 9 : a - b, {held});
    }
    const int na = add(f.port, 10, Op::load, a), nb = add(f.port, 11, Op::load, b);
    const int difference = add(f.port, 12, Op::difference, a - b, {na, nb});
    f.port.outputs = {add(f.port, 20, Op::stored, a - b, {difference})};
    f.outputs = {0};
  });
  const auto lines = lines_of_mistake(all).lines;
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines[0].at, 12u);
  EXPECT_EQ(lines[0].until, 20u);
}
TEST(ShaderLine, LiesBehindTheOperandThatLacksAStep) {
  // The reference adds c^2 to a b, the mistake and the port c, which the reference has too.
  const auto all = followed([](Followed& f, float a, float b, float c) {
    for (Trace* t : {&f.right, &f.wrong}) {
      const int na = add(*t, Op::load, a), nb = add(*t, Op::load, b), nc = add(*t, Op::load, c);
      const int squared = add(*t, Op::square, c * c, {nc}), product = add(*t, Op::product, a * b, {na, nb});
      add(*t, Op::sum, a * b + (t == &f.right ? c * c : c), {product, squared});
    }
    const int na = add(f.port, 10, Op::load, a), nb = add(f.port, 11, Op::load, b), nc = add(f.port, 12, Op::load, c);
    const int copy = add(f.port, 14, Op::stored, c, {nc}), product = add(f.port, 15, Op::product, a * b, {na, nb});
    add(f.port, 19, Op::sum, a * b + c, {product, copy});
  });
  const auto lines = lines_of_mistake(all).lines;
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines[0].at, 14u);
  EXPECT_EQ(lines[0].until, 19u);
}
TEST(ShaderLine, OfAHelperThatIsWrongInMostCallsIsInTheHelper) {
  // A helper reads a in place of b; its two calls add what it reads to others.
  const auto all = followed([](Followed& f, float a, float b, float c) {
    for (Trace* t : {&f.right, &f.wrong})
      for (const float x : {c, c * c}) {
        const int na = add(*t, Op::load, a * x), nx = add(*t, Op::load, x);
        const int read = add(*t, Op::load, t == &f.right ? b * x : a * x);
        add(*t, Op::sum, x + (t == &f.right ? b * x : a * x), {nx, read, na});
      }
    f.port.calls = {{30, -1}, {31, -1}};
    int call = 0;
    for (const float x : {c, c * c}) {
      const int nx = add(f.port, 10, Op::load, x);
      const int read = add(f.port, 5, Op::load, a * x, {nx}, call++);
      add(f.port, 30 + static_cast<std::uint32_t>(call), Op::sum, x + a * x, {nx, read});
    }
  });
  const auto lines = lines_of_mistake(all).lines;
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines[0].at, 5u);
}
TEST(ShaderLine, IsNotSaidOfAPortThatDoesSomethingElse) {
  const auto all = followed([](Followed& f, float a, float b, float c) {
    add_reference(f, a, b, c, a + b);
    const int na = add(f.port, 10, Op::load, a), nb = add(f.port, 11, Op::load, b), nc = add(f.port, 12, Op::load, c);
    const int other = add(f.port, 13, Op::quotient, a / b, {na, nb});
    add(f.port, 14, Op::sum, a / b + c, {other, nc});
  });
  EXPECT_TRUE(lines_of_mistake(all).lines.empty());
}
TEST(ShaderLine, IsNotSaidOfAPortThatIsRight) {
  const auto all = followed([](Followed& f, float a, float b, float c) {
    add_reference(f, a, b, c, a + b);
    const int na = add(f.port, 10, Op::load, a), nb = add(f.port, 11, Op::load, b), nc = add(f.port, 12, Op::load, c);
    const int right = add(f.port, 13, Op::product, a * b, {na, nb});
    add(f.port, 14, Op::sum, a * b + c, {right, nc});
  });
  EXPECT_TRUE(lines_of_mistake(all).lines.empty());
}
TEST(ShaderLine, NeedsValuesThatVary) {
  // All of it is the same in every invocation: it says nothing that the port has the mistake's values too.
  const auto all = followed([](Followed& f, float, float, float) {
    add_reference(f, 2, 3, 4, 5);
    const int five = add(f.port, 10, Op::load, 5);
    add(f.port, 14, Op::sum, 9, {five});
  });
  EXPECT_TRUE(lines_of_mistake(all).lines.empty());
}
TEST(ShaderLine, TakesInvocationsInWhichTheStepIsNotReached) {
  auto all = followed([](Followed& f, float a, float b, float c) {
    add_reference(f, a, b, c, a + b);
    const int na = add(f.port, 10, Op::load, a), nb = add(f.port, 11, Op::load, b), nc = add(f.port, 12, Op::load, c);
    const int wrong = add(f.port, 13, Op::sum, a + b, {na, nb});
    add(f.port, 14, Op::sum, a + b + c, {wrong, nc});
  });
  all[0].right.nodes.resize(3);
  all[0].wrong.nodes.resize(3);
  all[0].port.values.nodes.resize(3);
  all[0].port.steps.resize(3);
  const auto lines = lines_of_mistake(all).lines;
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines[0].at, 13u);
}

TEST(ShaderLine, OfAHelperThatOnlyReadsIsItsOneCall) {
  // A helper, called in one place, reads a in place of b: nothing else in it can be wrong.
  const auto all = followed([](Followed& f, float a, float b, float c) {
    for (Trace* t : {&f.right, &f.wrong}) {
      const int read = add(*t, Op::fetch, t == &f.right ? b : a), nc = add(*t, Op::load, c);
      add(*t, Op::sum, (t == &f.right ? b : a) + c, {read, nc});
    }
    f.port.calls = {{30, -1}};
    const int read = add(f.port, 5, Op::fetch, a, {}, 0), nc = add(f.port, 29, Op::load, c);
    add(f.port, 31, Op::sum, a + c, {read, nc});
  });
  const FoundLines found = lines_of_mistake(all);
  ASSERT_EQ(found.lines.size(), 2u);
  EXPECT_EQ(found.lines[0].at, 30u);
  EXPECT_EQ(found.lines[1].at, 5u);
  EXPECT_EQ(found.function_and_call, (std::vector<FoundLine>{{5, 5}, {30, 30}}));
}

/// A reference without a mistake: a b + c.
void add_right(Followed& f, float a, float b, float c) { add_reference(f, a, b, c, a * b); }
/// A port that makes `first` + c of a and b, with the first operation at `instruction`.
void add_port(Followed& f, std::uint32_t instruction, float a, float b, float c, float first) {
  const int na = add(f.port, 10, Op::load, a), nb = add(f.port, 11, Op::load, b), nc = add(f.port, 12, Op::load, c);
  const int made = add(f.port, instruction, Op::product, first, {na, nb});
  f.port.outputs = {add(f.port, 40, Op::sum, first + c, {made, nc})};
  f.outputs = {0};
}
TEST(ShaderDepartures, BeginWhereAllOperandsAreRight) {
  const auto failing = followed([](Followed& f, float a, float b, float c) {
    add_right(f, a, b, c);
    add_port(f, 13, a, b, c, a / b);
  });
  EXPECT_EQ(departures(failing, {}), (std::vector<FoundLine>{{13, 13}}));
}
TEST(ShaderDepartures, AreNoneInAPortThatIsRight) {
  const auto failing = followed([](Followed& f, float a, float b, float c) {
    add_right(f, a, b, c);
    add_port(f, 13, a, b, c, a * b);
  });
  EXPECT_EQ(departures(failing, {}), std::vector<FoundLine>());
}
TEST(ShaderDepartures, OfALoopBeginInItsFirstRound) {
  // x becomes x + a b, three times; the port adds a / b. From the second round on both operands are wrong.
  const auto failing = followed([](Followed& f, float a, float b, float c) {
    for (Trace* t : {&f.right, &f.wrong}) {
      const int na = add(*t, Op::load, a), nb = add(*t, Op::load, b);
      int x = add(*t, Op::load, c);
      const std::uint32_t product = 100, sum = 101;
      for (int round = 0; round < 3; ++round) {
        const int p = add(*t, Op::product, a * b + static_cast<float>(round) * c, {na, nb, x});
        t->nodes[static_cast<std::size_t>(p)].shape = product;
        x = add(*t, Op::sum, c + static_cast<float>(round + 1) * a * b, {x, p});
        t->nodes[static_cast<std::size_t>(x)].shape = sum;
      }
    }
    const int na = add(f.port, 10, Op::load, a), nb = add(f.port, 11, Op::load, b);
    int x = add(f.port, 12, Op::load, c);
    for (int round = 0; round < 3; ++round) {
      const int p = add(f.port, 20, Op::quotient, a / b + static_cast<float>(round) * b, {na, nb, x});
      x = add(f.port, 21, Op::sum, c + static_cast<float>(round + 1) * a / b, {x, p});
    }
    f.port.outputs = {x};
    f.outputs = {0};
  });
  EXPECT_EQ(departures(failing, {}), (std::vector<FoundLine>{{20, 20}}));
}
TEST(ShaderDepartures, OfAnotherFormComeLast) {
  // At 13 the port has another form than the reference, also where it passed; at 14 it is wrong.
  const auto with = [](bool is_wrong) {
    return followed([&](Followed& f, float a, float b, float c) {
      add_right(f, a, b, c);
      const int na = add(f.port, 10, Op::load, a), nb = add(f.port, 11, Op::load, b), nc = add(f.port, 12, Op::load, c);
      const int half = add(f.port, 13, Op::product, a / 2, {na});
      const float first = is_wrong ? b / 3 : b;
      const int other = add(f.port, 14, Op::product, first, {nb});
      const int product = add(f.port, 15, Op::product, 2 * (a / 2) * first, {half, other});
      f.port.outputs = {add(f.port, 40, Op::sum, 2 * (a / 2) * first + c, {product, nc})};
      f.outputs = {0};
    });
  };
  EXPECT_EQ(departures(with(true), with(false)), (std::vector<FoundLine>{{14, 14}, {13, 13}}));
}

}  // namespace
}  // namespace rainref::faults
