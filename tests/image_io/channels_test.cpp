#include "image_io/channels.h"

#include <gmock/gmock.h>

#include "image_io/tiny_files.h"

namespace rainref::image_io {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr int zero = ChannelPick::zero, one = ChannelPick::one;

std::array<int, 4> pick(const std::vector<std::string>& names, std::string_view layer = {}) {
  return pick_channels("'f'", names, layer).source;
}

TEST(PickChannels, NamesDecideNotTheirOrder) {
  EXPECT_THAT(pick({"R", "G", "B", "A"}), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(pick({"A", "B", "G", "R", "Z"}), ElementsAre(3, 2, 1, 0));
  EXPECT_THAT(pick({"r", "g", "b"}), ElementsAre(0, 1, 2, one));
  EXPECT_THAT(pick({"R", "G"}), ElementsAre(0, 1, zero, one));
  EXPECT_THAT(pick({"X", "Y", "Z"}), ElementsAre(0, 1, 2, one));
  EXPECT_THAT(pick({"U", "V"}), ElementsAre(0, 1, zero, one));
}

TEST(PickChannels, OneChannelIsGrey) {
  EXPECT_THAT(pick({"Y"}), ElementsAre(0, 0, 0, one));
  EXPECT_THAT(pick({"height"}), ElementsAre(0, 0, 0, one));
  EXPECT_THAT(pick({"A"}), ElementsAre(0, 0, 0, one));
  EXPECT_THAT(pick({"A", "Y"}), ElementsAre(1, 1, 1, 0));
}

TEST(PickChannels, LayersAreKeptApart) {
  const std::vector<std::string> names{"R", "G", "B", "depth.Z", "normal.X", "normal.Y", "normal.Z"};
  EXPECT_THAT(pick(names), ElementsAre(0, 1, 2, one));
  EXPECT_THAT(pick(names, "normal"), ElementsAre(4, 5, 6, one));
  EXPECT_THAT(pick(names, "depth"), ElementsAre(3, 3, 3, one));
  // No main layer: the first one.
  EXPECT_THAT(pick({"view.beauty.R", "view.beauty.G", "view.beauty.B", "view.depth.Z"}), ElementsAre(0, 1, 2, one));
}

TEST(PickChannels, SaysWhatItDoesNotUnderstand) {
  const auto layer = error_of([] { pick({"R", "normal.X"}, "norml"); });
  ASSERT_TRUE(layer);
  EXPECT_EQ(layer->code(), ExitCode::usage);
  EXPECT_STREQ(layer->what(), "'f': no layer 'norml'; did you mean 'normal'?");
  for (const std::vector<std::string>& names : {std::vector<std::string>{"C", "M", "Y", "K"}, {"Y", "BY", "RY"}}) {
    const auto error = error_of([&] { pick(names); });
    ASSERT_TRUE(error);
    EXPECT_EQ(error->code(), ExitCode::usage);
    EXPECT_THAT(error->what(), HasSubstr("not understood"));
  }
}

}  // namespace
}  // namespace rainref::image_io
