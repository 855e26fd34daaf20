// Memory of pictures: zeroed whatever was there before, whole, and two blocks that are used together begin unlike.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

#include "base/zeroed.h"

namespace rainref::zeroed {
namespace {

constexpr std::size_t mebibyte = std::size_t{1} << 20;

TEST(Zeroed, EveryByteIsThereAndZero) {
  for (const std::size_t bytes : {std::size_t{1}, std::size_t{63}, std::size_t{4096}, mebibyte - 1, mebibyte, mebibyte + 1,
                                  2 * mebibyte - 1, 2 * mebibyte, 2 * mebibyte + 4095, 5 * mebibyte + 17}) {
    for (int go = 0; go < 3; ++go) {
      std::byte* const memory = take(bytes);
      ASSERT_NE(memory, nullptr) << bytes;
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory) % 64, 0u) << bytes;
      EXPECT_TRUE(std::all_of(memory, memory + bytes, [](std::byte b) { return b == std::byte{0}; })) << bytes;
      std::fill_n(memory, bytes, std::byte{0xa5});
      give_back(memory, bytes);
    }
  }
}

TEST(Zeroed, WhatCannotBeHadIsRefused) { EXPECT_EQ(take(SIZE_MAX / 4), nullptr); }

TEST(Zeroed, LargeBlocksBeginUnlike) {
  std::vector<std::byte*> blocks;
  std::set<std::uintptr_t> begins;  // in their pages of 4096 bytes
  for (int k = 0; k < 4; ++k) {
    blocks.push_back(take(4 * mebibyte));
    begins.insert(reinterpret_cast<std::uintptr_t>(blocks.back()) % 4096);
  }
  EXPECT_EQ(begins.size(), blocks.size());
  for (std::byte* block : blocks) give_back(block, 4 * mebibyte);
}

TEST(Zeroed, AnArrayGrowsWithZeros) {
  Array<float> numbers(3, 1.5f);
  numbers.resize(2 * mebibyte);
  EXPECT_EQ(numbers[2], 1.5f);
  EXPECT_TRUE(std::all_of(numbers.begin() + 3, numbers.end(), [](float x) { return x == 0; }));
}

TEST(Zeroed, AWishForLargePagesChangesNoByte) {
  std::vector<unsigned char> bytes(9 * mebibyte);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<unsigned char>(i % 251);
  for (const std::size_t from : {std::size_t{0}, std::size_t{1}, mebibyte, 2 * mebibyte + 3})
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, mebibyte, 2 * mebibyte, 4 * mebibyte - 1, 5 * mebibyte})
      prefer_large_pages(bytes.data() + from, count);
  for (std::size_t i = 0; i < bytes.size(); ++i) ASSERT_EQ(bytes[i], i % 251) << i;
}

}  // namespace
}  // namespace rainref::zeroed
