// Counts are drawn with the probabilities of Poisson's law.
#include "random/poisson.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error_of.h"
#include "random/counter.h"

namespace rainref::random {
namespace {

constexpr double means[] = {1e-9, 0.001, 0.3, 1, 5.5, 30, 700, 1000, 4000};

/// Words, of all 2^32, that draw at most k: by bisection, since the count rises with the word.
double words_up_to(const PoissonTable& table, int k) {
  std::uint64_t low = 0, high = std::uint64_t{1} << 32;
  while (low < high) {
    const std::uint64_t middle = (low + high) / 2;
    if (table.count(static_cast<std::uint32_t>(middle)) <= k)
      low = middle + 1;
    else
      high = middle;
  }
  return static_cast<double>(low);
}

/// P(N <= k) by the definition, in long double and from the logarithm of each weight.
std::vector<double> distribution(long double mean, int largest) {
  std::vector<double> out;
  long double sum = 0;
  for (int k = 0; k <= largest; ++k) {
    sum += std::exp(k * std::log(mean) - mean - std::lgamma(static_cast<long double>(k) + 1));
    out.push_back(static_cast<double>(sum));
  }
  return out;
}

TEST(PoissonTable, HasTheProbabilitiesOfTheDefinition) {
  for (const double mean : means) {
    const PoissonTable table(mean);
    const std::vector<double> exact = distribution(mean, table.largest());
    for (int k = 0; k <= table.largest(); ++k) {
      const double words = words_up_to(table, k);
      // Thresholds are cut to whole words; the largest count gets what is left.
      ASSERT_NEAR(words, exact[static_cast<std::size_t>(k)] * 0x1p32, 2) << mean << ' ' << k;
    }
    EXPECT_EQ(words_up_to(table, table.largest()), 0x1p32) << mean;
  }
}

TEST(PoissonTable, TheCountRisesWithTheWord) {
  for (const double mean : means) {
    const PoissonTable table(mean);
    int before = table.count(0);
    for (std::uint64_t word = 0; word < std::uint64_t{1} << 32; word += 999983) {
      const int count = table.count(static_cast<std::uint32_t>(word));
      ASSERT_GE(count, before);
      before = count;
    }
    EXPECT_EQ(table.count(0xffffffffu), table.largest()) << mean;
  }
}

TEST(PoissonTable, AMeanOfNothingDrawsNothing) {
  for (const PoissonTable& table : {PoissonTable(), PoissonTable(0), PoissonTable(1e-300)}) {
    for (const std::uint32_t word : {0u, 1u, 0x80000000u, 0xffffffffu}) EXPECT_EQ(table.count(word), 0);
    EXPECT_EQ(table.largest(), 0);
  }
}

TEST(PoissonTable, ATinyMeanDrawsOneOnceInALongTime) {
  const PoissonTable table(1e-9);
  EXPECT_EQ(table.count(0xffffffffu), 1);
  EXPECT_EQ(table.count(0xffffffffu - 5), 0);
  EXPECT_NEAR(words_up_to(table, 0), 0x1p32 * (1 - 1e-9), 1.5);
}

// Ratio of variance and mean: standard deviation sqrt(2 / N). Three of them are left once in 370 times by one mean,
// once in 46 by one of these eight. The mean itself is held to 4 (once in 16 000).
TEST(PoissonTable, VarianceOverMeanIsOne) {
  constexpr int draws = 100000;
  for (const double mean : means) {
    if (mean < 0.0005) continue;
    const PoissonTable table(mean);
    double sum = 0, squares = 0;
    for (std::uint32_t i = 0; i < draws; ++i) {
      const double d = table.count(block(2024, Purpose::puddle_drop_count, i, 0)[0]) - mean;
      sum += d;
      squares += d * d;
    }
    // The variance of the squares of a small mean is larger: (1 + 1 / (2 mean)) times.
    const double spread = std::sqrt((2 + 1 / mean) / draws);
    EXPECT_NEAR(sum / draws, 0, 4 * std::sqrt(mean / draws)) << mean;
    EXPECT_NEAR((squares - sum * sum / draws) / (draws - 1) / mean, 1, 3 * spread) << mean;
    if (mean >= 30) {
      EXPECT_NEAR((squares - sum * sum / draws) / (draws - 1) / mean, 1, 3 * std::sqrt(2.0 / draws)) << mean;
    }
  }
}

TEST(PoissonTable, RefusesMeansOutsideItsRange) {
  for (const double mean :
       {-1e-300, -1.0, 4000.0001, 1e300, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    const std::string error = error_of([&] { const PoissonTable table(mean); });
    EXPECT_TRUE(error.starts_with("2 ") && error.find("expected a number from 0 to 4000") != std::string::npos) << mean << ": " << error;
  }
  EXPECT_NO_THROW(PoissonTable(-0.0));
  EXPECT_NO_THROW(PoissonTable(PoissonTable::max_mean));
}

}  // namespace
}  // namespace rainref::random
