// The pictures of a page, decoded again and looked at texel by texel.
#include "reports/pictures.h"

#include <cstring>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/temporary_folder.h"
#include "image_io/read.h"
#include "math/half.h"
#include "reports/example_judgement.h"

namespace rainref::reports {
namespace {

using namespace judge;

using capture::Array;

Array array_of(Format format, int width, int height) {
  Array a;
  a.format = format;
  a.width = width;
  a.height = height;
  a.levels.emplace_back(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                        static_cast<std::size_t>(info(format).texel_bytes()));
  return a;
}
template <class T>
void set(Array& a, int x, int y, int channel, T value) {
  const FormatInfo& f = info(a.format);
  std::memcpy(a.levels[0].edit().data() + static_cast<std::size_t>((y * a.width + x) * f.texel_bytes() + channel * f.channel_bytes), &value,
              sizeof value);
}

capture::CaseOutput output_of(Array array, const std::string& unit, const std::string& color_space) {
  capture::CaseOutput o;
  o.array = std::move(array);
  o.unit = unit;
  o.color_space = color_space;
  return o;
}

/// A PNG's colours, read back.
class Decoded {
 public:
  explicit Decoded(const std::vector<std::byte>& png) {
    put(folder_ / "p.png", std::string(reinterpret_cast<const char*>(png.data()), png.size()));
    picture_ = image_io::read(folder_ / "p.png");
  }
  int width() const { return picture_.image.width(); }
  int height() const { return picture_.image.height(); }
  /// Row 0 of the file is on top.
  std::string at(int x, int y_from_top) const {
    const std::uint8_t* t = picture_.image.row<std::uint8_t>(y_from_top) + 4 * x;
    return fmt::format("#{:02x}{:02x}{:02x}", t[0], t[1], t[2]);
  }

