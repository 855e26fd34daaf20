// A product of sizes is exact, or nothing where the type cannot hold it.
#include "base/checked_product.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace rainref {
namespace {

TEST(CheckedProduct, IsTheProductWhereItFits) {
  EXPECT_EQ(checked_product(std::uint32_t{65535}, std::uint32_t{65537}), 0xffffffffu);
  EXPECT_EQ(checked_product(std::uint64_t{1} << 32, std::uint64_t{0xffffffff}), 0xffffffff00000000u);
  EXPECT_EQ(checked_product(0u, 0u), 0u);
  EXPECT_EQ(checked_product(0u, 0xffffffffu), 0u);
  EXPECT_EQ(checked_product(0xffffffffu, 1u), 0xffffffffu);
  EXPECT_EQ(checked_product(3u, 5u, 7u), 105u);
}

// What 32 bits make of the first: 0, which an empty file would hold.
TEST(CheckedProduct, IsNothingWhereItDoesNot) {
  EXPECT_EQ(checked_product(std::uint32_t{65536}, std::uint32_t{65536}), std::nullopt);
  EXPECT_EQ(checked_product(std::uint32_t{65536}, std::uint32_t{65536}, std::uint32_t{4}), std::nullopt);
  EXPECT_EQ(checked_product(std::uint32_t{32768}, std::uint32_t{32768}, std::uint32_t{4}), std::nullopt);
  EXPECT_EQ(checked_product(0x80000000u, 2u), std::nullopt);
  EXPECT_EQ(checked_product(std::uint64_t{1} << 32, std::uint64_t{1} << 32), std::nullopt);
}

// All pairs of a small type, against the arithmetic of a larger one.
TEST(CheckedProduct, AllPairsOfBytes) {
  for (unsigned a = 0; a < 256; ++a) {
    for (unsigned b = 0; b < 256; ++b) {
      const auto found = checked_product(static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b));
      ASSERT_EQ(found.has_value(), a * b < 256) << a << " * " << b;
      if (found) {
        ASSERT_EQ(*found, a * b);
      }
    }
  }
}

}  // namespace
}  // namespace rainref
