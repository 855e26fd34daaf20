// PNG of our own, read by libpng.
#include "image_io/png_write.h"

#include <gmock/gmock.h>

#include <random>

#include "image_io/read.h"
#include "image_io/tiny_files.h"

namespace rainref::image_io {
namespace {

Picture read_back(const std::vector<std::byte>& file) {
  const TemporaryFolder folder;
  put(folder / "a.png", std::string(reinterpret_cast<const char*>(file.data()), file.size()));
  return read(folder / "a.png");
}
/// Codes in columns that repeat with a period, and some at random among them: repeats of many lengths and distances.
std::vector<std::byte> texels_of(std::size_t count, unsigned period, unsigned noise, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::byte> out(count);
  for (std::size_t k = 0; k < count; ++k) out[k] = static_cast<std::byte>(noise > 0 && random() % noise == 0 ? random() : k % period);
  return out;
}
void expect_same(const Picture& p, const std::vector<std::byte>& texels, std::size_t channels) {
  std::size_t k = 0;
  for (int y = 0; y < p.file_height; ++y)
    for (int x = 0; x < p.file_width; ++x)
      for (std::size_t c = 0; c < channels; ++c, ++k)
        ASSERT_EQ((texel<std::uint8_t>(p.image, x, y)[c]), std::to_integer<int>(texels[k])) << x << ' ' << y << ' ' << c;
}

TEST(PngWrite, LibpngReadsTheSameTexels) {
  unsigned seed = 0;
  for (const std::size_t channels : {3, 4}) {
    for (const auto& [width, height] : {std::pair<std::size_t, std::size_t>{1, 1}, {2, 1}, {1, 9}, {35, 21}, {257, 3}, {400, 300}}) {
      for (const auto& [period, noise] : {std::pair{1u, 0u}, {7u, 0u}, {251u, 5u}, {256u, 1u}, {1200u, 40u}}) {
        const std::vector<std::byte> texels = texels_of(width * height * channels, period, noise, ++seed);
        const Picture p = read_back(png_file(width, height, channels, texels, false));
        ASSERT_EQ(p.file_width, static_cast<int>(width));
        ASSERT_EQ(p.file_height, static_cast<int>(height));
        ASSERT_EQ(p.channel_names.size(), channels);
        expect_same(p, texels, channels);
      }
    }
  }
}
TEST(PngWrite, ARepeatFromFurtherThanTheWindowIsNotTaken) {
  // A row of noise, 40 000 bytes of another, and the first again.
  std::vector<std::byte> texels = texels_of(std::size_t{4} * 10000 * 3, 256, 1, 5);
  std::copy_n(texels.begin(), 40000, texels.begin() + 80000);
  expect_same(read_back(png_file(10000, 3, 4, texels, false)), texels, 4);
}
TEST(PngWrite, PicturesThatRepeatAreSmall) {
  EXPECT_LT(png_file(400, 300, 3, texels_of(400 * 300 * 3, 1, 0, 1), false).size(), 3000u);
  EXPECT_LT(png_file(400, 300, 3, texels_of(400 * 300 * 3, 7, 0, 1), false).size(), 6000u);
}

}  // namespace
}  // namespace rainref::image_io