 private:
  TemporaryFolder folder_;
  image_io::Picture picture_;
};

TEST(ReportPictures, CodesAreShownAsStoredWithRowZeroAtTheBottom) {
  OutputJudgement o = example_output("picture", Format::rgba8, 2, 3);
  o.map = {0, 1, 2, 3, 0, 0};
  Array expected = array_of(Format::rgba8, 2, 3);
  set(expected, 1, 0, 0, std::uint8_t{200});
  set(expected, 1, 0, 2, std::uint8_t{7});
  Array port = expected;
  set(port, 0, 2, 1, std::uint8_t{1});
  const std::vector<View> views = views_of(o, output_of(expected, "1", "sRGB"), port);
  ASSERT_EQ(views.size(), 1u);
  EXPECT_EQ(views[0].label, "colour");
  EXPECT_EQ(views[0].scale, "codes as stored");
  const Decoded reference(views[0].reference), got(views[0].port), verdict(views[0].verdict);
  EXPECT_EQ(reference.width(), 2);
  EXPECT_EQ(reference.height(), 3);
  EXPECT_EQ(reference.at(1, 2), "#c80007");
  EXPECT_EQ(reference.at(0, 0), "#000000");
  EXPECT_EQ(got.at(0, 0), "#000100");
  EXPECT_EQ(verdict.at(0, 2), verdict_colour(0));
  EXPECT_EQ(verdict.at(1, 2), verdict_colour(1));
  EXPECT_EQ(verdict.at(0, 1), verdict_colour(2));
  EXPECT_EQ(verdict.at(1, 1), verdict_colour(3));
}

TEST(ReportPictures, TheDifferenceHasSignAndScale) {
  OutputJudgement o = example_output("depth", Format::r32f, 4, 1);
  Array expected = array_of(Format::r32f, 4, 1), port = expected;
  const float one = 1;
  std::uint32_t bits;
  std::memcpy(&bits, &one, 4);
  for (int x = 0; x < 4; ++x) set(expected, x, 0, 0, one);
  set(port, 0, 0, 0, bits);
  set(port, 1, 0, 0, bits + 1);
  set(port, 2, 0, 0, bits - 900);
  set(port, 3, 0, 0, 0x7fc00000u);
  const std::vector<View> views = views_of(o, output_of(expected, "m", "none"), port);
  ASSERT_EQ(views.size(), 1u);
  EXPECT_EQ(views[0].largest, 900u);
  EXPECT_TRUE(views[0].has_nan);
  const Decoded d(views[0].difference);
  EXPECT_EQ(d.at(0, 0), difference_colour(0, 900));
  EXPECT_EQ(d.at(1, 0), difference_colour(1, 900));
  EXPECT_EQ(d.at(2, 0), difference_colour(-900, 900));
  EXPECT_EQ(d.at(3, 0), "#ff00ff");
  EXPECT_EQ(Decoded(views[0].port).at(3, 0), "#ff00ff");
  // One code is seen, doublings are told apart, and the signs never look alike.
  EXPECT_NE(difference_colour(1, 900), difference_colour(0, 900));
  EXPECT_NE(difference_colour(1, 900), difference_colour(2, 900));
  EXPECT_NE(difference_colour(1, 900), difference_colour(-1, 900));
  EXPECT_NE(difference_colour(900, 900), difference_colour(-900, 900));
  EXPECT_EQ(difference_colour(512, 900), difference_colour(900, 900));
}

TEST(ReportPictures, RadianceIsExposedByStops) {
  OutputJudgement o = example_output("colour", Format::rgba16f, 2, 1);
  Array expected = array_of(Format::rgba16f, 2, 1);
  for (int x = 0; x < 2; ++x)
    for (int c = 0; c < 4; ++c) set(expected, x, 0, c, to_half(c == 3 ? 1.0f : 8.0f));
  Array port = expected;
  set(port, 0, 0, 0, to_half(2.0f));
  const std::vector<View> views = views_of(o, output_of(expected, "1", "linear Rec. 709"), port);
  ASSERT_EQ(views.size(), 1u);  // alpha is 1 everywhere
  EXPECT_EQ(views[0].scale, "exposure -3 stops, sRGB-encoded");
  EXPECT_EQ(Decoded(views[0].reference).at(0, 0), "#ffffff");
  // sRGB(1/4) = 1.055 * 0.25^(1/2.4) - 0.055 = 0.53710, of 255: 136.96.
  EXPECT_EQ(Decoded(views[0].port).at(0, 0), "#89ffff");
  set(port, 1, 0, 3, to_half(0.5f));
  EXPECT_EQ(views_of(o, output_of(expected, "1", "linear Rec. 709"), port).size(), 2u);
}

TEST(ReportPictures, DataHaveAViewForEachChannelWithItsScale) {
  OutputJudgement o = example_output("wave", Format::rg16f, 101, 1);
  Array expected = array_of(Format::rg16f, 101, 1);
  for (int x = 0; x < 101; ++x) {
    set(expected, x, 0, 0, to_half(static_cast<float>(x - 50)));
    set(expected, x, 0, 1, to_half(3.0f));
  }
  const std::vector<View> views = views_of(o, output_of(expected, "m, s", "none"), expected);
  ASSERT_EQ(views.size(), 2u);
  EXPECT_EQ(views[0].label, "x");
  EXPECT_EQ(views[0].scale, "black -49, white 49 m");
  const Decoded first(views[0].reference);
  EXPECT_EQ(first.at(1, 0), "#000000");
  EXPECT_EQ(first.at(50, 0), "#808080");
  EXPECT_EQ(first.at(99, 0), "#ffffff");
  EXPECT_EQ(views[1].scale, "grey 3 s: the reference is constant");
  EXPECT_EQ(Decoded(views[1].reference).at(0, 0), "#808080");
  EXPECT_EQ(views[0].largest, 0u);
}

TEST(ReportPictures, LargeOutputsAreThinnedButNoFailureIsLost) {
  const int width = 2 * picture_side + 1, height = 300;
  OutputJudgement o = example_output("mask", Format::r8, width, height);
  Array expected = array_of(Format::r8, width, height), port = expected;
  set(port, 1001, 202, 0, std::uint8_t{9});
  o.map[static_cast<std::size_t>(202 * width + 1001)] = 3;
  o.failing = 1;
  Failure f;
  f.x = 1001;
  f.y = 202;
  o.worst.push_back(f);
  const std::vector<View> views = views_of(o, output_of(expected, "1", "none"), port);
  ASSERT_EQ(views.size(), 2u);
  EXPECT_EQ(views[0].thinned, 3);
  const Decoded whole(views[0].verdict), difference(views[0].difference);
  EXPECT_EQ(whole.width(), (width + 2) / 3);
  EXPECT_EQ(whole.at(1001 / 3, 99 - 202 / 3), verdict_colour(3));
  EXPECT_EQ(difference.at(1001 / 3, 99 - 202 / 3), difference_colour(9, 9));
  EXPECT_EQ(views[1].label, "x, window");
  EXPECT_EQ(views[1].thinned, 1);
  EXPECT_EQ(views[1].width, picture_window);
  EXPECT_EQ(Decoded(views[1].verdict).at(1001 - views[1].x0, picture_window - 1 - (202 - views[1].y0)), verdict_colour(3));
}

}  // namespace
}  // namespace rainref::reports
