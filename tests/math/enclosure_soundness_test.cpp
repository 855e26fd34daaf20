// Soundness: whatever a conforming GPU gives lies inside. The GPU is drawn by lot, operation by operation
// (random_gpu.h), for point operands and for operands anywhere in intervals; then for whole expressions.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "math/enclosure.h"
#include "math/profiles.h"
#include "math/random_gpu.h"

namespace rainref::test {
namespace {

using namespace rainref::scalar;  // the vocabulary, as a pass sees it
using enclosed::Enclosure;
using enclosed::PathEnumeration;
using enclosed::Profile;
using enclosed::ProfileScope;

using random_gpu::RandomGpu;
using random_gpu::toss;
using random_gpu::uniform;

float draw(double low_exponent, double high_exponent) {
  return static_cast<float>(std::ldexp(uniform(1, 2) * (toss() ? 1 : -1), static_cast<int>(uniform(low_exponent, high_exponent))));
}
// Ordinary numbers, small ones, exact ones and special ones.
float any_operand() {
  switch (random_gpu::words()() % 8) {
    case 0:
      return static_cast<float>(static_cast<int>(uniform(-20, 20))) * 0.25f;
    case 1:
      return draw(-149, -120);
    case 2:
      return draw(-30, 30);
    case 3:
      return 1.0f + draw(-24, -20);
    default:
      return draw(-6, 4);
  }
}
Enclosure any_interval() {
  const float x = any_operand();
  if (toss()) return Enclosure(x);
  const float width = std::abs(draw(-30, toss() ? -10 : 2)) * std::max(1.0f, std::abs(x));
  return Enclosure::checked(x, x + width);
}
// A number of the interval; often an end.
RandomGpu inside(Enclosure e) {
  if (e.is_point() || toss()) return RandomGpu::exactly(toss() ? e.lo : e.hi);
  return RandomGpu::exactly(std::clamp(static_cast<float>(uniform(e.lo, e.hi)), e.lo, e.hi));
}

struct Operation {
  const char* name;
  std::function<Enclosure(Enclosure, Enclosure, Enclosure)> enclosed;
  std::function<RandomGpu(RandomGpu, RandomGpu, RandomGpu)> gpu;
};
template <class F>
Operation operation(const char* name, F f) {
  return {name, [f](Enclosure a, Enclosure b, Enclosure c) { return f(a, b, c); },
          [f](RandomGpu a, RandomGpu b, RandomGpu c) { return f(a, b, c); }};
}
template <class N>
N held(N x, float low, float high) {
  return clamp(x, N(low), N(high));
}

#define OPERATION(name, expression) \
  operation(name, []<class N>([[maybe_unused]] N a, [[maybe_unused]] N b, [[maybe_unused]] N c) -> N { return expression; })
const std::vector<Operation>& operations() {
  static const std::vector<Operation> all{
      OPERATION("a + b", a + b),
      OPERATION("a - b", a - b),
      OPERATION("a b", a * b),
      OPERATION("a b + c", a * b + c),
      OPERATION("c - a b", c - a * b),
      OPERATION("a a - b", square(a) - b),
      OPERATION("a / b", a / b),
      OPERATION("min, max, abs", min(max(a, b), abs(c))),
      OPERATION("sqrt", sqrt(abs(a))),
      OPERATION("sum of 3", sum_any_order(a, b, c)),
      OPERATION("sum of 4", sum_any_order(a, b, c, a * b)),
      OPERATION("sum in pairs", sum_any_order_in_pairs(a, b, c, a * c)),
      OPERATION("mix", mix(a, b, held(c, 0, 1))),
      OPERATION("mix outside", mix(a, b, held(c, -3, 4))),
      OPERATION("floor", floor(held(a, -100, 100))),
      OPERATION("fract", fract(held(a, -100, 100))),
      OPERATION("smoothstep", smoothstep(0.0f, 0.15f, a)),
      OPERATION("falling smoothstep", smoothstep(4.0f, 0.5f, a)),
      OPERATION("exp", exp(held(a, -80, 80))),
      OPERATION("exp2", exp2(held(a, -100, 100))),
      OPERATION("log", log(max(abs(a), N(1e-30f)))),
      OPERATION("pow", pow(held(abs(a), 0, 50), N(2.2f))),
      OPERATION("small pow", pow(held(abs(a), 0, 50), N(0.4545f))),
      OPERATION("sin", sin(held(a, -3, 3))),
      OPERATION("cos", cos(held(a, -3, 3))),
      OPERATION("atan2", atan2(held(a, -4, 4), held(b, -4, 4))),
      OPERATION("normalize", normalize(scalar::Vec3<N>(held(a, -4, 4), held(b, -4, 4), N(1.0f))).x),
      OPERATION("length", length(scalar::Vec3<N>(held(a, -4, 4), held(b, -4, 4), held(c, -4, 4)))),
      OPERATION("dot", dot(scalar::Vec3<N>(a, b, c), scalar::Vec3<N>(b, c, a))),
      OPERATION("reflect",
                reflect(scalar::Vec3<N>(held(a, -1, 1), held(b, -1, 1), N(0.5f)), scalar::Vec3<N>(N(0.6f), held(c, 0, 1), N(0.0f))).y),
      OPERATION("refract",
                refract(scalar::Vec3<N>(N(0.6f), N(-0.8f), N(0.0f)), scalar::Vec3<N>(held(a, -0.5f, 0.5f), N(1.0f), N(0.0f)), 0.75f).x),
      OPERATION("octave", nearest_octave(abs(a))),
      OPERATION("a threshold", select(a < b, a, c)),
  };
  return all;
}
#undef OPERATION

TEST(EnclosureSoundness, HoldsEveryLegalResultOfEveryOperation) {
  for (const Profile& p : profiles()) {
    if (p.reference) continue;
    const ProfileScope scope(p);
    for (const Operation& f : operations()) {
      int bounded = 0;
      const int trials = 3000;
      for (int i = 0; i < trials; ++i) {
        const Enclosure a = any_interval(), b = any_interval(), c = any_interval();
        std::vector<Enclosure> alternatives;
        PathEnumeration paths;
        const bool whole = paths.for_each_alternative([&] { alternatives.push_back(f.enclosed(a, b, c)); });
        if (!whole) continue;
        bounded += !alternatives[0].is_vacuous();
        for (int k = 0; k < 6; ++k) {
          const RandomGpu x = inside(a), y = inside(b), z = inside(c);
          const float got = f.gpu(x, y, z).v;
          bool held_somewhere = false;
          for (const Enclosure& e : alternatives) held_somewhere |= e.is_vacuous() || e.contains(got);
          ASSERT_TRUE(held_somewhere) << p.name << ", " << f.name << " of " << x.v << ' ' << y.v << ' ' << z.v << ": " << got
                                      << " outside [" << alternatives[0].lo << ", " << alternatives[0].hi << "], operands [" << a.lo << ", "
                                      << a.hi << "] [" << b.lo << ", " << b.hi << "] [" << c.lo << ", " << c.hi << "]";
        }
      }
      EXPECT_GT(bounded, trials / 3) << p.name << ", " << f.name << ": nothing is tested where all is vacuous";
    }
  }
}

// The lot itself: under a loose profile it must differ from the reference often, or the test above shows little.
TEST(EnclosureSoundness, TheRandomGpuUsesItsFreedom) {
  const ProfileScope scope(profile_named("vulkan"));
  int sums = 0, fused = 0, quotients = 0;
  for (int i = 0; i < 1000; ++i) {
    const float a = draw(-3, 3), b = draw(-3, 3), c = draw(-3, 3);
    sums += (RandomGpu::exactly(a) + RandomGpu::exactly(b)).v != a + b;
    fused += (RandomGpu::exactly(a) * RandomGpu::exactly(b) + RandomGpu::exactly(c)).v != a * b + c;
    quotients += (RandomGpu::exactly(a) / RandomGpu::exactly(b)).v != a / b;
  }
  EXPECT_GT(sums, 100);
  EXPECT_GT(fused, 200);
  EXPECT_GT(quotients, 500);
}

}  // namespace
}  // namespace rainref::test
