// Parts of an operation put together otherwise: passes made up here, none of them an effect's.
#include "faults/generators.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "faults/place_faults.h"
#include "random/draws.h"

namespace rainref::faults {
namespace {

using perturbed::Op;
using perturbed::Perturbed;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

using Numbers = std::vector<float>;
using Pass = std::function<std::vector<Perturbed>(const Numbers&)>;

Perturbed load(float v) { return Perturbed::load(&v); }

/// What a pass gives with a mistake.
Numbers given(const Pass& pass, const Numbers& in, const Fault& d) {
  perturbed::Behaviour b = d.behaviour;
  std::vector<float> unused;
  if (d.at_texel) d.at_texel({0, 0}, b, unused);
  perturbed::Trace trace;
  b.trace = &trace;
  const perturbed::RewriteScope rewriting(d.rewrites.value_or(perturbed::Rewrites()));
  const perturbed::Scope scope(b);
  Numbers out;
  for (const Perturbed& v : pass(in)) out.push_back(v.v);
  return out;
}
/// Names of what is tried of `right` that gives what `port` gives, at three inputs; "none" where nothing does.
std::vector<std::string> found(const Pass& right, const std::function<Numbers(const Numbers&)>& port, Numbers literals) {
  std::sort(literals.begin(), literals.end());
  const std::vector<Numbers> inputs{{0.31f, 0.72f, 0.19f, 1.7f}, {0.83f, 0.27f, 0.55f, 2.3f}, {0.47f, 0.91f, 0.66f, 1.2f}};
  Probe probe{{0, 0}, {}, {}};
  perturbed::Behaviour following;
  following.trace = &probe.trace;
  following.known = &literals;
  {
    const perturbed::Scope scope(following);
    for (const Perturbed& v : right(inputs[0])) probe.outputs.push_back(v.node());
  }
  for (const perturbed::Trace::Node& n : probe.trace.nodes) {
    const auto input = std::find(inputs[0].begin(), inputs[0].end(), n.value);
    probe.names.push_back(n.op == Op::load       ? fmt::format("in.{}", "xyzw"[input - inputs[0].begin()])
                          : n.op == Op::constant ? fmt::format("{}", n.value)
                                                 : "");
  }
  std::vector<Fault> all;
  add_edit_faults(all, {probe}, literals, 100000, {probe});
  std::vector<std::string> names;
  for (const Fault& d : all)
    if (std::all_of(inputs.begin(), inputs.end(), [&](const Numbers& in) {
          const Numbers made = given(right, in, d), wanted = port(in);
          for (std::size_t k = 0; k < wanted.size(); ++k)
            if (!(std::abs(made[k] - wanted[k]) <= 1e-6f * (1 + std::abs(wanted[k])))) return false;
          return true;
        }))
      names.push_back(name_of(d));
  return names.empty() ? std::vector<std::string>{"none"} : names;
}
/// The same of faults at places that look alike.
std::vector<std::string> shared(const Pass& right, const std::function<Numbers(const Numbers&)>& port) {
  const std::vector<Numbers> inputs{{0.31f, 0.72f, 0.19f, 1.7f}, {0.83f, 0.27f, 0.55f, 2.3f}, {0.47f, 0.91f, 0.66f, 1.2f}};
  Probe probe{{0, 0}, {}, {}};
  perturbed::Behaviour following;
  following.trace = &probe.trace;
  {
    const perturbed::Scope scope(following);
    for (const Perturbed& v : right(inputs[0])) probe.outputs.push_back(v.node());
  }
  probe.names.resize(probe.trace.nodes.size(), "in");
  std::vector<Fault> all;
  add_shared_place_faults(all, {probe}, {});
  std::vector<std::string> names;
  for (const Fault& d : all)
    if (std::all_of(inputs.begin(), inputs.end(), [&](const Numbers& in) {
          return std::abs(given(right, in, d)[0] - port(in)[0]) <= 1e-6f * (1 + std::abs(port(in)[0]));
        }))
      names.push_back(name_of(d));
  return names;
}
std::string first(const Pass& right, const std::function<Numbers(const Numbers&)>& port, Numbers literals = {}) {
  return found(right, port, std::move(literals))[0];
}

// (x + z) y, of which the port has (y + z) x.
TEST(EditFaults, TwoPartsAreExchanged) {
  const Pass right = [](const Numbers& in) { return std::vector<Perturbed>{fract((load(in[0]) + load(in[2])) * load(in[1]))}; };
  const auto port = [](const Numbers& in) {
    const float v = (in[1] + in[2]) * in[0];
    return Numbers{v - std::floor(v)};
  };
  EXPECT_EQ(first(right, port), "exchanged: in.x and in.y");
}
// 2 (x y + z w) - 1, of which the port unpacks y and w each.
TEST(EditFaults, AMapOfASumIsTakenOfItsParts) {
  const Pass right = [](const Numbers& in) {
    return std::vector<Perturbed>{Perturbed(2.0f) * (load(in[0]) * load(in[1]) + load(in[2]) * load(in[3])) - Perturbed(1.0f)};
  };
  const auto port = [](const Numbers& in) { return Numbers{in[0] * (2 * in[1] - 1) + in[2] * (2 * in[3] - 1)}; };
  EXPECT_THAT(first(right, port, {1, 2}), StartsWith("of each part"));
}
TEST(EditFaults, AnotherCurveOfOneNumber) {
  const Pass right = [](const Numbers& in) {
    const Perturbed t = load(in[0]);
    return std::vector<Perturbed>{t * t * t * (t * (t * Perturbed(6.0f) - Perturbed(15.0f)) + Perturbed(10.0f)) + load(in[3])};
  };
  const auto port = [](const Numbers& in) { return Numbers{in[0] * in[0] * (3 - 2 * in[0]) + in[3]}; };
  EXPECT_THAT(first(right, port, {6, 10, 15}), HasSubstr("another curve: the cubic smoothstep"));
}
// The components of a matrix' product are the vector itself, or those of the transposed one.
TEST(EditFaults, AMatrixIsLeftOutOrTransposed) {
  const Pass right = [](const Numbers& in) {
    const Perturbed x = load(in[0]), y = load(in[1]);
    const Perturbed u = Perturbed(2.0f) * x, v = Perturbed(5.0f) * x + Perturbed(3.0f) * y;
    return std::vector<Perturbed>{sqrt(square(u) + square(v))};
  };
  const auto length = [](float a, float b) { return Numbers{std::sqrt(a * a + b * b)}; };
  EXPECT_THAT(first(right, [&](const Numbers& in) { return length(in[0], in[1]); }, {2, 3, 5}), StartsWith("matrix left out"));
  EXPECT_THAT(first(right, [&](const Numbers& in) { return length(2 * in[0] + 5 * in[1], 3 * in[1]); }, {2, 3, 5}),
              StartsWith("matrix transposed"));
}
// (x, 1, y) normalized, of which the port has (x, y, 1).
TEST(EditFaults, ComponentsAreExchanged) {
  const Pass right = [](const Numbers& in) {
    const Perturbed x = load(in[0]) * Perturbed(3.0f), y = load(in[1]) * Perturbed(3.0f), one(1.0f);
    const Perturbed inverse = one / sqrt(square(x) + square(one) + square(y));
    return std::vector<Perturbed>{inverse * x, inverse * one, inverse * y};
  };
  const auto port = [](const Numbers& in) {
    const float x = in[0] * 3, y = in[1] * 3, inverse = 1 / std::sqrt(x * x + y * y + 1);
    return Numbers{inverse * x, inverse * y, inverse};
  };
  EXPECT_THAT(found(right, port, {1, 3}), testing::Contains(StartsWith("components exchanged: y and z")));
}
// 1/2, 1/4, 1/4, of which the port makes a box.
TEST(EditFaults, WeightsOfAFilter) {
  const Pass right = [](const Numbers& in) {
    return std::vector<Perturbed>{Perturbed(0.5f) * load(in[1]) + Perturbed(0.25f) * (load(in[0]) + load(in[2]))};
  };
  EXPECT_THAT(first(right, [](const Numbers& in) { return Numbers{(in[0] + in[1] + in[2]) / 3}; }, {0.25f, 0.5f}),
              StartsWith("equal weights: 0.3333"));
  EXPECT_THAT(first(right, [](const Numbers& in) { return Numbers{0.25f * in[1] + 0.5f * (in[0] + in[2])}; }, {0.25f, 0.5f}),
              StartsWith("weights exchanged"));
}
// The value of after a step, which the pass has only later.
TEST(EditFaults, AValueOfAfter) {
  const Pass right = [](const Numbers& in) {
    const Perturbed life = load(in[0]), dt = load(in[2]);
    const Perturbed phase = fract(life * Perturbed(64.0f));
    return std::vector<Perturbed>{phase, life - dt};
  };
  const auto port = [](const Numbers& in) {
    const float v = (in[0] - in[2]) * 64;
    return Numbers{v - std::floor(v), in[0] - in[2]};
  };
  EXPECT_THAT(first(right, port, {64}), StartsWith("value of after: in.x - in.z for in.x"));
}
// A function of the text that is called with a sum and with a root: both calls have lost the floor.
TEST(EditFaults, AFunctionThatIsCalledTwiceIsWrongInBothCalls) {
  const auto rounded = [](const Perturbed& x) { return floor(x * Perturbed(3.0f) + Perturbed(0.5f)); };
  const Pass right = [&](const Numbers& in) {
    return std::vector<Perturbed>{rounded(load(in[0]) + load(in[3])) * rounded(sqrt(load(in[1]) * load(in[3])))};
  };
  const auto port = [](const Numbers& in) { return Numbers{((in[0] + in[3]) * 3 + 0.5f) * (std::sqrt(in[1] * in[3]) * 3 + 0.5f)}; };
  EXPECT_THAT(shared(right, port), testing::Contains(AllOf(StartsWith("floor left out: "), testing::EndsWith(", in each such place"))));
}
// A value of three components that is tone mapped, or decoded by another curve.
TEST(EditFaults, ACurveThatIsTooMuchOrAnotherOne) {
  const auto components = [](const auto& of) {
    return [of](const Numbers& in) { return std::vector<Perturbed>{of(load(in[0])), of(load(in[1])), of(load(in[2]))}; };
  };
  const Pass light = components([](const Perturbed& x) { return Perturbed(3.0f) * x; });
  EXPECT_THAT(found(light,
                    [](const Numbers& in) {
                      return Numbers{3 * in[0] / (1 + 3 * in[0]), 3 * in[1] / (1 + 3 * in[1]), 3 * in[2] / (1 + 3 * in[2])};
                    },
                    {3}),
              testing::Contains(StartsWith("tone mapped by x / (1 + x)")));
  const Pass decoded = components([](const Perturbed& x) { return pow(x, Perturbed(2.2f)); });
  const auto srgb = [](float x) { return x < 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f); };
  EXPECT_THAT(found(decoded,
                    [&](const Numbers& in) {
                      return Numbers{srgb(in[0]), srgb(in[1]), srgb(in[2])};
                    },
                    {2.2f}),
              testing::Contains(StartsWith("another curve: the sRGB curve, from code to light")));
}
// 3 (x - 1) held to [0, 1] where it is not.
TEST(EditFaults, AClampTooMany) {
  const Pass right = [](const Numbers& in) {
    return std::vector<Perturbed>{(load(in[3]) - Perturbed(1.0f)) * Perturbed(3.0f) + load(in[0])};
  };
  const auto held = [](float x) { return std::min(std::max(x, 0.0f), 1.0f); };
  EXPECT_THAT(first(right, [&](const Numbers& in) { return Numbers{held((in[3] - 1) * 3) + in[0]}; }, {1, 3}), StartsWith("held: "));
}
// max(x, y z), of which the port has a blend from x to y by z.
TEST(EditFaults, ABlendInPlaceOfTheLarger) {
  const Pass right = [](const Numbers& in) { return std::vector<Perturbed>{max(load(in[0]), load(in[1]) * load(in[2])) * load(in[3])}; };
  EXPECT_EQ(first(right, [](const Numbers& in) { return Numbers{(in[0] * (1 - in[2]) + in[1] * in[2]) * in[3]}; }),
            "blended for the larger or smaller: mix(in.x, in.y, in.z)");
}
// Fog over light over a picture, which the port blends in the other order.
TEST(EditFaults, BlendsInTheOtherOrder) {
  const auto blend = [](float a, float b, float t) { return a * (1 - t) + b * t; };
  const Pass right = [](const Numbers& in) {
    return std::vector<Perturbed>{mix(mix(load(in[0]), Perturbed(3.0f), load(in[1])), Perturbed(5.0f), load(in[2]))};
  };
  EXPECT_THAT(found(right, [&](const Numbers& in) { return Numbers{blend(blend(in[0], 5, in[2]), 3, in[1])}; }, {3, 5}),
              testing::Contains(StartsWith("order of ")));
}
// A vector in other axes where its own is meant, in one of the two places that take it.
TEST(EditFaults, AMatrixIsLeftOutInOnePlace) {
  const Pass right = [](const Numbers& in) {
    const Perturbed x = load(in[0]), y = load(in[1]), w = load(in[3]);
    const Perturbed u = Perturbed(2.0f) * x + Perturbed(5.0f) * y, v = Perturbed(3.0f) * y;
    return std::vector<Perturbed>{w * u, w * v, square(u) + square(v)};
  };
  EXPECT_THAT(found(right,
                    [](const Numbers& in) {
                      const float u = 2 * in[0] + 5 * in[1], v = 3 * in[1];
                      return Numbers{in[3] * in[0], in[3] * in[1], u * u + v * v};
                    },
                    {2, 3, 5}),
              testing::Contains(AllOf(StartsWith("matrix left out: "), HasSubstr(" in ("))));
}
// f(x + 1, 3 y + 1), of which the port has f(x, 3 y): a literal that stands alike in two components that are not made alike.
TEST(PlaceFaults, ALiteralIsLeftOutInBothComponents) {
  const Pass right = [](const Numbers& in) {
    return std::vector<Perturbed>{(load(in[0]) + Perturbed(1.0f)) * (Perturbed(3.0f) * load(in[1]) + Perturbed(1.0f))};
  };
  const Numbers literals{1, 3}, in{0.31f, 0.72f, 0.19f, 1.7f};
  Probe probe{{0, 0}, {}, {}};
  perturbed::Behaviour following;
  following.trace = &probe.trace;
  following.known = &literals;
  {
    const perturbed::Scope scope(following);
    right(in);
  }
  for (const perturbed::Trace::Node& n : probe.trace.nodes) probe.names.push_back(n.op == Op::constant ? fmt::format("{}", n.value) : "in");
  std::vector<Fault> all;
  add_place_faults(all, {probe}, literals, PlaceKind::plain);
  std::vector<std::string> names;
  for (Fault& d : all) {
    d.behaviour.known = &literals;
    if (std::abs(given(right, in, d)[0] - in[0] * 3 * in[1]) <= 1e-6f) names.push_back(name_of(d));
  }
  EXPECT_THAT(names, testing::Contains("term left out: 1, in both components"));
}
// G f with f projected on two vectors, in three calls, of which the port projects on unit vectors: each call has its own projections.
TEST(EditFaults, AMatrixIsLeftOutForUnitVectorsInEachCall) {
  const auto projected = [](const Perturbed& x, const Perturbed& y, std::vector<Perturbed>& out) {
    const Perturbed u = x * Perturbed(3.0f) + y * Perturbed(4.0f), v = x * Perturbed(-5.0f) + y * Perturbed(12.0f);
    out.push_back(Perturbed(0.7f) * u + Perturbed(0.2f) * v);
    out.push_back(Perturbed(0.2f) * u + Perturbed(0.9f) * v);
  };
  const Pass right = [&](const Numbers& in) {
    std::vector<Perturbed> out;
    projected(load(in[0]), load(in[1]), out);
    projected(load(in[1]), load(in[2]), out);
    projected(load(in[2]), load(in[0]), out);
    return out;
  };
  const auto port = [](float of_u, float of_v) {
    return [of_u, of_v](const Numbers& in) {
      Numbers out;
      for (const auto& [a, b] : {std::pair(0, 1), std::pair(1, 2), std::pair(2, 0)}) {
        const float x = in[static_cast<std::size_t>(a)], y = in[static_cast<std::size_t>(b)];
        out.push_back((3 * x + 4 * y) / of_u);
        out.push_back((12 * y - 5 * x) / of_v);
      }
      return out;
    };
  };
  const Numbers literals{3, 4, -5, 12, 0.7f, 0.2f, 0.9f};
  EXPECT_THAT(found(right, port(1, 1), literals), testing::Contains(StartsWith("matrix left out: ")));
  EXPECT_THAT(found(right, port(5, 13), literals), testing::Contains(StartsWith("matrix for unit vectors: ")));
}
TEST(EditFaults, WhatIsStrangeHasNone) {
  const Pass right = [](const Numbers& in) { return std::vector<Perturbed>{load(in[0]) * Perturbed(3.0f) + load(in[1])}; };
  EXPECT_EQ(first(right, [](const Numbers& in) { return Numbers{std::sin(91 * in[0] + in[2])}; }, {3}), "none");
}

// 4 a + b drawn as a + 4 b, and a place of fewer bits.
TEST(Draws, ACounterWhoseFactorStandsAtTheOtherTermAndPlacesOfFewerBits) {
  random::Draws d;
  d.moved = {1, 4};
  EXPECT_EQ(d.block(9, random::Purpose::screen_drop, 7, 4 * 5 + 3), random::block(9, random::Purpose::screen_drop, 7, 5 + 4 * 3));
  // The hash itself: as it is, and with the key added.
  random::Draws mixed;
  mixed.mixing.emplace();
  EXPECT_EQ(mixed.block(9, random::Purpose::screen_drop, 7, 11), random::block(9, random::Purpose::screen_drop, 7, 11));
  mixed.mixing->keyed_by = random::Join::sum;
  const random::Block key = random::pcg4d({9, 0, static_cast<std::uint32_t>(random::Purpose::screen_drop), 0});
  EXPECT_EQ(mixed.block(9, random::Purpose::screen_drop, 7, 11), random::pcg4d({7 + key[0], 11 + key[1], key[2], key[3]}));
  mixed.mixing.emplace().is_stirred_at_once = true;
  const auto at_once = [](random::Block v) {
    for (std::uint32_t& x : v) x = x * 1664525u + 1013904223u;
    const auto stir = [&] { v = {v[0] + v[1] * v[3], v[1] + v[2] * v[0], v[2] + v[0] * v[1], v[3] + v[1] * v[2]}; };
    stir();
    for (std::uint32_t& x : v) x ^= x >> 16;
    stir();
    return v;
  };
  const random::Block made = at_once({9, 0, static_cast<std::uint32_t>(random::Purpose::screen_drop), 0});
  EXPECT_EQ(mixed.block(9, random::Purpose::screen_drop, 7, 11), at_once({7 ^ made[0], 11 ^ made[1], made[2], made[3]}));
  random::Draws low;
  low.turned[2] = 10;
  EXPECT_EQ(low.block(9, random::Purpose::screen_drop, 7, 11)[2] >> 22, random::block(9, random::Purpose::screen_drop, 7, 11)[2] & 1023);
  random::Draws few;
  few.place_bits = 16;
  EXPECT_EQ(few.place(0x12345678u, 24), 0x123400u);
  EXPECT_EQ(random::Draws().place(0x12345678u, 24), 0x123456u);
}

}  // namespace
}  // namespace rainref::faults
