// P1, P2: the published scheme and its exact modes, under each boundary rule, in double and as stored.
#include "puddle/support.h"

namespace rainref::puddle {
namespace {

using testing::Le;

// The multiple of 2^-bits nearest to x: few enough bits that the steps below are exact.
double dyadic(double x, int bits) { return std::round(std::ldexp(x, bits)) * std::ldexp(1.0, -bits); }
Field dyadic_noise(std::size_t cells, unsigned seed) {
  Field field = noise(cells, seed);
  for (double& x : field) x = dyadic(x, 8);
  return field;
}

// P1 in real arithmetic: heights and gamma are short binary fractions, so that a step in float or double is exact.
TEST(WaveMode, PublishedStepIsGammaTimesHalfTheSumLessThePreviousLevel) {
  const double gamma = 63.0 / 64;
  const Settings s = as_published(23, 41, gamma, Boundary::periodic);
  const Field newest = dyadic_noise(cells_of(s), 3), previous = dyadic_noise(cells_of(s), 4);
  const Field expected = make_field(23, 41, [&](int x, int y) {
    const auto u = [&](int i, int j) { return newest[static_cast<std::size_t>((j + 41) % 41) * 23 + (i + 23) % 23]; };
    return gamma * (0.5 * (u(x - 1, y) + u(x + 1, y) + u(x, y - 1) + u(x, y + 1)) - previous[static_cast<std::size_t>(y) * 23 + x]);
  });
  OracleWave oracle = oracle_of(s, newest, previous);
  oracle.step();
  EXPECT_EQ(heights(oracle.newest, s), expected);
  EXPECT_EQ(heights(oracle.previous, s), newest);
  Puddle puddle = puddle_of(s);
  put(puddle, newest, previous);
  puddle.simulate();
  EXPECT_EQ(heights(puddle.newest(), s), expected);
  EXPECT_EQ(heights(puddle.previous(), s), newest);
}

// Courant number sqrt(1/2): the texel's own newest height does not enter its next one.
TEST(WaveMode, TheCentreTapCancelsAtTheLimit) {
  for (const Variant variant : variants) {
    const Settings s = variant == Variant::as_published ? as_published(9, 9, 1) : corrected(9, 9, 1, courant_limit);
    Field impulse(81), expected(81);
    impulse[4 * 9 + 4] = 0.25;
    for (const int i : {3 * 9 + 4, 5 * 9 + 4, 4 * 9 + 3, 4 * 9 + 5}) expected[static_cast<std::size_t>(i)] = 0.125;
    Puddle puddle = puddle_of(s);
    put(puddle, impulse, Field(81));
    puddle.simulate();
    EXPECT_EQ(heights(puddle.newest(), s), expected) << text(s);
  }
}

// STEP = 2: four lattices, each the water of STEP = 1 at half the size, bit for bit.
TEST(WaveMode, AnOffsetOfTwoDecouplesFourLattices) {
  for (const Boundary boundary : {Boundary::periodic, Boundary::fixed}) {
    Settings fine = as_published(34, 74, 0.99, boundary);
    fine.step = 2;
    const Settings coarse = as_published(17, 37, 0.99, boundary);
    const Field newest = noise(cells_of(fine), 5), previous = noise(cells_of(fine), 6);
    Puddle whole = puddle_of(fine);
    put(whole, newest, previous);
    for (int n = 0; n < 50; ++n) whole.simulate();
    for (int lattice = 0; lattice < 4; ++lattice) {
      const auto part = [&](const Field& field) {
        return make_field(17, 37,
                          [&](int x, int y) { return field[static_cast<std::size_t>(2 * y + lattice / 2) * 34 + 2 * x + lattice % 2]; });
      };
      Puddle alone = puddle_of(coarse);
      put(alone, part(newest), part(previous));
      for (int n = 0; n < 50; ++n) alone.simulate();
      EXPECT_EQ(stored_values(alone.newest()), part(stored_values(whole.newest()))) << text(fine) << " lattice " << lattice;
    }
  }
}
// A reflecting edge repeats the edge texel, so the second texel reads the first one: there the lattices meet.
TEST(WaveMode, AReflectingEdgeJoinsTheLattices) {
  Settings s = as_published(16, 16, 1);
  s.step = 2;
  Field impulse(256);
  impulse[8 * 16] = 0.5;
  Puddle puddle = puddle_of(s);
  put(puddle, impulse, Field(256));
  puddle.simulate();
  EXPECT_EQ(heights(puddle.newest(), s)[8 * 16 + 1], 0.25);
}

// A fractional STEP blurs each tap: W = (1 - f) cos rk + f cos (r + 1)k for cos k. The product of the roots stays gamma, so
// no wave fades faster for it; an impulse spreads over two rings at once, and waves slow down as |W| shrinks.
TEST(WaveMode, AFractionalOffsetBlursTheTapsAndKeepsTheDecay) {
  Settings s = as_published(24, 20, 0.98, Boundary::periodic);
  s.step = 1.25;
  double worst = 0;
  for (int p = 0; p < 24; p += 3) {
    for (int q = 0; q < 20; q += 2) {
      const Mode m = mode(s.boundary, 24, 20, p, q);
      const auto tap = [](double k) { return 0.75 * std::cos(k) + 0.25 * std::cos(2 * k); };
      const double gamma = static_cast<float>(s.damping), b = gamma * (tap(m.kx) + tap(m.ky));
      Field previous = m.shape;
      for (double& u : previous) u *= closed_form(b, gamma, -1);
      OracleWave wave = oracle_of(s, m.shape, previous);
      for (int n = 0; n < 300; ++n) wave.step();
      Field expected = m.shape;
      for (double& u : expected) u *= closed_form(b, gamma, 300);
      worst = std::max(worst, rms(minus(heights(wave.newest, s), expected)));
    }
  }
  record("largest RMS error", worst);
  EXPECT_LE(worst, 2 * step_rounding * ulp_double * growth(s, 300)) << "twice the rounding: eight loads, four mixes";

  Field impulse(cells_of(s));
  impulse[10 * 24 + 12] = 1;
  OracleWave wave = oracle_of(s, impulse, Field(impulse.size()));
  wave.step();
  const Field u = heights(wave.newest, s);
  EXPECT_NEAR(u[10 * 24 + 13], 0.98 * 0.75 / 2, 1e-7) << "gamma is a float";
  EXPECT_NEAR(u[10 * 24 + 14], 0.98 * 0.25 / 2, 1e-7);
  EXPECT_EQ(u[10 * 24 + 15], 0);
}

// P2: every mode of a small grid, a thousand steps, against its closed form.
void expect_closed_form_of_every_mode(const Settings& s) {
  const auto [width, height] = wave_size(s);
  const int steps = 1000;
  OracleWave wave(s);
  const double gamma = wave.uniforms().damping;
  double worst = 0;
  for (int q = 0; q < height; ++q) {
    for (int p = 0; p < width; ++p) {
      const Mode m = mode(s.boundary, width, height, p, q);
      const double b = root_sum(s, wave.uniforms(), m.sum());
      Field previous = m.shape, expected = m.shape;
      for (double& u : previous) u *= closed_form(b, gamma, -1);
      put(wave, s, m.shape, previous);
      for (int n = 1; n <= steps; ++n) {
        wave.step();
        if (n % 100 != 0 && n > 3) continue;
        const double a = closed_form(b, gamma, n);
        for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = a * m.shape[i];
        const double error = rms(minus(heights(wave.newest, s), expected));
        worst = std::max(worst, error);
        // Every rounding at its largest and all of one sign. Modes start no higher than 1 / sqrt(gamma); the shape solves the
        // neighbour sum to 12 roundings: sines (2 each, phases up to 2 pi) and their product.
        ASSERT_LE(error, (step_rounding + 12) * ulp_double / std::sqrt(gamma) * growth(s, n)) << "mode " << p << ", " << q << " step " << n;
      }
      // |z| = sqrt(gamma): as published for every wavenumber, corrected for all that oscillate.
      if (s.variant == Variant::as_published) {
        ASSERT_NEAR(std::abs(roots(b, gamma).first), std::sqrt(gamma), 4e-16);
      }
    }
  }
  record(fmt::format("{} courant {:.3g} largest RMS error", text(s), courant_number(s)), worst);
  EXPECT_LE(worst, 1e-12);
}
TEST(WaveMode, EveryPublishedModeFollowsItsClosedForm) {
  for (const Boundary boundary : boundaries) expect_closed_form_of_every_mode(as_published(16, 12, 0.98, boundary));
}
TEST(WaveMode, EveryCorrectedModeFollowsItsClosedForm) {
  for (const Boundary boundary : boundaries) expect_closed_form_of_every_mode(corrected(16, 12, 0.98, 0.6, boundary));
  expect_closed_form_of_every_mode(corrected(16, 12, 0.98, courant_limit, Boundary::periodic));
}

// cos w = sqrt(gamma) (cos kx + cos ky) / 2, and sqrt(gamma) a step, seen in the amplitudes alone: the Casorati determinant
// a_n^2 - a_{n+1} a_{n-1} is multiplied by the product of the roots, whatever the start.
TEST(WaveMode, AmplitudesFadeBySqrtGammaAStep) {
  const Settings s = as_published(16, 12, 0.98, Boundary::fixed);
  const Mode m = mode(s.boundary, 16, 12, 4, 2);
  OracleWave wave = oracle_of(s, m.shape, Field(m.shape.size()));
  const double gamma = wave.uniforms().damping;
  double before = 0, here = 1;
  wave.step();
  double next = m.amplitude(heights(wave.newest, s));
  const double first = here * here - next * before;
  for (int n = 1; n <= 500; ++n) {
    before = here;
    here = next;
    wave.step();
    next = m.amplitude(heights(wave.newest, s));
    const double envelope = std::sqrt((here * here - next * before) / first), expected = std::pow(gamma, n * 0.5);
    // |a| <= 1.1 envelope here, and each amplitude is off by at most the coherent rounding so far.
    ASSERT_NEAR(envelope, expected, 4 * step_rounding * ulp_double * growth(s, n)) << n;
    ASSERT_NEAR(envelope, expected, 1e-12) << n;
  }
}

// One step of the reference from its own state: the amplitude of a mode obeys a' = b a - gamma a_previous within the rounding of
// one step, so sqrt(gamma) a step holds as long as the wave lasts.
TEST(WaveMode, StoredModesObeyTheirRecurrenceWithinTheRoundingOfAStep) {
  for (const Variant variant : variants) {
    for (const Boundary boundary : boundaries) {
      for (const Format storage : {Format::rg32f, Format::rg16f}) {
        Settings s = variant == Variant::as_published ? as_published(45, 70, 0.98, boundary) : corrected(45, 70, 0.98, 0.6, boundary);
        s.storage = storage;
        SCOPED_TRACE(text(s));
        const Mode m = mode(boundary, 45, 70, 3, 5);
        const WaveStepUniforms u = wave_step_uniforms(s);
        const double gamma = u.damping, b = root_sum(s, u, m.sum());
        Field previous = m.shape;
        for (double& x : previous) x *= closed_form(b, gamma, -1);
        Puddle puddle = puddle_of(s);
        put(puddle, m.shape, previous);
        // A half between 1/2 and 1 is off by 2^-12; as published one stored unit is two of height.
        const double half = storage == Format::rg16f ? (variant == Variant::as_published ? 0x1p-11 : 0x1p-12) : 0;
        double weight = 0;  // of an error of 1 in every texel, signs as bad as can be
        for (const double x : m.shape) weight += std::abs(x);
        weight /= dot(m.shape, m.shape);
        double worst = 0;
        for (int n = 1; n <= 200; ++n) {
          const double here = m.amplitude(heights(puddle.newest(), s)), before = m.amplitude(heights(puddle.previous(), s));
          puddle.simulate();
          worst = std::max(worst, std::abs(m.amplitude(heights(puddle.newest(), s)) - (b * here - gamma * before)));
        }
        record(text(s), worst);
        EXPECT_LE(worst, weight * (step_rounding * ulp_float + half));
        const double limit = step_rounding * ulp_float + half;
        EXPECT_NEAR(m.amplitude(heights(puddle.newest(), s)), closed_form(b, gamma, 200), weight * limit * growth(s, 200));
      }
    }
  }
}

// -2 ln 2 / ln gamma steps: 27.0, 68.6, 137.9, 1385.6.
TEST(WaveMode, HalfLivesOfTheTable) {
  const struct { double gamma, steps; } table[] = {{0.95, 27.0}, {0.98, 68.6}, {0.99, 137.9}, {0.999, 1385.6}};
  for (const auto& row : table) {
    const Settings s = as_published(16, 12, row.gamma);
    const Mode m = mode(s.boundary, 16, 12, 5, 3);
    OracleWave wave = oracle_of(s, m.shape, Field(m.shape.size()));
    double before = 0, here = 1, first = 0, last = 1;
    for (int n = 0;; ++n) {
      wave.step();
      const double next = m.amplitude(heights(wave.newest, s));
      const double envelope = std::sqrt(here * here - next * before);
      if (n == 0) first = envelope;
      if (envelope <= first / 2) {
        // Between two steps the envelope is a power of n.
        const double half_life = n - std::log(first / 2 / envelope) / std::log(last / envelope);
        record(fmt::format("gamma {}", row.gamma), half_life);
        EXPECT_NEAR(half_life, row.steps, 0.05 + 0.02) << "the table's last digit, and gamma as a float";
        break;
      }
      last = envelope;
      before = here;
      here = next;
    }
  }
}

}  // namespace
}  // namespace rainref::puddle
