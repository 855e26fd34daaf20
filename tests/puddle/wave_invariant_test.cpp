// P5: what the scheme keeps exactly.
#include "puddle/support.h"

namespace rainref::puddle {
namespace {

// The sum of the four neighbours under a boundary rule.
Field neighbour_sum(const Field& u, const Settings& s) {
  const auto [width, height] = wave_size(s);
  const auto at = [&, w = width, h = height](int x, int y) {
    const bool outside = x < 0 || x >= w || y < 0 || y >= h;
    if (outside && s.boundary == Boundary::fixed) return 0.0;
    const bool wraps = s.boundary == Boundary::periodic;
    x = wraps ? (x + w) % w : std::clamp(x, 0, w - 1);
    y = wraps ? (y + h) % h : std::clamp(y, 0, h - 1);
    return u[static_cast<std::size_t>(y) * w + x];
  };
  return make_field(width, height, [&](int x, int y) { return at(x - 1, y) + at(x + 1, y) + at(x, y - 1) + at(x, y + 1); });
}

// Q_n = |u_{n+1}|^2 + gamma |u_n|^2 - gamma <u_{n+1}, sum u_n / 2>
double published_invariant(const Field& newest, const Field& previous, const Settings& s, double gamma) {
  return dot(newest, newest) + gamma * dot(previous, previous) - gamma * dot(newest, neighbour_sum(previous, s)) / 2;
}

TEST(WaveInvariant, PublishedInvariantIsMultipliedByGammaInEveryStep) {
  for (const Boundary boundary : boundaries) {
    const Settings s = as_published(31, 22, 0.98, boundary);
    OracleWave wave = oracle_of(s, noise(cells_of(s), 13), noise(cells_of(s), 14));
    const double gamma = wave.uniforms().damping, cells = static_cast<double>(cells_of(s));
    double q = published_invariant(heights(wave.newest, s), heights(wave.previous, s), s, gamma), worst = 0;
    for (int n = 1; n <= 300; ++n) {
      wave.step();
      const Field newest = heights(wave.newest, s), previous = heights(wave.previous, s);
      const double next = published_invariant(newest, previous, s, gamma);
      const double error = std::abs(next - gamma * q);
      // An error of e in every texel of the new level changes Q by at most 2 (|u_{n+1}| + gamma |u_n|) |e|; the heights stay
      // below 4, whose roundings are four times those of 1. The sums of Q itself round by 1e-16 of their terms, cells at most.
      const double e = 4 * step_rounding * ulp_double * std::sqrt(cells);
      const double norms = std::sqrt(dot(newest, newest)) + std::sqrt(dot(previous, previous));
      ASSERT_LE(error, 2 * norms * e + cells * ulp_double * norms * norms) << text(s) << " step " << n;
      worst = std::max(worst, error / (gamma * q));
      q = next;
    }
    record(text(s) + " worst relative step", worst);
  }
}

TEST(WaveInvariant, PublishedInvariantHoldsInFloats) {
  for (const Boundary boundary : boundaries) {
    for (const double gamma : {1.0, 0.999}) {
      const Settings s = as_published(61, 75, gamma, boundary);
      Puddle puddle = puddle_of(s);
      put(puddle, noise(cells_of(s), 15, 0.5), noise(cells_of(s), 16, 0.5));
      const double factor = static_cast<float>(gamma);
      const auto q = [&] { return published_invariant(heights(puddle.newest(), s), heights(puddle.previous(), s), s, factor); };
      const double first = q();
      double worst = 0;
      for (int n = 1; n <= 1000; ++n) {
        puddle.simulate();
        if (n % 100 != 0 && n > 2) continue;
        const double error = std::abs(q() / (first * std::pow(factor, n)) - 1);
        worst = std::max(worst, error / std::sqrt(n));
        // Roundings of single texels are independent: a walk, 1e-6 a step.
        ASSERT_LE(error, 1e-6 * std::sqrt(n)) << text(s) << " gamma " << gamma << " step " << n;
      }
      record(fmt::format("{} gamma {} worst over sqrt n", text(s), gamma), worst);
    }
  }
}

// gamma = 1, any Courant number: E = |u1 - u0|^2 / 2 + C^2 / 2 <grad u1, grad u0>, and <grad u1, grad u0> = -<u1, L u0>.
double corrected_energy(const Field& newest, const Field& previous, const Settings& s, double courant_sq) {
  const Field difference = minus(newest, previous), around = neighbour_sum(previous, s);
  return dot(difference, difference) / 2 - courant_sq / 2 * (dot(newest, around) - 4 * dot(newest, previous));
}

TEST(WaveInvariant, CorrectedEnergyIsKeptWithoutDamping) {
  for (const Boundary boundary : boundaries) {
    for (const double courant : {0.7, 0.5, 0.2}) {
      const Settings s = corrected(31, 22, 1, courant, boundary);
      OracleWave wave = oracle_of(s, noise(cells_of(s), 17), noise(cells_of(s), 18));
      const double courant_sq = wave.uniforms().courant_sq, cells = static_cast<double>(cells_of(s));
      const auto energy = [&] { return corrected_energy(heights(wave.newest, s), heights(wave.previous, s), s, courant_sq); };
      const double first = energy();
      double before = first, worst = 0;
      for (int n = 1; n <= 300; ++n) {
        wave.step();
        const double here = energy(), top = largest(heights(wave.newest, s));
        // An error of e in every texel changes E by at most (|u1 - u0| + 4 C^2 |u0|) |e| <= 4 top sqrt(cells) |e|.
        const double e = step_rounding * ulp_double * std::max(1.0, top) * std::sqrt(cells);
        const double step = 4 * top * std::sqrt(cells) * e + cells * ulp_double * 8 * top * top * std::sqrt(cells);
        ASSERT_NEAR(here, before, step) << text(s) << " step " << n;
        worst = std::max(worst, std::abs(here / first - 1));
        before = here;
      }
      record(fmt::format("{} courant {} worst", text(s), courant), worst);
      ASSERT_LE(worst, 1e-12);
    }
  }
}

TEST(WaveInvariant, CorrectedEnergyIsKeptInFloats) {
  for (const Boundary boundary : boundaries) {
    const Settings s = corrected(61, 75, 1, 0.5, boundary);
    Puddle puddle = puddle_of(s);
    put(puddle, noise(cells_of(s), 19, 0.5), noise(cells_of(s), 20, 0.5));
    const double courant_sq = wave_step_uniforms(s).courant_sq;
    const auto energy = [&] { return corrected_energy(heights(puddle.newest(), s), heights(puddle.previous(), s), s, courant_sq); };
    const double first = energy();
    for (int n = 1; n <= 1000; ++n) {
      puddle.simulate();
      if (n % 100 != 0) continue;
      ASSERT_NEAR(energy() / first, 1, 1e-6 * std::sqrt(n)) << text(s) << " step " << n;  // a walk, as above
    }
  }
}

/// How far the mean height of a basin came from 0 in 30 s of rain, at most, looked at every second [m].
double wandered(Format storage, double rain_rate) {
  Settings s = default_settings(Variant::corrected);
  s.width = 8;
  s.height = 6;
  s.grid = {96, 64};
  s.shape = Shape::basin;
  s.storage = storage;
  s.rain_rate = rain_rate;
  Puddle puddle = puddle_of(s);
  double most = 0;
  for (int second = 0; second < 30; ++second) {
    for (int frame = 0; frame < 60; ++frame) puddle.simulate();
    double sum = 0;
    for (const double h : heights(puddle.newest(), s)) sum += h;
    most = std::max(most, std::abs(sum) / static_cast<double>(cells_of(s)));
  }
  record(fmt::format("{} in {} mm/h [m]", info(storage).name, rain_rate), most);
  return most;
}

// The scheme keeps the mean; storage rounds every level, to 1e-6 m at 2 mm, so that in halves the mean wanders. docs/effects/puddle.md has
// these figures.
TEST(WaveInvariant, InHalvesTheMeanWandersByMicrometres) {
  for (const double rate : {5.0, 40.0}) {
    const double halves = wandered(Format::rg16f, rate), floats = wandered(Format::rg32f, rate);
    EXPECT_LT(halves, 2e-5) << rate;
    EXPECT_GT(halves, 1e-6) << rate;
    EXPECT_GT(halves, 3 * floats) << rate;
    EXPECT_LT(floats, 2.5e-6) << rate;  // craters cut into cells have a little volume
  }
}

}  // namespace
}  // namespace rainref::puddle
