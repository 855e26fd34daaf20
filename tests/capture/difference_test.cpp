// The first difference of two arrays is named with its place and both values; equal bits have none.
#include "capture/difference.h"

#include <gtest/gtest.h>

#include <cstring>

namespace rainref::capture {
namespace {

Array zeros(Format format, int width, int height) {
  Array a;
  a.format = format;
  a.width = width;
  a.height = height;
  a.levels.emplace_back(static_cast<std::size_t>(width) * height * a.element_bytes());
  return a;
}
template <class T>
void set(Array& a, std::size_t level, std::size_t index, T value) {
  std::memcpy(a.levels[level].edit().data() + index * sizeof value, &value, sizeof value);
}

TEST(FirstDifference, NoneForEqualBits) {
  const Array a = zeros(Format::rg16f, 3, 2);
  EXPECT_FALSE(first_difference(a, a));
}

TEST(FirstDifference, NamesPlaceAndBothValues) {
  const Array a = zeros(Format::rg16f, 3, 2);
  Array b = a;
  set<std::uint16_t>(b, 0, (1 * 3 + 2) * 2 + 1, 0x3400);
  auto d = first_difference(a, b);
  ASSERT_TRUE(d);
  EXPECT_EQ(d->place, "x 2, y 1, channel 1");
  EXPECT_EQ(d->a, "0 0x0000");
  EXPECT_EQ(d->b, "0.25 0x3400");
  EXPECT_EQ(d->count, 1u);
  EXPECT_EQ(d->of, 12u);
  set<std::uint16_t>(b, 0, 4, 0x8000);  // minus zero is another value
  d = first_difference(a, b);
  EXPECT_EQ(d->place, "x 2, y 0, channel 0");
  EXPECT_EQ(d->b, "-0 0x8000");
  EXPECT_EQ(d->count, 2u);
}

TEST(FirstDifference, EveryFormatSaysDecimalAndBits) {
  const auto text = [](Format format, auto value) {
    const Array a = zeros(format, 1, 1);
    Array b = a;
    set(b, 0, 0, value);
    return first_difference(a, b)->b;
  };
  EXPECT_EQ(text(Format::r8, std::uint8_t{51}), "0.2 0x33");
  EXPECT_EQ(text(Format::r32f, 0.1f), "0.1 0x3dcccccd");
  EXPECT_EQ(text(Format::r32f, std::uint32_t{0x7fc00000}), "nan 0x7fc00000");
  EXPECT_EQ(text(Format::r32ui, std::uint32_t{7}), "7 0x00000007");
}

TEST(FirstDifference, LevelsAndRecords) {
  Array a = zeros(Format::r32f, 4, 4);
  a.levels.emplace_back(2 * 2 * 4);
  Array b = a;
  set(b, 1, 3, 1.0f);
  EXPECT_EQ(first_difference(a, b)->place, "level 1, x 1, y 1, channel 0");
  EXPECT_EQ(first_difference(a, b)->of, 20u);

  Array c;
  c.is_records = true;
  c.record = {"Drop", 16, {{"x", scene::Scalar::float32, 2, 0, "m", "X."}, {"id", scene::Scalar::int32, 1, 12, "1", "Id."}}};
  c.width = 3;
  c.height = 1;
  c.levels.emplace_back(48);
  Array d = c;
  set<std::int32_t>(d, 0, 4 + 3, -2);
  EXPECT_EQ(first_difference(c, d)->place, "record 1, field id");
  EXPECT_EQ(first_difference(c, d)->b, "-2 0xfffffffe");
  set(d, 0, 4 + 1, 2.0f);
  EXPECT_EQ(first_difference(c, d)->place, "record 1, field x[1]");
}

TEST(SameShape, FormatSizeAndLevels) {
  const Array a = zeros(Format::r32f, 4, 2);
  EXPECT_TRUE(same_shape(a, a));
  EXPECT_FALSE(same_shape(a, zeros(Format::r32f, 2, 4)));
  EXPECT_FALSE(same_shape(a, zeros(Format::r32ui, 4, 2)));
  EXPECT_EQ(shape_text(a), "r32f 4x2");
}

}  // namespace
}  // namespace rainref::capture
