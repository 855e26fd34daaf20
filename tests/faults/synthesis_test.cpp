// What stands in place of something else is found from the numbers that a port stored: passes made up here, none of them an effect's.
#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "faults/generators.h"
#include "faults/solver.h"

namespace rainref::faults {
namespace {

using perturbed::Change;
using perturbed::Op;
using perturbed::Perturbed;
using perturbed::Put;
using perturbed::Substitution;

using Numbers = std::vector<float>;
/// A pass of one invocation: what it gives for what it loads.
using Pass = std::function<std::vector<Perturbed>(const Numbers&)>;

/// The first cause that is found for a port that gives port(inputs) where the pass is `right`; "none".
class MadeUp {
 public:
  MadeUp(Pass right, std::function<Numbers(const Numbers&)> port, Numbers literals, double leeway = 1e-6)
      : right_(std::move(right)), literals_(std::move(literals)) {
    std::sort(literals_.begin(), literals_.end());
    for (const Numbers& in : std::vector<Numbers>{{0.31f, 0.72f, 0.19f, 1.7f}, {0.83f, 0.27f, 0.55f, 2.3f}, {0.47f, 0.91f, 0.66f, 1.2f}}) {
      Probe& probe = probes_.emplace_back(Probe{{0, 0}, {}, {}});
      perturbed::Behaviour following;
      following.trace = &probe.trace;
      following.known = &literals_;
      {
        const perturbed::Scope scope(following);
        for (const Perturbed& v : right_(in)) probe.outputs.push_back(v.node());
      }
      for (const perturbed::Trace::Node& n : probe.trace.nodes) {
        const auto input = std::find(in.begin(), in.end(), n.value);
        probe.names.push_back(n.op == Op::load       ? fmt::format("in.{}", "xyzw"[input - in.begin()])
                              : n.op == Op::constant ? fmt::format("{}", n.value)
                                                     : "");
      }
      Solvable& s = texels_.emplace_back(Solvable{probe, port(in), {}, {}});
      s.leeway.assign(s.port.size(), leeway);
      s.evaluate = [this, in] {
        Numbers out;
        for (const Perturbed& v : right_(in)) out.push_back(v.v);
        return out;
      };
    }
  }
  std::vector<Fault> found() const {
    std::vector<Fault> out;
    const capture::PackPass pass{};
    const capture::PassCase c{};
    const capture::ListPass no_model("", nullptr);
    const parallel::Executor executor(3);
    add_solved_substitutions(out, {pass, c, nullptr, no_model}, texels_, literals_, {executor, [] { return false; }});
    return out;
  }
  std::string first() const {
    const std::vector<Fault> all = found();
    return all.empty() ? "none" : name_of(all[0]);
  }

