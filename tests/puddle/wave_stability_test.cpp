// The stability limit of the corrected step: refused above, bounded at it, fading below it.
#include "puddle/support.h"

namespace rainref::puddle {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(WaveStability, ACourantNumberAboveTheLimitIsRefusedAndTheLimitNamed) {
  const std::string message = error_of([] { puddle_of(corrected(16, 12, 0.98, 0.71)); });
  EXPECT_THAT(message, StartsWith("2 puddle.wave_speed / (puddle.step_rate * puddle.cell_size) = 0.71: "));
  EXPECT_THAT(message, HasSubstr("unstable above the Courant number sqrt(1/2) = 0.707107; raise puddle.step_rate to "));
  EXPECT_THAT(error_of([] { puddle_of(corrected(16, 12, 1, std::nextafter(courant_limit, 1))); }), StartsWith("2 puddle.wave_speed"));
  EXPECT_EQ(error_of([] { puddle_of(corrected(16, 12, 1, courant_limit)); }), "none");
}

// Whoever follows the advice is not refused again.
TEST(WaveStability, TheStepRateThatTheMessageNamesIsAccepted) {
  for (int i = 1; i <= 200; ++i) {
    Settings s = corrected(16, 12, 0.98, 0.71);
    s.wave_speed = 0.37 * i;
    s.cell_size = 0.0004 * (1 + i % 7);
    const std::string message = error_of([&] { check(s); });
    const std::string before = "raise puddle.step_rate to ";
    ASSERT_THAT(message, HasSubstr(before));
    s.step_rate = std::stod(message.substr(message.find(before) + before.size()));
    ASSERT_EQ(error_of([&] { check(s); }), "none") << i << " after: " << message;
  }
}

// The shortest wave has b = (1 + gamma) - 8 K; its roots leave the unit circle at -1 when K > (1 + gamma) / 4. The rounding of
// the uniforms must not carry K past that, or water at the limit grows without end.
TEST(WaveStability, RoundedUniformsStayWithinTheLimit) {
  for (int i = 0; i <= 5000; ++i) {
    const WaveStepUniforms u = wave_step_uniforms(corrected(16, 12, 0.5 + i * 1e-4, courant_limit));
    ASSERT_LE(4.0 * u.courant_sq, 1.0 + u.damping) << "damping " << 0.5 + i * 1e-4;
  }
}

// At the limit the checkerboard has the roots -1 and -gamma: a start no higher than 1 stays below 2 / (1 - gamma).
TEST(WaveStability, AtTheLimitWaterStaysBounded) {
  for (const Boundary boundary : boundaries) {
    const Settings s = corrected(16, 12, 0.98, courant_limit, boundary);
    const Field checkerboard = make_field(16, 12, [](int x, int y) { return (x + y) % 2 ? -1 : 1; });
    Field opposite = checkerboard;
    for (double& u : opposite) u = -u;
    Puddle puddle = puddle_of(s);
    for (const auto& [newest, previous] :
         {std::pair{noise(192, 9), noise(192, 10)}, {checkerboard, opposite}, {checkerboard, checkerboard}}) {
      put(puddle, newest, previous);
      double top = 0;
      for (int n = 0; n < 3000; ++n) {
        puddle.simulate();
        if (n % 50 < 2) top = std::max(top, largest(heights(puddle.newest(), s)));
      }
      // The root -1 does not fade, so roundings stay too: their coherent sum, relative to the height reached.
      record(text(s) + " highest", top);
      EXPECT_LE(top, 2 / (1 - 0.98) * (1 + step_rounding * ulp_float * growth(s, 3000))) << text(s);
      // It is the checkerboard that lasts: with its two levels opposite it flips for ever.
      if (boundary == Boundary::periodic && newest == checkerboard && previous == opposite) {
        EXPECT_NEAR(largest(heights(puddle.newest(), s)), 1, 3000 * 50 * 8 * ulp_float)
            << "K and gamma are floats: the root is -1 to 4e-7/(1-gamma)";
      }
    }
  }
}

// Below the limit every wave but the mean fades, here by sqrt(gamma) a step, for no mode of this water creeps.
TEST(WaveStability, JustBelowTheLimitEveryWaveFades) {
  const double gamma = 0.98;
  for (const Boundary boundary : boundaries) {
    const Settings s = corrected(16, 12, gamma, 0.99 * courant_limit, boundary);
    const WaveStepUniforms u = wave_step_uniforms(s);
    double sine = 1;
    for (int q = 0; q < 12; ++q) {
      for (int p = 0; p < 16; ++p) {
        if (boundary != Boundary::fixed && p + q == 0) continue;
        const double cosine = root_sum(s, u, mode(boundary, 16, 12, p, q).sum()) / (2 * std::sqrt(gamma));
        ASSERT_LT(std::abs(cosine), 1) << p << ", " << q;
        sine = std::min(sine, std::sqrt(1 - cosine * cosine));
      }
    }
    Field newest = noise(192, 11), previous = noise(192, 12);
    for (Field* field : {&newest, &previous}) {
      const double level = boundary == Boundary::fixed ? 0 : mean(*field);
      for (double& height : *field) height -= level;
    }
    OracleWave wave = oracle_of(s, newest, previous);
    for (int n = 1; n <= 1000; ++n) {
      wave.step();
      // |a_n| <= gamma^(n/2) (|a_0| + sqrt(gamma) |a_-1|) / sin w, mode by mode.
      ASSERT_LE(rms(heights(wave.newest, s)), std::pow(gamma, n * 0.5) * (rms(newest) + rms(previous)) / sine + 1e-13) << n;
    }
    Puddle puddle = puddle_of(s);
    put(puddle, newest, previous);
    for (int n = 0; n < 2500; ++n) puddle.simulate();
    // 0.98^1250 = 1e-11: what is left is the mean that the floats' roundings gave, those of the first 1 / (1 - gamma) = 50 steps,
    // answered by 50, averaged over 192 cells; 4 sigma.
    EXPECT_LE(rms(heights(puddle.newest(), s)), 4 * step_rounding / 3 * ulp_float * 50 * std::sqrt(50.0 / 192)) << text(s);
  }
}

// The limit is sharp. C^2 = 0.5001 without damping: the checkerboard's root is 1.0287, 4e4 in 400 steps.
TEST(WaveStability, JustAboveTheLimitTheCheckerboardGrows) {
  const Settings s = corrected(16, 12, 1, courant_limit, Boundary::periodic);
  WaveStepUniforms u = wave_step_uniforms(s);
  u.courant_sq = 0.5001f;
  OracleWave wave(s, u);
  const Field start = make_field(16, 12, [](int x, int y) { return (x + y) % 2 ? -1 : 1; });
  put(wave, s, start, Field(start.size()));
  const double b = 2 - 8 * static_cast<double>(u.courant_sq), growing = std::abs(roots(b, 1).first);
  EXPECT_NEAR(growing, 1.0287, 5e-5);
  for (int n = 0; n < 400; ++n) wave.step();
  // a_n = (z1^(n+1) - z2^(n+1)) / (z1 - z2) from a_0 = 1, a_-1 = 0; signs alternate.
  const double expected = (std::pow(growing, 401) - std::pow(growing, -401)) / (growing - 1 / growing);
  const double got = largest(heights(wave.newest, s));
  record("growth", got);
  EXPECT_NEAR(got / expected, 1, 1e-10) << "roundings of 1e-15 grow alongside, by n^2 / 2 at most relative to the wave";
  EXPECT_GT(got, 4e4);
}

// As published the Courant number is at the limit for every damping, and no wave of no mode grows.
TEST(WaveStability, PublishedWaterNeverGrows) {
  for (const double gamma : {0.5, 0.98, 0.999}) {
    for (double S = -2; S <= 2; S += 0.125) {
      ASSERT_LE(std::abs(roots(static_cast<float>(gamma) * S, static_cast<float>(gamma)).first), std::sqrt(gamma) * (1 + 1e-7));
    }
  }
}

}  // namespace
}  // namespace rainref::puddle
