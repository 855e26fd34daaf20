// A tabulated display gives the codes of the pass.
#include "image/code_table.h"

#include <gtest/gtest.h>

#include "image/images.h"
#include "math/half.h"
#include "math/unorm.h"

namespace rainref {
namespace {

Unorm8 code_of(Half h) { return to_unorm8(to_float(h) * 0.75f, Rounding::rne); }

// Every finite half, in each channel and at more than one place of a picture.
TEST(CodeTable, GivesThePassesCodes) {
  const auto pass = [](const Image& colour, Image& picture, int y0, int y1) {
    for (int y = y0; y < y1; ++y) {
      for (int x = 0; x < 4 * colour.width(); ++x) {
        const Half h = colour.row<Half>(y)[x];
        picture.row<Unorm8>(y)[x] = x % 4 == 3 ? Unorm8{255} : (h.bits & 0x7c00u) == 0x7c00u ? Unorm8{7} : code_of(h);
      }
    }
  };
  int runs = 0;
  const CodeTable table(97, 676, [&](const Image& c, Image& p, int y0, int y1) {
    ++runs;
    pass(c, p, y0, y1);
  });
  const Image colour =
      make_image(Format::rgba16f, 97, 676, [](int x, int y, int c) { return Half{static_cast<std::uint16_t>(y * 97 + x + c * 9973)}; });
  Image picture(Format::rgba8, 97, 676);
  table.rows(colour, picture, 1, 300);
  table.rows(colour, picture, 300, colour.height());
  EXPECT_EQ(runs, 1);
  for (int y = 0; y < colour.height(); ++y) {
    for (int x = 0; x < colour.width(); ++x) {
      const Half* in = colour.row<Half>(y) + 4 * x;
      const Unorm8* out = picture.row<Unorm8>(y) + 4 * x;
      for (int c = 0; c < 3; ++c) {
        const int expected = y == 0 ? 0 : (in[c].bits & 0x7c00u) == 0x7c00u ? 7 : code_of(in[c]).code;
        ASSERT_EQ(out[c].code, expected) << in[c].bits;
      }
      ASSERT_EQ(out[3].code, y == 0 ? 0 : 255);
    }
  }
}

// A picture of fewer values than there are halves is no reason to evaluate them all.
TEST(CodeTable, SmallPicturesGoThroughThePass) {
  int rows = 0;
  const CodeTable table(97, 10, [&](const Image&, Image& picture, int y0, int y1) {
    rows += y1 - y0;
    picture.row<Unorm8>(y0)[5].code = 42;
  });
  Image colour(Format::rgba16f, 97, 10), picture(Format::rgba8, 97, 10);
  table.rows(colour, picture, 3, 7);
  EXPECT_EQ(rows, 4);
  EXPECT_EQ(picture.row<Unorm8>(3)[5].code, 42);
}

}  // namespace
}  // namespace rainref
