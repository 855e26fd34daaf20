// What is written is NumPy's own format, and reads back in every storage format.
#include "capture/npy_write.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/npy_read.h"

namespace rainref::capture {
namespace {

Array image(Format format, int width, int height) {
  Array a;
  a.format = format;
  a.width = width;
  a.height = height;
  std::vector<std::byte>& data = a.levels.emplace_back(static_cast<std::size_t>(width) * height * a.element_bytes()).edit();
  for (std::size_t i = 0; i < data.size(); ++i) data[i] = static_cast<std::byte>(i * 7 + 1);
  return a;
}

std::string text(const std::vector<std::byte>& bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

// Byte for byte as numpy.save writes it.
TEST(NpyWrite, IsNumpysFormat) {
  const std::string dict = "{'descr': '<f2', 'fortran_order': False, 'shape': (2, 3, 4), }";
  const std::string expected = std::string("\x93NUMPY\x01\x00\x76\x00", 10) + dict + std::string(128 - 10 - dict.size() - 1, ' ') + "\n";
  const Array a = image(Format::rgba16f, 3, 2);
  EXPECT_EQ(text(npy_bytes(a, 0)), expected + text(a.levels[0]));
}

TEST(NpyWrite, EveryFormatReadsBack) {
  for (int f = 0; f <= static_cast<int>(Format::r32ui); ++f) {
    const Format format = static_cast<Format>(f);
    const Array a = image(format, 5, 3);
    const std::vector<std::byte> file = npy_bytes(a, 0);
    const NpyHeader h = parse_npy_header(file, "x.npy");
    const FormatInfo& i = info(format);
    EXPECT_EQ(h.type, i.channel_bytes == 1 ? "|u1" : i.channel_bytes == 2 ? "<f2" : i.kind == FormatInfo::uint32 ? "<u4" : "<f4") << i.name;
    std::vector<std::size_t> shape{3, 5};
    if (i.channels > 1) shape.push_back(static_cast<std::size_t>(i.channels));
    EXPECT_EQ(h.shape, shape) << i.name;
    EXPECT_EQ(h.data_offset % 64, 0u);
    EXPECT_EQ(std::vector(file.begin() + static_cast<std::ptrdiff_t>(h.data_offset), file.end()), a.levels[0]);
  }
}

TEST(NpyWrite, LevelsHaveTheirOwnSize) {
  Array a = image(Format::r32f, 5, 3);
  a.levels.emplace_back(2 * 1 * 4);
  a.levels.emplace_back(1 * 1 * 4);
  EXPECT_EQ(parse_npy_header(npy_bytes(a, 1), "x").shape, (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(parse_npy_header(npy_bytes(a, 2), "x").shape, (std::vector<std::size_t>{1, 1}));
}

TEST(NpyWrite, RecordsHaveNamedFieldsAndNamelessGaps) {
  Array a;
  a.is_records = true;
  a.record = {"Drop",
              32,
              {{"x", scene::Scalar::float32, 1, 0, "m", "X."},
               {"v", scene::Scalar::float32, 2, 8, "m", "V."},
               {"id", scene::Scalar::uint32, 1, 20, "1", "Id."}}};
  a.width = 2;
  a.height = 1;
  a.levels.emplace_back(64);
  const std::vector<std::byte> file = npy_bytes(a, 0);
  EXPECT_THAT(text(file),
              testing::HasSubstr("'descr': [('x', '<f4'), ('', '|V4'), ('v', '<f4', (2,)), ('', '|V4'), ('id', '<u4'), ('', '|V8')], "));
  const NpyHeader h = parse_npy_header(file, "x");
  ASSERT_EQ(h.fields.size(), 3u);
  EXPECT_EQ(h.fields[1].name, "v");
  EXPECT_EQ(h.fields[1].offset, 8u);
  EXPECT_EQ(h.fields[1].components, 2u);
  EXPECT_EQ(h.fields[2].offset, 20u);
  EXPECT_EQ(h.record_bytes, 32u);
  a.width = 0;
  a.levels[0].edit().clear();
  EXPECT_EQ(parse_npy_header(npy_bytes(a, 0), "x").shape, std::vector<std::size_t>{0});
}

}  // namespace
}  // namespace rainref::capture
