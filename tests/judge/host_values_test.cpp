// What a host in floats may give in place of the scene's numbers.
#include "judge/host_values.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "math/half.h"

namespace rainref::judge {
namespace {

using capture::Array;

Likeness compared(std::vector<float> expected, std::vector<float> given, std::optional<scene::Range> range = std::nullopt) {
  const scene::Member m{"m", scene::Scalar::float32, static_cast<int>(expected.size()), 0, "1", "", range};
  return compare_member(m, reinterpret_cast<const std::byte*>(expected.data()), reinterpret_cast<const std::byte*>(given.data()));
}

// Both sides of 2^-18 of the value.
TEST(HostValues, ANumberMayBeRoundedOtherwise) {
  EXPECT_EQ(compared({0.9972f}, {0.9972f}), Likeness::same);
  EXPECT_EQ(compared({1.0f}, {1.0f + 0x1p-20f}), Likeness::rounded);
  EXPECT_EQ(compared({1.0f}, {1.0f - 0x1p-18f}), Likeness::rounded);
  EXPECT_EQ(compared({1.0f}, {1.0f + 0x1.1p-18f}), Likeness::other);
  EXPECT_EQ(compared({1e-9f}, {1e-9f * (1 + 0x1p-20f)}), Likeness::rounded);
  EXPECT_EQ(compared({1e-9f}, {2e-9f}), Likeness::other);
  EXPECT_EQ(compared({1.0f}, {std::nanf("")}), Likeness::other);
  EXPECT_EQ(compared({0.0f}, {-0.0f}), Likeness::rounded);
}
// A vector's components are mixed by rotations: their errors are those of the largest.
TEST(HostValues, AVectorIsComparedByItsLargest) {
  EXPECT_EQ(compared({4.0f, 1e-6f, 0.0f}, {4.0f, 9e-6f, -1e-5f}), Likeness::rounded);
  EXPECT_EQ(compared({4.0f, 1e-6f, 0.0f}, {4.0f, 1e-6f, 2e-5f}), Likeness::other);
}
// cos(pi / 2) in float is no zero. Of what cannot be negative a zero is a zero.
TEST(HostValues, AZeroBetweenBothSignsHasAFloor) {
  const float cosine = std::cos(1.57079637f);
  EXPECT_NE(cosine, 0);
  EXPECT_EQ(compared({0.0f}, {cosine}, scene::component), Likeness::rounded);
  EXPECT_EQ(compared({0.0f}, {3e-7f}, scene::component), Likeness::other);
  EXPECT_EQ(compared({0.0f}, {1e-12f}, scene::share), Likeness::other);
}
TEST(HostValues, IntegersAreExact) {
  const scene::Member m{"m", scene::Scalar::int32, 1, 0, "1", "", std::nullopt};
  const std::int32_t a = 1000000, b = 1000001;
  EXPECT_EQ(compare_member(m, reinterpret_cast<const std::byte*>(&a), reinterpret_cast<const std::byte*>(&a)), Likeness::same);
  EXPECT_EQ(compare_member(m, reinterpret_cast<const std::byte*>(&a), reinterpret_cast<const std::byte*>(&b)), Likeness::other);
}

Array image(Format format, std::initializer_list<int> bytes) {
  Array a;
  a.format = format;
  a.width = static_cast<int>(bytes.size()) / info(format).texel_bytes();
  a.height = 1;
  a.levels.emplace_back();
  for (const int b : bytes) a.levels[0].edit().push_back(static_cast<std::byte>(b));
  return a;
}
TEST(HostValues, ATexelMayBeTheNeighbouringCode) {
  const Array a = image(Format::rgba8, {10, 20, 30, 255, 0, 0, 0, 255});
  EXPECT_EQ(compare_arrays(a, a), Likeness::same);
  EXPECT_EQ(compare_arrays(a, image(Format::rgba8, {11, 19, 30, 255, 0, 1, 0, 255})), Likeness::rounded);
  EXPECT_EQ(compare_arrays(a, image(Format::rgba8, {12, 20, 30, 255, 0, 0, 0, 255})), Likeness::other);
  EXPECT_EQ(compare_arrays(a, image(Format::rgba8, {10, 20, 30, 255})), Likeness::other) << "another size";
  const Array half = image(Format::r16f, {0x00, 0x3c});
  EXPECT_EQ(compare_arrays(half, image(Format::r16f, {0x01, 0x3c})), Likeness::rounded);
  EXPECT_EQ(compare_arrays(half, image(Format::r16f, {0x02, 0x3c})), Likeness::other);
  EXPECT_EQ(compare_arrays(half, image(Format::r16f, {0x01, 0x7e})), Likeness::other) << "no number";
}
// Lists of records with ids have no order.
TEST(HostValues, ASetOfRecordsHasNoOrder) {
  Array list;
  list.is_records = true;
  list.record = {"Drop", 8, {{"id", scene::Scalar::uint32, 1, 0, "1", ""}, {"mass", scene::Scalar::float32, 1, 4, "kg", ""}}};
  list.width = 2;
  list.height = 1;
  const auto with = [&](std::initializer_list<std::pair<std::uint32_t, float>> records) {
    Array out = list;
    out.levels.emplace_back(16);
    std::size_t at = 0;
    for (const auto& [id, mass] : records) {
      std::memcpy(&out.levels[0].edit()[at], &id, 4);
      std::memcpy(&out.levels[0].edit()[at + 4], &mass, 4);
      at += 8;
    }
    return out;
  };
  EXPECT_EQ(compare_arrays(with({{1, 2.0f}, {2, 3.0f}}), with({{2, 3.0f}, {1, 2.0f}})), Likeness::same);
  Array none = list, one = with({{0, 0.0f}});
  none.width = 0;
  none.levels = {{}};
  one.width = 1;
  one.levels[0].edit().resize(8);
  EXPECT_EQ(compare_arrays(none, one), Likeness::same);
  one.levels[0].edit()[4] = std::byte{1};
  EXPECT_EQ(compare_arrays(none, one), Likeness::other);
  EXPECT_EQ(compare_arrays(with({{1, 2.0f}, {2, 3.0f}}), with({{1, 2.0f + 0x1p-18f}, {2, 3.0f}})), Likeness::rounded);
  EXPECT_EQ(compare_arrays(with({{1, 2.0f}, {2, 3.0f}}), with({{1, 2.1f}, {2, 3.0f}})), Likeness::other);
}

}  // namespace
}  // namespace rainref::judge
