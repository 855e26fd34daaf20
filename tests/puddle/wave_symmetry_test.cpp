// Symmetries that the order of operations keeps bit for bit, those that it keeps to rounding, rest, and linearity.
//
// Corrected adds the neighbours as (left + right) + (below + above): all eight symmetries of the square hold to the bit. As
// published they are added as ((below + left) + right) + above, so that a mirror or a transposition changes which two are added
// first and holds to the bit only while the sums are exact. Shifts, signs and powers of two hold always.
#include "puddle/support.h"

namespace rainref::puddle {
namespace {

Field shifted(const Field& u, int width, int height, int dx, int dy) {
  return make_field(width, height, [&](int x, int y) { return u[static_cast<std::size_t>((y + dy) % height) * width + (x + dx) % width]; });
}
// The eight symmetries of a square: bit 0 mirrors x, bit 1 mirrors y, bit 2 swaps the axes.
Field turned(const Field& u, int size, int symmetry) {
  return make_field(size, size, [&](int x, int y) {
    if (symmetry & 1) x = size - 1 - x;
    if (symmetry & 2) y = size - 1 - y;
    if (symmetry & 4) std::swap(x, y);
    return u[static_cast<std::size_t>(y) * size + x];
  });
}
Field after(const Settings& s, const Field& newest, const Field& previous, int steps) {
  Puddle puddle = puddle_of(s);
  put(puddle, newest, previous);
  for (int n = 0; n < steps; ++n) puddle.simulate();
  return stored_values(puddle.newest());
}

TEST(WaveSymmetry, RestStaysRestToTheBit) {
  for (const Variant variant : variants) {
    for (const Boundary boundary : boundaries) {
      for (const Format storage : {Format::rg32f, Format::rg16f, Format::rgba8}) {
        for (const Rounding rounding : {Rounding::rne, Rounding::rtz}) {
          Settings s = variant == Variant::as_published ? as_published(37, 35, 0.98, boundary) : corrected(37, 35, 0.98, 0.6, boundary);
          s.storage = storage;
          s.rounding = rounding;
          s.rim_width = 5 * s.cell_size;
          Puddle puddle = puddle_of(s);
          const Field before = stored_values(puddle.newest());
          // 1/2 has no 8-bit code: as published the nearest one is level water of its own.
          if (storage != Format::rgba8) {
            EXPECT_EQ(before, Field(cells_of(s), encoding(s).rest));
          }
          for (int n = 0; n < 100; ++n) puddle.simulate();
          EXPECT_EQ(stored_values(puddle.newest()), before) << text(s);
          EXPECT_EQ(stored_values(puddle.previous()), before) << text(s);
        }
      }
    }
  }
}

// Water that joins at its edges has no place of its own: not by tile, vector or row.
TEST(WaveSymmetry, PeriodicWaterShiftsToTheBit) {
  for (const Variant variant : variants) {
    for (const Format storage : {Format::rg32f, Format::rg16f}) {
      Settings s = variant == Variant::as_published ? as_published(37, 70, 0.98, Boundary::periodic)
                                                    : corrected(37, 70, 0.98, 0.6, Boundary::periodic);
      s.storage = storage;
      const Field newest = noise(cells_of(s), 23), previous = noise(cells_of(s), 24);
      const Field expected = after(s, newest, previous, 100);
      for (const auto& [dx, dy] : {std::array{1, 0}, {0, 1}, {5, 33}, {36, 69}}) {
        EXPECT_EQ(after(s, shifted(newest, 37, 70, dx, dy), shifted(previous, 37, 70, dx, dy), 100), shifted(expected, 37, 70, dx, dy))
            << text(s) << " by " << dx << ", " << dy;
      }
    }
  }
}

TEST(WaveSymmetry, CorrectedWaterChangesSignAndScaleToTheBit) {
  for (const Boundary boundary : boundaries) {
    Settings s = corrected(37, 35, 0.98, 0.6, boundary);
    const Field newest = noise(cells_of(s), 25), previous = noise(cells_of(s), 26);
    const auto times = [](Field u, double factor) {
      for (double& x : u) x *= factor;
      return u;
    };
    for (const Rounding rounding : {Rounding::rne, Rounding::rtz}) {
      s.rounding = rounding;
      s.storage = Format::rg32f;
      const Field expected = after(s, newest, previous, 100);
      EXPECT_EQ(after(s, times(newest, -1), times(previous, -1), 100), times(expected, -1));
      EXPECT_EQ(after(s, times(newest, 0x1p-10), times(previous, 0x1p-10), 100), times(expected, 0x1p-10));
      s.storage = Format::rg16f;  // the sign only: small halves are subnormal
      EXPECT_EQ(after(s, times(newest, -1), times(previous, -1), 100), times(after(s, newest, previous, 100), -1));
    }
  }
}

// C^2 = 1/2 without damping: from an impulse of 1 the heights are whole multiples of 2^-n no higher than 1, so the first 16 steps
// are exact and all eight symmetries of the square hold to the bit.
TEST(WaveSymmetry, ExactStepsHaveAllEightSymmetriesToTheBit) {
  const int size = 35;
  for (const Variant variant : variants) {
    for (const Boundary boundary : boundaries) {
      const Settings s =
          variant == Variant::as_published ? as_published(size, size, 1, boundary) : corrected(size, size, 1, courant_limit, boundary);
      for (const auto& [cx, cy] : {std::array{17, 17}, {3, 30}}) {
        Field impulse(cells_of(s));
        impulse[static_cast<std::size_t>(cy) * size + cx] = 1;
        const Field expected = after(s, impulse, Field(impulse.size()), 16);
        EXPECT_GT(largest(minus(expected, Field(expected.size(), encoding(s).rest))), 0.01);
        for (int symmetry = 1; symmetry < 8; ++symmetry) {
          EXPECT_EQ(after(s, turned(impulse, size, symmetry), Field(impulse.size()), 16), turned(expected, size, symmetry))
              << text(s) << " symmetry " << symmetry;
        }
      }
    }
  }
}
TEST(WaveSymmetry, CorrectedWaterHasAllEightSymmetriesToTheBit) {
  const int size = 35;
  for (const Boundary boundary : boundaries) {
    for (const Format storage : {Format::rg32f, Format::rg16f}) {
      Settings s = corrected(size, size, 0.98, 0.6, boundary);
      s.storage = storage;
      s.rim_width = storage == Format::rg32f ? 0 : 9 * s.cell_size;
      const Field newest = noise(cells_of(s), 27, 0.5), previous = noise(cells_of(s), 28, 0.5);
      const Field expected = after(s, newest, previous, 100);
      for (int symmetry = 1; symmetry < 8; ++symmetry) {
        EXPECT_EQ(after(s, turned(newest, size, symmetry), turned(previous, size, symmetry), 100), turned(expected, size, symmetry))
            << text(s) << " symmetry " << symmetry;
      }
    }
  }
}
TEST(WaveSymmetry, AsPublishedAllEightSymmetriesHoldToRounding) {
  const int size = 35;
  {
    const Settings s = as_published(size, size, 0.98);
    const Field newest = noise(cells_of(s), 27, 0.5), previous = noise(cells_of(s), 28, 0.5);
    const Field expected = heights(after(s, newest, previous, 100), s);
    double worst = 0;
    for (int symmetry = 1; symmetry < 8; ++symmetry) {
      const Field got = heights(after(s, turned(newest, size, symmetry), turned(previous, size, symmetry), 100), s);
      worst = std::max(worst, rms(minus(got, turned(expected, size, symmetry))));
    }
    record(text(s), worst);
    EXPECT_LE(worst, 2 * 2 * step_rounding * ulp_float * growth(s, 100)) << "twice the coherent rounding of water up to 2 high";
  }
}

// What falls on transposed water falls transposed: a size, an axis or an index taken for the other would show.
TEST(WaveSymmetry, WaterThatVariesAlongOneAxisIsTheSameAlongTheOther) {
  const auto along = [](bool x_axis, const Settings& s) {
    const Field line = noise(70, 29, 0.5);
    const auto [width, height] = wave_size(s);
    const Field u = make_field(width, height, [&](int x, int y) { return line[static_cast<std::size_t>(x_axis ? x : y)]; });
    const Field got = heights(after(s, u, u, 60), s);
    return make_field(70, 1, [&, w = width](int i, int) { return got[static_cast<std::size_t>(x_axis ? w + i : i * w + 1)]; });
  };
  for (const Boundary boundary : {Boundary::reflecting, Boundary::periodic}) {
    const Settings wide = as_published(70, 3, 0.98, boundary), tall = as_published(3, 70, 0.98, boundary);
    EXPECT_LE(largest(minus(along(true, wide), along(false, tall))), 2 * step_rounding * ulp_float * growth(wide, 60));
    const Settings wide_corrected = corrected(70, 3, 0.98, 0.6, boundary), tall_corrected = corrected(3, 70, 0.98, 0.6, boundary);
    EXPECT_LE(largest(minus(along(true, wide_corrected), along(false, tall_corrected))),
              2 * step_rounding * ulp_float * growth(wide_corrected, 60));
  }
}

TEST(WaveSymmetry, WaterIsLinearInDouble) {
  const double a = 0.625, b = -0.375;
  for (const Boundary boundary : boundaries) {
    for (const Variant variant : variants) {
      const Settings s = variant == Variant::as_published ? as_published(31, 22, 0.98, boundary) : corrected(31, 22, 0.98, 0.6, boundary);
      const Field f = noise(cells_of(s), 30), f0 = noise(cells_of(s), 31), g = noise(cells_of(s), 32), g0 = noise(cells_of(s), 33);
      const auto mixed = [&](const Field& p, const Field& q) {
        Field out = p;
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = a * p[i] + b * q[i];
        return out;
      };
      OracleWave of_f = oracle_of(s, f, f0), of_g = oracle_of(s, g, g0), of_both = oracle_of(s, mixed(f, g), mixed(f0, g0));
      for (int n = 1; n <= 100; ++n) {
        of_f.step();
        of_g.step();
        of_both.step();
        const Field difference = minus(heights(of_both.newest, s), mixed(heights(of_f.newest, s), heights(of_g.newest, s)));
        // Three waters up to 4 high, weights 1 + 5/8 + 3/8.
        ASSERT_LE(rms(difference), 4 * 2 * step_rounding * ulp_double * growth(s, n)) << text(s) << " step " << n;
      }
    }
  }
}

}  // namespace
}  // namespace rainref::puddle
