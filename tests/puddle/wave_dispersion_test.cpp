// P3, P4: frequencies and speeds of waves, measured from what the scheme does and held against its dispersion relation.
#include "puddle/support.h"

namespace rainref::puddle {
namespace {

// The recurrence a_{n+1} = sum a_n - product a_{n-1} that four amplitudes in a row obey (Prony).
struct Measured {
  double sum, product;
  double frequency() const { return std::acos(sum / (2 * std::sqrt(product))); }
};
// Of mode (p, q) on periodic water, from a start that knows nothing of the answer: both levels equal.
Measured measure(const Settings& s, int p, int q) {
  const auto [width, height] = wave_size(s);
  const Mode m = mode(s.boundary, width, height, p, q);
  OracleWave wave = oracle_of(s, m.shape, m.shape);
  double a[4];
  for (double& amplitude : a) {
    wave.step();
    amplitude = m.amplitude(heights(wave.newest, s));
  }
  const double determinant = a[1] * a[1] - a[0] * a[2];
  return {(a[1] * a[2] - a[0] * a[3]) / determinant, (a[2] * a[2] - a[1] * a[3]) / determinant};
}

// ---- P4: gamma = 1 -------------------------------------------------------------------------------------------------

TEST(WaveDispersion, AxisSpeedsOfTheTable) {
  const struct {
    int wavelength;
    double phase, group;
  } table[] = {{4, .9428, .8165}, {6, .9760, .9258}, {8, .9868, .9597}, {12, .9942, .9825}, {16, .9968, .9903}, {32, .9992, .9976}};
  const int width = 960;
  const Settings s = as_published(width, 2, 1, Boundary::periodic);
  const double c = courant_limit;  // texels in a step
  for (const auto& row : table) {
    const int p = width / row.wavelength;
    const double k = 2 * pi * p / width, dk = 2 * pi / width;
    const double phase = measure(s, p, 0).frequency() / k / c;
    const double group = (measure(s, p + 1, 0).frequency() - measure(s, p - 1, 0).frequency()) / (2 * dk) / c;
    record(fmt::format("wavelength {} phase", row.wavelength), phase);
    record(fmt::format("wavelength {} group", row.wavelength), group);
    EXPECT_NEAR(phase, row.phase, 5e-5 + 1e-9) << "the table's last digit";
    // The difference quotient is off by dk^2 / 6 of the third derivative of w / c, which is below 1: 7.2e-6.
    EXPECT_NEAR(group, row.group, 5e-5 + 7.2e-6) << "the table's last digit";
  }
}

TEST(WaveDispersion, DiagonalWavesAreExactAtTheLimit) {
  const Settings s = as_published(48, 48, 1, Boundary::periodic);
  for (int p = 1; p <= 12; ++p) {  // up to a quarter of the sampling frequency
    const double k = std::sqrt(2.0) * 2 * pi * p / 48;
    // Four products of amplitudes good to the coherent rounding of four steps (10 times 13 of 2^-53), over the determinant
    // a_0^2 - a_1 a_-1 = 2 - 2 cos w, over 2 w sin w for the arc cosine.
    const double w = k * courant_limit, sum = 4 * 10 * step_rounding * ulp_double / (2 - 2 * std::cos(w));
    EXPECT_NEAR(measure(s, p, p).frequency() / w, 1, sum / (2 * w * std::sin(w))) << p;
  }
}

TEST(WaveDispersion, LongWavesSlowDownByTheLeadingTerm) {
  const int size = 96;
  const Settings s = as_published(size, size, 1, Boundary::periodic);
  for (const auto& [p, q] : {std::array{3, 0}, {0, 4}, {2, 2}, {3, 1}, {4, 2}}) {
    const double kx = 2 * pi * p / size, ky = 2 * pi * q / size, k = std::hypot(kx, ky), cosine = kx / k, sine = ky / k;
    const double leading = 1 - k * k / 24 * (std::pow(cosine, 4) + std::pow(sine, 4) - 0.5);
    // What follows is k^4 times less than 1/500: 1/1920 of the sine, 3/640 / 4 of the arc sine, the square of the first.
    EXPECT_NEAR(measure(s, p, q).frequency() / k / courant_limit, leading, std::pow(k, 4) / 500) << p << ", " << q;
  }
}

// STEP = 2 reaches twice as far in a step: cos w = (cos 2kx + cos 2ky) / 2, long waves sqrt(2) texels in a step.
TEST(WaveDispersion, AnOffsetOfTwoDoublesTheSpeed) {
  Settings far = as_published(96, 96, 1, Boundary::periodic);
  far.step = 2;
  const Settings near = as_published(48, 48, 1, Boundary::periodic);
  for (const auto& [p, q] : {std::array{1, 0}, {2, 3}, {8, 8}}) {
    EXPECT_NEAR(measure(far, p, q).frequency(), measure(near, p, q).frequency(), 1e-11) << p << ", " << q;
  }
  const double k = 2 * pi / 48;  // on a lattice of every second texel
  EXPECT_NEAR(measure(far, 1, 0).frequency() / (2 * pi / 96), 2 * courant_limit * (1 - k * k / 48), 1e-6) << "the next term is k^4 / 2000";
}

// ---- P3: the published damping is a mass ---------------------------------------------------------------------------

TEST(WaveDispersion, PublishedFrequenciesWithDamping) {
  const Settings s = as_published(24, 20, 0.95, Boundary::periodic);
  const double gamma = static_cast<float>(s.damping);
  for (int p = 0; p <= 12; ++p) {
    for (int q = 0; q <= 10; ++q) {
      const double half_sum = (std::cos(2 * pi * p / 24) + std::cos(2 * pi * q / 20)) / 2;
      const Measured got = measure(s, p, q);
      // The determinant is at least sin^2 w >= 1 - gamma = 0.05 of amplitudes good to 1e-15.
      ASSERT_NEAR(got.product, gamma, 4e-13);
      ASSERT_NEAR(std::cos(got.frequency()), std::sqrt(gamma) * half_sum, 4e-13) << p << ", " << q;
    }
  }
}

// Level water rings: cos w0 = sqrt(gamma), a period of 27.9, 62.7, 198.7 steps.
TEST(WaveDispersion, PublishedMeanRingsWithThePeriodsOfTheTable) {
  const struct { double gamma, period; } table[] = {{0.95, 27.9}, {0.99, 62.7}, {0.999, 198.7}};
  for (const auto& row : table) {
    const Settings s = as_published(5, 3, row.gamma);
    Puddle puddle = puddle_of(s);
    put(puddle, Field(15, 0.5), Field(15, 0.5));
    // Zero crossings of the mean, the fading undone, between the second and the twelfth: five periods.
    std::vector<double> crossings;
    double last = 0.5;
    for (int n = 1; crossings.size() < 12 && n < 5000; ++n) {
      puddle.simulate();
      const double here = mean(heights(puddle.newest(), s)) / std::pow(row.gamma, n * 0.5);
      if ((here < 0) != (last < 0)) crossings.push_back(n - here / (here - last));
      last = here;
    }
    ASSERT_EQ(crossings.size(), 12u);
    const double period = (crossings[11] - crossings[1]) / 5;
    record(fmt::format("gamma {}", row.gamma), period);
    // The table's last digit; a chord for a sine moves a crossing by w^2 / 16 of a step at most, 0.003.
    EXPECT_NEAR(period, row.period, 0.05 + 0.003);
  }
}

// E3 (23) corrected: the mean has the roots 1 and gamma, so what is there stays there.
TEST(WaveDispersion, CorrectedMeanStays) {
  for (const Boundary boundary : {Boundary::reflecting, Boundary::periodic}) {
    const Settings s = corrected(23, 19, 0.98, 0.6, boundary);
    Field newest = noise(cells_of(s), 7), previous = noise(cells_of(s), 8);
    const double shift = mean(newest) - mean(previous);
    for (double& u : previous) u += shift;
    OracleWave wave = oracle_of(s, newest, previous);
    const double before = mean(newest);
    double top = 0, worst = 0;
    for (int n = 1; n <= 1000; ++n) {
      wave.step();
      top = std::max(top, largest(heights(wave.newest, s)));
      worst = std::max(worst, std::abs(mean(heights(wave.newest, s)) - before));
    }
    record(text(s), worst);
    EXPECT_LE(worst, step_rounding * ulp_double * std::max(1.0, top) * growth(s, 1000));

    // In floats the mean walks: roundings of single texels, independent, average out over the cells. A step adds at most
    // 13 roundings to a texel, a third of that in the root mean square; the walk is answered by 1 / (1 - gamma) = 50; 4 sigma.
    Puddle puddle = puddle_of(s);
    put(puddle, newest, newest);
    const double stored = mean(heights(puddle.newest(), s));
    for (int n = 0; n < 1000; ++n) puddle.simulate();
    const double walk = std::abs(mean(heights(puddle.newest(), s)) - stored);
    record(text(s) + " float", walk);
    EXPECT_LE(walk, 4 * step_rounding / 3 * ulp_float * top * 50 * std::sqrt(1000.0 / static_cast<double>(cells_of(s))));
  }
}

// ---- P3: any Courant number ----------------------------------------------------------------------------------------

// z^2 - [(1 + gamma) + C^2 (1 + gamma) / 2 (2 cos kx + 2 cos ky - 4)] z + gamma = 0: real roots for long waves, which creep, a
// pair with |z| = sqrt(gamma) for the rest.
TEST(WaveDispersion, CorrectedRootsForAnyCourantNumber) {
  int creeping = 0, ringing = 0;
  for (const double gamma : {0.9, 0.98, 1.0}) {
    for (const double courant : {courant_limit, 0.6, 0.3, 0.1}) {
      const Settings s = corrected(24, 20, gamma, courant, Boundary::periodic);
      const WaveStepUniforms u = wave_step_uniforms(s);
      for (const auto& [p, q] : {std::array{1, 0}, {0, 1}, {3, 0}, {2, 2}, {5, 3}, {4, 7}, {12, 3}}) {
        const double S = std::cos(2 * pi * p / 24) + std::cos(2 * pi * q / 20), b = root_sum(s, u, S);
        const Measured got = measure(s, p, q);
        // Four products of amplitudes good to the coherent rounding of four steps (10 times 13 of 2^-53), over the determinant:
        // a_0^2 - a_1 a_-1 = 1 - b + gamma at the start, gamma times that in every step.
        const double determinant = (1 - b + u.damping) * u.damping * u.damping;
        const double tolerance = 4 * 10 * step_rounding * ulp_double / determinant;
        ASSERT_NEAR(got.sum, b, tolerance) << text(s) << " " << gamma << " " << courant << " mode " << p << ", " << q;
        ASSERT_NEAR(got.product, u.damping, tolerance);
        (b * b > 4 * u.damping ? creeping : ringing) += 1;
        if (b * b < 4 * u.damping) {
          // cos w = (1 + gamma) (1 - C^2 |L| / 2) / (2 sqrt gamma), L = 2 S - 4; C^2 and gamma are floats in the step.
          const double cosine = (1 + gamma) * (1 + courant * courant * (S - 2)) / (2 * std::sqrt(gamma));
          ASSERT_NEAR(std::cos(got.frequency()), cosine, tolerance + 6 * ulp_float);
        }
      }
    }
  }
  EXPECT_GT(creeping, 1);
  EXPECT_GT(ringing, 50);
}

// Without damping sin^2(w/2) = C^2 (sin^2(kx/2) + sin^2(ky/2)): speeds along the axis, the diagonal and 30 degrees.
TEST(WaveDispersion, CorrectedSpeedByDirectionWavenumberAndCourantNumber) {
  const int size = 64;
  double slowest = 1;
  for (const double courant : {courant_limit, 0.5, 0.25}) {
    const Settings s = corrected(size, size, 1, courant, Boundary::periodic);
    EXPECT_EQ(puddle_of(s).courant(), courant);
    for (const auto& [p, q] : {std::array{1, 0},
                               {2, 0},
                               {4, 0},
                               {8, 0},
                               {0, 8},
                               {16, 0},  // axis: 64 to 4 texels
                               {1, 1},
                               {4, 4},
                               {8, 8},  // diagonal
                               {7, 4},
                               {14, 8}}) {  // 29.7 degrees
      const double kx = 2 * pi * p / size, ky = 2 * pi * q / size, k = std::hypot(kx, ky);
      const double exact = 2 * std::asin(courant * std::hypot(std::sin(kx / 2), std::sin(ky / 2)));
      const double speed = measure(s, p, q).frequency() / (courant * k);
      // C^2 is a float in the step: half of 2^-24 in w, more as w nears pi (tan(w/2) / (w/2), at most 2 here).
      EXPECT_NEAR(speed, exact / (courant * k), 2 * ulp_float) << courant << ": " << p << ", " << q;
      EXPECT_LT(speed, 1 + 2 * ulp_float) << "no wave outruns c";
      // The leading term of any Courant number; what follows is below k^4 / 400.
      const double shape = (std::pow(kx, 4) + std::pow(ky, 4)) / std::pow(k, 4);
      if (k < 1) {
        EXPECT_NEAR(speed, 1 - k * k / 24 * (shape - courant * courant), std::pow(k, 4) / 400 + 2 * ulp_float);
      }
      slowest = std::min(slowest, speed);
    }
  }
  record("slowest", slowest);
}

}  // namespace
}  // namespace rainref::puddle
