// Copies of a buffer share its bytes until one of them is written, and nobody sees what another copy writes.
#include "capture/bytes.h"

#include <cstring>

#include <gtest/gtest.h>

#include "capture/bound_texture.h"

namespace rainref::capture {
namespace {

TEST(Bytes, CopiesShareUntilOneIsWritten) {
  Bytes first(std::vector<std::byte>(8, std::byte{1}));
  const Bytes second = first;
  EXPECT_TRUE(first.shares(second));
  first.edit()[3] = std::byte{2};
  EXPECT_FALSE(first.shares(second));
  EXPECT_EQ(second[3], std::byte{1});
  EXPECT_EQ(first[3], std::byte{2});
  EXPECT_FALSE(first == second);
  const std::byte* const own = first.data();
  first.edit()[3] = std::byte{1};
  EXPECT_EQ(first.data(), own) << "what nobody shares is written in place";
  EXPECT_TRUE(first == second) << "equal by value";
}
TEST(Bytes, ThereMayBeNone) {
  Bytes none;
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(none.begin(), none.end());
  EXPECT_TRUE(none == Bytes(std::size_t{0}));
  none.edit().resize(2);
  EXPECT_EQ(none.size(), 2u);
}

/// An image of 512 x 256 floats, large enough to be shared.
CaseInput image() {
  CaseInput input;
  input.array.format = Format::r32f;
  input.array.width = 512;
  input.array.height = 256;
  input.array.levels.emplace_back(std::size_t{4} * 512 * 256);
  return input;
}
void put(CaseInput& input, float v) { std::memcpy(input.array.levels[0].edit().data(), &v, sizeof v); }

TEST(Bytes, CopiesAreDecodedOnce) {
  CaseInput input = image();
  put(input, 1);
  const BoundTexture bound(input);
  const CaseInput copy = input;
  EXPECT_EQ(BoundTexture(copy).view().texels, bound.view().texels);
  EXPECT_EQ(shared_decoded(copy.array).get(), shared_decoded(input.array).get());
}
// What was decoded holds its bytes: an image that is written after that is another, at the same address or not.
TEST(Bytes, WhatIsWrittenIsDecodedAnew) {
  CaseInput input = image();
  put(input, 1);
  const BoundTexture bound(input);
  put(input, 2);
  const BoundTexture again(input);
  EXPECT_EQ(bound.view().texels[0], 1);
  EXPECT_EQ(again.view().texels[0], 2);
  for (int k = 0; k < 100; ++k) {
    CaseInput other = image();
    put(other, static_cast<float>(k));
    EXPECT_EQ(BoundTexture(other).view().texels[0], static_cast<float>(k));
  }
}
// Its first level alone does not tell an image.
TEST(Bytes, EveryLevelCounts) {
  CaseInput input = image();
  input.array.levels.emplace_back(std::size_t{4} * 256 * 128);
  const BoundTexture bound(input);
  CaseInput other = input;
  const float v = 3;
  std::memcpy(other.array.levels[1].edit().data(), &v, sizeof v);
  const BoundTexture again(other);
  EXPECT_EQ(bound.view().texels[512 * 256], 0);
  EXPECT_EQ(again.view().texels[512 * 256], 3);
}

}  // namespace
}  // namespace rainref::capture
