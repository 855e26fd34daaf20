// Frame rate and resolution: what the corrected water does not depend on. (The published: Defect17.)
#include "puddle/support.h"

namespace rainref::puddle {
namespace {

Settings rain_at(double fps, Format storage) {
  Settings s = no_rain(Variant::corrected, 61, 47);
  s.storage = storage;
  s.fps = fps;
  s.rain_rate = 60;
  s.step_rate = 240;
  s.cell_size = 0.005;
  return s;
}
struct Levels {
  Field newest, previous;
  bool operator==(const Levels&) const = default;
};
std::vector<Levels> levels_at_each_thirtieth(const Settings& s) {
  Puddle puddle = puddle_of(s);
  std::vector<Levels> out;
  for (int k = 1; k <= 20; ++k) {
    while (puddle.frame() < k * s.fps / 30) puddle.simulate();
    out.push_back({stored_values(puddle.newest()), stored_values(puddle.previous())});
  }
  return out;
}

TEST(WaveRate, CorrectedWaterHasTheSameBitsAtEqualTimesForEveryFrameRate) {
  for (const Format storage : {Format::rg32f, Format::rg16f}) {
    const std::vector<Levels> expected = levels_at_each_thirtieth(rain_at(30, storage));
    EXPECT_GT(largest(expected.back().newest), 1e-4) << "there are waves";
    for (const double fps : {60.0, 120.0, 240.0}) EXPECT_EQ(levels_at_each_thirtieth(rain_at(fps, storage)), expected) << fps;
  }
}

TEST(WaveRate, CorrectedStepsKeepUpWithTimeForEveryFrameRate) {
  for (const double fps : {7.0, 24.0, 25.0, 29.97, 60.0, 144.0, 240.0, 1000.0}) {
    const Settings s = rain_at(fps, Format::rg32f);
    for (const int frames : {1, 2, 59, 144, 1000, 1000000}) {
      const std::int64_t steps = steps_until(s, frames);
      // Whole steps that have ended: one less only where the quotient itself rounds, which no whole quotient does.
      EXPECT_LE(static_cast<double>(steps) / s.step_rate, frames / fps * (1 + 2 * ulp_double)) << fps << " " << frames;
      EXPECT_GT(static_cast<double>(steps + 1) / s.step_rate, frames / fps * (1 - 2 * ulp_double)) << fps << " " << frames;
    }
    if (fps == std::floor(fps)) {
      EXPECT_EQ(steps_until(s, static_cast<int>(fps) * 3), 720) << fps;
    }
  }
}

// The damping is a share of the energy in 1/60 s whatever the step rate.
TEST(WaveRate, GammaOfAStepIsTheDampingOfItsTime) {
  for (const double step_rate : {60.0, 120.0, 240.0, 1000.0}) {
    Settings s = corrected(8, 8, 0.96, 0.1);
    s.step_rate = step_rate;
    EXPECT_NEAR(std::pow(gamma_of_step(s), step_rate / 60), 0.96, 1e-15 * step_rate / 60) << step_rate;
  }
}

// The same wave in metres on grids twice as fine, with steps twice as short: the error against the damped wave equation
//   u_tt + kappa u_t = c^2 (u_xx + u_yy),   kappa = -60 ln(damping)
// falls by four. A standing wave of a closed basin: cos(p pi x / X) cos(q pi y / Y) e^(-kappa t / 2) (cos wt + kappa / 2w sin wt).
struct Basin {
  double extent_x = 0.8, extent_y = 0.6, c = 0.25, damping = 0.98, time = 2;
  int p = 3, q = 2;
  double exact(double t) const {
    const double kappa = -60 * std::log(damping), k_sq = std::pow(p * pi / extent_x, 2) + std::pow(q * pi / extent_y, 2);
    const double w = std::sqrt(c * c * k_sq - kappa * kappa / 4);
    return std::exp(-kappa * t / 2) * (std::cos(w * t) + kappa / (2 * w) * std::sin(w * t));
  }
};
Settings basin_of(const Basin& basin, int columns) {
  Settings s = no_rain(Variant::corrected, columns, columns * 3 / 4);
  s.damping = basin.damping;
  s.wave_speed = basin.c;
  s.cell_size = basin.extent_x / columns;
  s.step_rate = columns;  // Courant number 0.25 / 0.8 = 0.3125 on every grid
  s.fps = 1;
  return s;
}
TEST(WaveRate, CorrectedWaterConvergesWithTheSecondOrder) {
  const Basin basin;
  double before = 0;
  for (const int columns : {16, 32, 64, 128, 256}) {
    const Settings s = basin_of(basin, columns);
    const auto [width, height] = wave_size(s);
    const Mode m = mode(s.boundary, width, height, basin.p, basin.q);
    Field previous = m.shape;
    for (double& u : previous) u *= basin.exact(-1 / s.step_rate);
    OracleWave oracle = oracle_of(s, m.shape, previous);
    for (int n = 0; n < basin.time * s.step_rate; ++n) oracle.step();
    Puddle puddle = puddle_of(s);
    put(puddle, m.shape, previous);
    while (puddle.frame() < basin.time) puddle.simulate();
    EXPECT_EQ(puddle.steps(), static_cast<std::int64_t>(basin.time * s.step_rate));
    const double error = m.amplitude(heights(oracle.newest, s)) - basin.exact(basin.time);
    const double stored = m.amplitude(heights(puddle.newest(), s)) - basin.exact(basin.time);
    record(fmt::format("columns {} error", columns), error);
    record(fmt::format("columns {} stored error", columns), stored);
    const double steps = basin.time * s.step_rate;
    if (columns > 32) {
      const double order = std::log2(before / error);
      record(fmt::format("columns {} order", columns), order);
      // The next term of the error is (k dx)^2 of the first: 0.3 at 32 columns, a quarter each time. And gamma is a float: its
      // power after all steps, 0.3, is off by half the steps times 2^-25.
      EXPECT_NEAR(order, 2, 0.3 * std::pow(32.0 / columns, 2) + 2 * 0.3 * steps / 2 * 0x1p-25 / std::abs(error)) << columns;
    }
    // Independent roundings: their share in the mode is 2 / sqrt(cells), the mode answers by 1 / (w dt), w = 3.9; 4 sigma.
    EXPECT_NEAR(stored, error, 4 * step_rounding / 3 * ulp_float * 2 / std::sqrt(width * height) * s.step_rate / 3.9 * std::sqrt(steps));
    before = error;
  }
}

// Not of one mode: a hill, on grids of square cells whose rows and columns differ, against the finest.
TEST(WaveRate, AHillConvergesWithTheSecondOrder) {
  const Basin basin;
  const auto profile = [&](int columns) {
    const Settings s = basin_of(basin, columns);
    const auto [width, height] = wave_size(s);
    const Field hill = make_field(width, height, [&](int x, int y) {
      const double dx = (x + 0.5) * s.cell_size - 0.3, dy = (y + 0.5) * s.cell_size - 0.25;
      return std::exp(-(dx * dx + dy * dy) / (2 * 0.06 * 0.06));
    });
    // At rest at time 0: the level before is the level after, and both are half a step's curvature below. Its error, a
    // half step of time, is of first order when left out; the mirror in time puts it right.
    OracleWave wave = oracle_of(s, hill, hill);
    wave.step();
    const Field forward = heights(wave.newest, s);
    const double gamma = wave.uniforms().damping;
    Field before = hill;
    // u1 = 2 A u0 - gamma u_-1 with u_-1 = u1: u_-1 = (u1 + gamma u0) / (1 + gamma), u1 from equal levels.
    for (std::size_t i = 0; i < hill.size(); ++i) before[i] = (forward[i] + gamma * hill[i]) / (1 + gamma);
    put(wave, s, hill, before);
    for (int n = 0; n < s.step_rate; ++n) wave.step();  // 1 s
    // Means over the cells of the coarsest grid: 32 x 24.
    const Field u = heights(wave.newest, s);
    const int ratio = columns / 32;
    return make_field(32, 24, [&, w = width](int x, int y) {
      double total = 0;
      for (int j = 0; j < ratio; ++j) {
        for (int i = 0; i < ratio; ++i) total += u[static_cast<std::size_t>(y * ratio + j) * w + x * ratio + i];
      }
      return total / (ratio * ratio);
    });
  };
  const Field a = profile(64), b = profile(128), c = profile(256);
  const double order = std::log2(rms(minus(a, b)) / rms(minus(b, c)));
  record("order", order);
  EXPECT_NEAR(order, 2, 0.15);
}

}  // namespace
}  // namespace rainref::puddle
