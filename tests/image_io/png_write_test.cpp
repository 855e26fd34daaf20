// PNG is written without OpenImageIO; libpng, through it, reads the same texels.
#include <gmock/gmock.h>

#include <random>

#include "image_io/read.h"
#include "image_io/tiny_files.h"
#include "image_io/write.h"

namespace rainref::image_io {
namespace {

/// Codes in columns that repeat with a period, and some at random among them.
Image codes(int width, int height, int period, unsigned noise, unsigned seed) {
  std::mt19937 random(seed);
  return make_image(Format::rgba8, width, height, [&](int x, int, int c) {
    return Unorm8{static_cast<std::uint8_t>(noise > 0 && random() % noise == 0 ? random() : static_cast<unsigned>((4 * x + c) % period))};
  });
}

TEST(PngWrite, LibpngReadsTheSameTexels) {
  const TemporaryFolder folder;
  unsigned seed = 0;
  for (const PngChannels channels : {PngChannels::rgb, PngChannels::rgba}) {
    const int count = channels == PngChannels::rgb ? 3 : 4;
    // The largest with noise alone fills several chunks.
    for (const auto& [width, height] : {std::pair{1, 1}, {2, 1}, {1, 9}, {35, 21}, {257, 3}, {400, 300}}) {
      for (const auto& [period, noise] : {std::pair{1, 0u}, {7, 0u}, {251, 5u}, {256, 1u}, {1200, 40u}}) {
        const Image image = codes(width, height, period, noise, ++seed);
        write_png(folder / "a.png", image, channels);
        const Picture p = read(folder / "a.png");
        ASSERT_EQ(p.file_width, width);
        ASSERT_EQ(p.file_height, height);
        ASSERT_EQ(p.channel_names.size(), static_cast<std::size_t>(count));
        for (int y = 0; y < height; ++y)
          for (int x = 0; x < width; ++x)
            for (int c = 0; c < count; ++c)
              ASSERT_EQ(texel<std::uint8_t>(p.image, x, y)[c], texel<std::uint8_t>(image, x, y)[c]) << x << ' ' << y << ' ' << c;
      }
    }
  }
}
TEST(PngWrite, FlatAndSmoothPicturesAreSmall) {
  EXPECT_LT(png_bytes(codes(400, 300, 1, 0, 1)).size(), 3000u);
  const auto smooth = [](int x, int y, int c) { return Unorm8{static_cast<std::uint8_t>((x + y) / 3 + c)}; };
  // The filter leaves zeros and ones: a bit for each, the least that a Huffman code has, and 1 000 bytes for all else.
  EXPECT_LT(png_bytes(make_image(Format::rgba8, 400, 300, smooth)).size(), std::size_t{400} * 300 * 3 / 8 + 1000);
}

}  // namespace
}  // namespace rainref::image_io
