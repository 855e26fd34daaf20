// Random numbers are functions of their counters: known answers, even, without collisions.
#include "random/counter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <set>

#include "random/draws.h"
#include "random/statistics.h"

namespace rainref::random {
namespace {

using test::cell_of;
using test::chi_square;
using test::chi_square_99_high;
using test::chi_square_99_low;
using test::lag_correlation;

/// pcg4d written out again, in 64-bit arithmetic with an explicit remainder modulo 2^32.
Block pcg4d_by_remainders(Block in) {
  constexpr std::uint64_t m = std::uint64_t{1} << 32;
  std::uint64_t x = in[0], y = in[1], z = in[2], w = in[3];
  for (std::uint64_t* v : {&x, &y, &z, &w}) *v = (*v * 1664525 % m + 1013904223) % m;
  for (int round = 0; round < 2; ++round) {
    x = (x + y * w % m) % m;
    y = (y + z * x % m) % m;
    z = (z + x * y % m) % m;
    w = (w + y * z % m) % m;
    if (round == 0) {
      for (std::uint64_t* v : {&x, &y, &z, &w}) *v ^= *v / 65536;
    }
  }
  return {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(z), static_cast<std::uint32_t>(w)};
}

// What the diagnosis changes one thing of is the hash itself where nothing is changed.
TEST(Mixing, WithoutAMistakeIsTheBlockOfTheCounter) {
  Block v{1, 2, 3, 4};
  for (int k = 0; k < 2000; ++k) {
    v = pcg4d({v[0], v[1] + 1, v[2], v[3]});
    ASSERT_EQ(Mixing{}.hashed(v), pcg4d(v));
    const std::uint64_t seed = v[0] | std::uint64_t{v[1]} << 32;
    ASSERT_EQ(Mixing{}.block(seed, Purpose::screen_drop, v[2], v[3]), block(seed, Purpose::screen_drop, v[2], v[3]));
  }
}

// The paper prints no numbers. These were computed from its listing with Python's unbounded integers.
TEST(Pcg4d, GivesKnownAnswers) {
  const struct {
    Block in, out;
  } known[] = {{{0, 0, 0, 0}, {0x0f02f829u, 0x2d568769u, 0x32b0c43bu, 0xd32548eau}},
               {{1, 0, 0, 0}, {0x0b3cefc3u, 0xa31dc1d5u, 0x5ffbe5a5u, 0x623d099eu}},
               {{0, 1, 0, 0}, {0x2a9d71a8u, 0xa13cdd97u, 0xe9c89c0eu, 0xc4b7884cu}},
               {{0, 0, 1, 0}, {0x2eda6c9du, 0x681d2eedu, 0x306c117du, 0xb0607dceu}},
               {{0, 0, 0, 1}, {0x8d9effe2u, 0xa833f3dcu, 0x8246b1b2u, 0x58ab6650u}},
               {{1, 2, 3, 4}, {0x3622cd16u, 0xf11471d8u, 0xe1109b3fu, 0x02b94c2fu}},
               {{~0u, ~0u, ~0u, ~0u}, {0x974ed892u, 0xc015dc67u, 0x9f955760u, 0xa1bba208u}},
               {{0xdeadbeefu, 0x12345678u, 0x9abcdef0u, 0x0f1e2d3cu}, {0xabd94eb7u, 0x6c043755u, 0x128c283bu, 0x544a1bcau}}};
  for (const auto& k : known) EXPECT_EQ(pcg4d(k.in), k.out);
  static_assert(pcg4d({0, 0, 0, 0})[0] == 0x0f02f829u, "it is a constant expression");
}

TEST(Pcg4d, AgreesWithItsTranscription) {
  Block v{1, 2, 3, 4};
  for (int i = 0; i < 20000; ++i) {
    ASSERT_EQ(pcg4d(v), pcg4d_by_remainders(v)) << i;
    v = pcg4d({v[3], v[0], v[1], v[2] + static_cast<std::uint32_t>(i)});
  }
}

// A permutation of 128 bits: no two counters give one block.
TEST(Pcg4d, NeighbouringCountersNeverCollide) {
  std::set<Block> blocks;
  for (std::uint32_t a = 0; a < 100; ++a)
    for (std::uint32_t b = 0; b < 100; ++b) blocks.insert(pcg4d({a, b, 0, 0}));
  EXPECT_EQ(blocks.size(), 10000u);
}

/// Share of bits that differ between two blocks.
int different_bits(const Block& a, const Block& b) {
  int sum = 0;
  for (std::size_t i = 0; i < 4; ++i) sum += std::popcount(a[i] ^ b[i]);
  return sum;
}

// For independent blocks the mean of 128-bit differences over n pairs is 64 with standard deviation sqrt(32 / n); the
// bound of 5 of them is left once in 2 million times.
template <class F>
void expect_half_of_the_bits(F other) {
  constexpr int n = 2000;
  double sum = 0;
  for (std::uint32_t i = 0; i < n; ++i) sum += different_bits(block(1, Purpose::puddle_drop, i, 7), other(i));
  EXPECT_NEAR(sum / n, 64, 5 * std::sqrt(32.0 / n));
}

TEST(Block, ChangesAltogetherWithAnyPartOfItsKey) {
  expect_half_of_the_bits([](std::uint32_t i) { return block(1, Purpose::puddle_drop, i + 1, 7); });
  expect_half_of_the_bits([](std::uint32_t i) { return block(1, Purpose::puddle_drop, i, 8); });
  expect_half_of_the_bits([](std::uint32_t i) { return block(2, Purpose::puddle_drop, i, 7); });
  expect_half_of_the_bits([](std::uint32_t i) { return block(1 + (std::uint64_t{1} << 32), Purpose::puddle_drop, i, 7); });
  expect_half_of_the_bits([](std::uint32_t i) { return block(1 + (std::uint64_t{1} << 63), Purpose::puddle_drop, i, 7); });
  expect_half_of_the_bits([](std::uint32_t i) { return block(1, Purpose::puddle_bed, i, 7); });
  expect_half_of_the_bits([](std::uint32_t i) { return block(1, Purpose::puddle_drop, 7, i); });
}

TEST(Block, IsAFunctionOfItsKeyAlone) {
  EXPECT_EQ(block(5, Purpose::puddle_drop, 1, 2), block(5, Purpose::puddle_drop, 1, 2));
  EXPECT_NE(block(5, Purpose::puddle_drop, 1, 2), block(5, Purpose::puddle_drop, 2, 1));
}

TEST(Uniform, HasEqualSpacingAndNeverReachesOne) {
  EXPECT_EQ(uniform(0), 0.0f);
  EXPECT_EQ(uniform(255), 0.0f);
  EXPECT_EQ(uniform(256), 0x1p-24f);
  EXPECT_EQ(uniform(0x80000000u), 0.5f);
  EXPECT_EQ(uniform(0xffffffffu), 1.0f - 0x1p-24f);
  for (std::uint32_t k = 0; k < 0xffffffu; k += 257) {
    ASSERT_EQ(uniform((k + 1) << 8) - uniform(k << 8), 0x1p-24f);  // the difference of neighbours is exact
    ASSERT_EQ(static_cast<double>(uniform(k << 8)), k / 16777216.0);
  }
}

// --- As the drops use it: place of drop i of step n ------------------------------------------------------------------

// 36 grids of 20 000 places. Chi-square bounds of statistics.h: a fair generator fails one of them once in 140 times.
TEST(PlacesOfDrops, FillTheSquareEvenlyEarlyAndLate) {
  for (const std::uint32_t first : {0u, 100000u, 1000000u, 4294900000u}) {
    for (std::uint32_t i = 0; i < 9; ++i) {
      std::vector<int> cells(100);
      for (std::uint32_t n = first; n != first + 20000; ++n) {
        const Block r = block(1, Purpose::puddle_drop, n, i);
        ++cells[cell_of(uniform(r[0]), uniform(r[1]))];
      }
      EXPECT_LT(chi_square(cells), chi_square_99_high) << first << ' ' << i;
      EXPECT_GT(chi_square(cells), chi_square_99_low) << first << ' ' << i;
    }
  }
}

// A million places: the grid shows a cell that is off by 5 % with certainty. False alarms once in 5000 times.
TEST(PlacesOfDrops, FillTheSquareEvenlyInTheLongRun) {
  std::vector<int> cells(100), across_words(100);
  for (std::uint32_t n = 0; n < 1000000; ++n) {
    const Block r = block(99, Purpose::puddle_drop, n, 0);
    ++cells[cell_of(uniform(r[0]), uniform(r[1]))];
    ++across_words[cell_of(uniform(r[2]), uniform(r[3]))];
  }
  for (const auto& grid : {cells, across_words}) {
    EXPECT_LT(chi_square(grid), chi_square_99_high);
    EXPECT_GT(chi_square(grid), chi_square_99_low);
  }
}

// Standard deviation 0.001; the bound of 5 of them is left once in 2 million times.
TEST(PlacesOfDrops, DoNotDependOnTheOnesBefore) {
  for (const std::size_t word : {0u, 1u, 2u, 3u}) {
    std::vector<float> steps, drops;
    for (std::uint32_t n = 0; n < 1000000; ++n) {
      steps.push_back(uniform(block(1, Purpose::puddle_drop, n, 0)[word]));
      drops.push_back(uniform(block(1, Purpose::puddle_drop, 17, n)[word]));
    }
    for (const std::size_t lag : {1u, 2u, 10u}) {
      EXPECT_LT(std::fabs(lag_correlation(steps, lag)), 0.005) << word << ' ' << lag;
      EXPECT_LT(std::fabs(lag_correlation(drops, lag)), 0.005) << word << ' ' << lag;
    }
  }
}

// Two of a million 64-bit places are equal by chance once in 37 million times.
TEST(PlacesOfDrops, NeverComeBack) {
  std::vector<std::uint64_t> places;
  for (std::uint32_t n = 0; n < 1000000; ++n) {
    const Block r = block(1, Purpose::puddle_drop, n, 0);
    places.push_back(std::uint64_t{r[0]} << 32 | r[1]);
  }
  for (std::size_t n = 0; n + 10000 < places.size(); ++n) ASSERT_NE(places[n], places[n + 10000]);
  std::sort(places.begin(), places.end());
  EXPECT_EQ(std::adjacent_find(places.begin(), places.end()), places.end());
}

TEST(PlacesOfDrops, TheFirstIsNotTheCorner) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Block r = block(seed, Purpose::puddle_drop, 0, 0);
    EXPECT_TRUE(uniform(r[0]) > 0 && uniform(r[1]) > 0) << seed;
  }
}

}  // namespace
}  // namespace rainref::random
