// P7: what a drop brings: volume, kick or displacement.
#include "puddle/kernels.h"
#include "puddle/rainfall.h"
#include "puddle/support.h"

namespace rainref::puddle {
namespace {

double sum(const Field& u) { return mean(u) * static_cast<double>(u.size()); }

// ---- as published --------------------------------------------------------------------------------------------------

// 1 - smoothstep(a, a + w, r): volume pi (a^2 + a w + 0.3 w^2) = 17.82854 for a = 0.5, w = 3.5.
TEST(WaveImpulse, VolumeOfAPublishedDrop) {
  const double a = 0.5, w = 3.5, volume = pi * (a * a + a * w + 0.3 * w * w);
  EXPECT_NEAR(volume, 17.82854, 5e-6);
  const Settings s = as_published(17, 17, 0.98);
  double total = 0, least = 100, most = 0;
  for (int j = 0; j < 32; ++j) {
    for (int i = 0; i < 32; ++i) {
      OracleWave wave(s);
      const Drop drop{8 + i / 32.0f, 8 + j / 32.0f, 1, 4};
      wave.step(std::span(&drop, 1));
      const double texels = sum(heights(wave.newest, s));
      least = std::min(least, texels);
      most = std::max(most, texels);
      total += texels;
      EXPECT_EQ(sum(heights(wave.previous, s)), 0) << "into the new level only: a kick of the velocity";
    }
  }
  record("least", least);
  record("most", most);
  // The range over all centres, to the last digit of the table.
  EXPECT_GE(least, 17.8204 - 5e-5);
  EXPECT_LE(most, 17.8507 + 5e-5);
  // The mean over a grid of centres leaves only the lattice waves beyond 32 a texel: none to 1e-5.
  EXPECT_NEAR(total / 1024, volume, 1e-5);
}

TEST(WaveImpulse, StoredVolumeOfAPublishedDropIsThatOfTheOracle) {
  Settings s = as_published(64, 48, 0.98);
  s.drop_count = 1;
  s.drop_intensity = 1;
  s.rain_speed = 1;
  s.fps = 60;
  Puddle puddle = puddle_of(s);
  OracleWave oracle(s);
  for (int n = 0; n < 12; ++n) {
    const std::vector<Drop> drops = raindrops_as_published(raindrops_uniforms(s, n));
    ASSERT_EQ(drops.size(), 1u);
    puddle.simulate();
    oracle.step(drops);
    // Sum of the roundings of all cells, each at its largest.
    EXPECT_NEAR(sum(heights(puddle.newest(), s)), sum(heights(oracle.newest, s)), step_rounding * ulp_float * growth(s, n + 1) * 64 * 48);
  }
}

// A pulse's activation adds up to 0.2 of its frames, so what a drop brings grows with the frame rate: 6, 12, 28.8.
TEST(WaveImpulse, PublishedPulseBringsAFifthOfItsFrames) {
  for (const double fps : {30.0, 60.0, 144.0}) {
    Settings s = as_published(64, 48, 0.98);
    s.drop_count = 1;
    s.drop_intensity = 1;
    s.rain_speed = 1;
    s.fps = fps;
    for (const int pulse : {0, 3}) {
      double total = 0, strength = 0;
      for (int n = 0; n < fps; ++n) {
        const float amplitude = raindrops_as_published(raindrops_uniforms(s, pulse * static_cast<int>(fps) + n))[0].amplitude;
        total += amplitude;
        strength = std::max<double>(strength, amplitude);  // the activation is 1 from 0.15 to 0.2 of the pulse
      }
      record(fmt::format("fps {}", fps), total / strength);
      // Time is a float below 4: a pulse position is off by 2^-23, the slope of the activation is at most 1.5 / 0.15. Where the
      // kinks in its curvature (267) fall between two frames the sum is off by 4e-4 at most.
      EXPECT_NEAR(total / strength, 0.2 * fps, fps * 0.35 * 10 * 0x1p-23 + 4e-4) << fps;
    }
  }
}

// The mean of water after one kick of 1: gamma^((n-1)/2) sin(n w0) / sin w0, cos w0 = sqrt(gamma). It overshoots.
TEST(WaveImpulse, PublishedMeanAfterAKick) {
  const Drop drop{8.5f, 8.5f, 1, 4};
  for (const double damping : {0.98, 1.0}) {
    const Settings s = as_published(17, 17, damping);
    OracleWave wave(s);
    const double gamma = wave.uniforms().damping, w0 = std::acos(std::sqrt(gamma));
    wave.step(std::span(&drop, 1));
    const double kick = mean(heights(wave.newest, s));
    double most = 0, least = 0;
    for (int n = 2; n <= 600; ++n) {
      wave.step();
      const double expected = gamma < 1 ? std::pow(gamma, (n - 1) * 0.5) * std::sin(n * w0) / std::sin(w0) : n;
      const double got = mean(heights(wave.newest, s)) / kick;
      // The height at the drop is 1, of the mean 0.06: roundings relative to the kick.
      ASSERT_NEAR(got, expected, step_rounding * ulp_double * growth(s, n) / kick + 1e-12 * std::abs(expected)) << n;
      most = std::max(most, got);
      least = std::min(least, got);
    }
    if (gamma < 1) {
      EXPECT_NEAR(most, 6.39, 5e-3) << "the table's last digit";
      EXPECT_NEAR(least, -5.12, 5e-3);
    }
  }
}

// ---- corrected -----------------------------------------------------------------------------------------------------

// The crater's profile is 4 (1 - q^2)^3 - 3 (1 - q^2)^2, whose transform is 2 pi R^2 (192 J4(k)/k^4 - 24 J3(k)/k^3), k = 2 pi R m.
// The sum over texels differs from the volume 0 by its values at the lattice m != 0 (Poisson). With |J(k)| <= 1.01 sqrt(2 / (pi k))
// and the lattice sum of |m|^-3.5, 6.97: at most 1.36 (1 + 8 / (2 pi R)) R^-1.5.
double crater_volume_bound(double radius) { return 1.36 * (1 + 8 / (2 * pi * radius)) * std::pow(radius, -1.5); }

TEST(WaveImpulse, ACorrectedCraterHasNoVolume) {
  for (const double radius : {3.0, 3.7, 5.0, 8.0, 12.5, 20.0}) {
    const int size = 2 * static_cast<int>(radius) + 5;
    const Settings s = corrected(size, size, 0.98, 0.6);
    double worst = 0;
    for (int k = 0; k < 64; ++k) {
      OracleWave wave(s);
      const float corner = static_cast<float>(size / 2);
      const Drop drop{corner + static_cast<float>(k % 8) / 8, corner + static_cast<float>(k / 8) / 8, -1, static_cast<float>(radius)};
      wave.step(std::span(&drop, 1));
      worst = std::max(worst, std::abs(sum(heights(wave.newest, s))));
    }
    record(fmt::format("radius {} volume", radius), worst);
    record(fmt::format("radius {} bound", radius), crater_volume_bound(radius));
    EXPECT_LE(worst, crater_volume_bound(radius)) << radius;
  }
}

// A displacement, not a kick: on level water both levels get the very same crater, the mean shifts by its volume and stays.
TEST(WaveImpulse, ACorrectedCraterGoesIntoBothLevelsAndItsMeanStays) {
  const Settings s = corrected(23, 19, 0.98, 0.6);
  OracleWave wave(s);
  const Drop drop{9.3f, 8.8f, -1, 3};
  wave.step(std::span(&drop, 1));
  EXPECT_EQ(wave.newest, wave.previous);
  const double shift = mean(heights(wave.newest, s));
  EXPECT_NE(shift, 0);
  for (int n = 1; n <= 1000; ++n) {
    wave.step();
    ASSERT_NEAR(mean(heights(wave.newest, s)), shift, step_rounding * ulp_double * growth(s, n)) << n;
  }
  // On moving water: next to the same water without the drop, both levels differ by the crater.
  OracleWave with = oracle_of(s, noise(cells_of(s), 21), noise(cells_of(s), 22)), without = with;
  OracleWave level(s);
  with.step(std::span(&drop, 1));
  without.step();
  level.step(std::span(&drop, 1));
  EXPECT_LE(largest(minus(minus(with.newest, without.newest), level.newest)), 8 * ulp_double) << "one sum of numbers up to 4";
  EXPECT_LE(largest(minus(minus(with.previous, without.previous), level.previous)), 2 * ulp_double) << "one sum of numbers up to 2";
}

TEST(WaveImpulse, StoredCratersOfTheFirstStepAreTheSameInBothLevels) {
  for (const Format storage : {Format::rg32f, Format::rg16f}) {
    Settings s = corrected(61, 75, 0.98, 0.6);
    s.storage = storage;
    s.rain_rate = 100;
    Puddle puddle = puddle_of(s);
    puddle.simulate();
    const Field newest = stored_values(puddle.newest());
    EXPECT_GT(largest(newest), 0);
    EXPECT_EQ(newest, stored_values(puddle.previous()));
  }
}

// Steady rain in the middle of the water moves the mean by the volumes of its craters on the grid, and by nothing else.
TEST(WaveImpulse, MeanUnderRainIsTheSumOfItsVolumes) {
  Settings s = corrected(61, 75, 0.98, 0.6);
  s.rain_rate = 50;
  s.cell_size = 0.004;
  s.wave_speed = 0.6 * s.step_rate * s.cell_size;
  Puddle puddle = puddle_of(s);
  const Rainfall rainfall(s, 1);
  double volume = 0, top = 0;
  for (int n = 0; n < 200; ++n) {
    for (const Drop& drop : rainfall.drops(n)) {
      OracleWave level(s);
      level.step(std::span(&drop, 1));
      volume += sum(level.newest);
    }
    puddle.simulate();
    top = std::max(top, largest(heights(puddle.newest(), s)));
  }
  record("volume", volume);
  const double got = sum(heights(puddle.newest(), s));
  // Roundings of single texels are independent: a walk of 200 steps over all cells, answered by 1 / (1 - gamma); 4 sigma.
  const double walk = 4 * step_rounding / 3 * ulp_float * top * 50 * std::sqrt(200.0 * static_cast<double>(cells_of(s)));
  record("volume less the mean's", got - volume);
  record("walk", walk);
  EXPECT_NEAR(got, volume, walk);
}

}  // namespace
}  // namespace rainref::puddle