 private:
  Pass right_;
  Numbers literals_;
  std::deque<Probe> probes_;
  std::vector<Solvable> texels_;
};
Perturbed load(float v) { return Perturbed::load(&v); }

// in * 3 + 5 in each of three components, which are alike: the sum takes w in place of 5.
TEST(Synthesis, AVectorIsSolvedForInAllComponents) {
  const Pass right = [](const Numbers& in) {
    const Perturbed w = load(in[3]);
    std::vector<Perturbed> out;
    for (int k = 0; k < 3; ++k) out.push_back((load(in[static_cast<std::size_t>(k)]) * Perturbed(3.0f) + Perturbed(5.0f)) * w);
    return out;
  };
  const auto port = [](const Numbers& in) {
    Numbers out;
    for (std::size_t k = 0; k < 3; ++k) out.push_back((in[k] * 3 + in[3]) * in[3]);
    return out;
  };
  EXPECT_EQ(MadeUp(right, port, {3, 5}).first(), "wrong value: in.w for 5, in all components");
}
// (y, x) where (x, y) is meant, behind a length that mixes both.
TEST(Synthesis, ExchangedComponentsAreFoundBehindALength) {
  const Pass right = [](const Numbers& in) {
    const Perturbed x = load(in[0]), y = load(in[1]), w = load(in[3]);
    const Perturbed a = x * Perturbed(3.0f), b = y * Perturbed(3.0f);
    const Perturbed length = sqrt(square(a) + square(b) + square(w));
    return std::vector<Perturbed>{a / length, b * Perturbed(2.0f) / length};
  };
  const auto port = [](const Numbers& in) {
    const float a = in[1] * 3, b = in[0] * 3, length = std::sqrt(a * a + b * b + in[3] * in[3]);
    return Numbers{a / length, b * 2 / length};
  };
  EXPECT_EQ(MadeUp(right, port, {2, 3}).first(), "wrong value: in.y * 3 for in.x * 3, in both components");
}
// Two texels are read at whole columns, of which the port reads one at the other's.
TEST(Synthesis, AColumnOfOneTexelIsThatOfAnother) {
  const auto texel = [](float column) { return std::sin(3 * column); };
  const auto read = [&](const Perturbed& column) { return Perturbed::of(texel(Perturbed::met(Op::coordinate, column, column).v)); };
  const Pass right = [&](const Numbers& in) {
    const Perturbed left = floor(load(in[0]) * Perturbed(10.0f)), high = floor(load(in[3]) * Perturbed(5.0f));
    const Perturbed a = read(left), b = read(high);
    return std::vector<Perturbed>{a * Perturbed(2.0f) + b * load(in[1]), b};
  };
  const auto port = [&](const Numbers& in) {
    const float high = std::floor(in[3] * 5);
    return Numbers{texel(high) * 2 + texel(high) * in[1], texel(high)};
  };
  bool is_found = false;
  for (const Fault& d : MadeUp(right, port, {2, 5, 10}).found())
    is_found |= sentence_of(d).starts_with("of one texel that is read the column");
  EXPECT_TRUE(is_found);
}
// y / 3 in the place of x, though the pass computes it only later.
TEST(Synthesis, AValueThatIsMetOnlyLater) {
  const Pass right = [](const Numbers& in) {
    const Perturbed first = load(in[0]) * load(in[3]), later = load(in[1]) / Perturbed(3.0f);
    return std::vector<Perturbed>{first, later};
  };
  const auto port = [](const Numbers& in) { return Numbers{in[1] / 3 * in[3], in[1] / 3}; };
  EXPECT_EQ(MadeUp(right, port, {3}).first(), "wrong value: in.y / 3 for in.x");
}
// Of a value that is used twice the result is wrong at both.
TEST(Synthesis, AResultThatIsUsedTwice) {
  const Pass right = [](const Numbers& in) {
    const Perturbed x = load(in[0]), y = load(in[1]), w = load(in[3]), r = x * Perturbed(3.0f);
    return std::vector<Perturbed>{r * r + w * r, y};
  };
  const auto port = [](const Numbers& in) { return Numbers{in[1] * in[1] + in[3] * in[1], in[1]}; };
  EXPECT_EQ(MadeUp(right, port, {3}).first(), "wrong value: in.y for in.x * 3");
}
// What a conforming device may give is no mistake, and what nothing near gives has no cause.
TEST(Synthesis, WhatIsRightHasNoCauseAndWhatIsStrangeHasNone) {
  const Pass right = [](const Numbers& in) {
    const Perturbed x = load(in[0]), y = load(in[1]);
    return std::vector<Perturbed>{x * Perturbed(3.0f) + y, y * x};
  };
  EXPECT_EQ(MadeUp(right, [](const Numbers& in) { return Numbers{std::fma(in[0], 3.0f, in[1]), in[1] * in[0]}; }, {3}).first(), "none");
  const auto strange = [](const Numbers& in) { return Numbers{std::sin(91 * in[0] + in[2] * in[3]), std::sin(57 * in[1] + 13 * in[2])}; };
  EXPECT_EQ(MadeUp(right, strange, {3}).first(), "none");
}

TEST(Solver, ANumberBehindAPowerIsFound) {
  const Pass right = [](const Numbers& in) {
    return std::vector<Perturbed>{pow(load(in[0]) * Perturbed(3.0f), Perturbed(2.5f)), load(in[1])};
  };
  const auto port = [](const Numbers& in) { return Numbers{std::pow(in[0] * 4, 2.5f), in[1]}; };
  const std::vector<Fault> all = MadeUp(right, port, {2.5f, 3}, 1e-4).found();
  EXPECT_TRUE(std::any_of(all.begin(), all.end(), [](const Fault& d) { return sentence_of(d).find("4") != std::string::npos; }));
}

TEST(Changes, OfANumber) {
  EXPECT_EQ(perturbed::changed(-1.5f, Change::floored), -2);
  EXPECT_EQ(perturbed::changed(1.5f, Change::rounded), 2);
  EXPECT_EQ(perturbed::changed(-1.5f, Change::truncated), -1);
  EXPECT_EQ(perturbed::changed(-1.25f, Change::fraction), 0.75f);
  EXPECT_EQ(perturbed::changed(1.5f, Change::saturated), 1);
  EXPECT_EQ(perturbed::changed(1 + 0x1p-20f, Change::as_half), 1);
  EXPECT_EQ(perturbed::changed(2, Change::cubed), 8);
  EXPECT_EQ(perturbed::changed(0.25f, Change::smoothed), 0.15625f);
  EXPECT_EQ(perturbed::put(3, 5, Put::instead), 5);
  EXPECT_EQ(perturbed::put(3, 5, Put::times), 15);
  EXPECT_EQ(perturbed::put(3, 5, Put::plus), 8);
}

}  // namespace
}  // namespace rainref::faults
