// Channels are chosen by their names; what two names claim is refused.
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

std::array<int, 4> pick_depth(const std::vector<std::string>& names) { return pick_quantity("'f'", names, true).source; }

TEST(PickQuantity, ADepthIsKnownByItsName) {
  EXPECT_THAT(pick_depth({"A", "B", "G", "R", "Z"}), ElementsAre(4, 4, 4, one));
  EXPECT_THAT(pick_depth({"A", "B", "Depth.V", "G", "R"}), ElementsAre(2, 2, 2, one));
  EXPECT_THAT(pick_depth({"ViewLayer.Combined.R", "ViewLayer.Depth.Z", "ViewLayer.Mist.Z"}), ElementsAre(1, 1, 1, one));
  EXPECT_THAT(pick_depth({"B", "G", "R", "mist.Z"}), ElementsAre(3, 3, 3, one));
  EXPECT_THAT(pick_depth({"B", "G", "R", "depth"}), ElementsAre(3, 3, 3, one));
  EXPECT_THAT(pick_depth({"B", "G", "R", "V"}), ElementsAre(3, 3, 3, one));
  EXPECT_THAT(pick_depth({"B", "G", "R", "depth.A", "depth.R"}), ElementsAre(4, 4, 4, one));
  EXPECT_THAT(pick_depth({"depth", "mist.Z", "V", "z"}), ElementsAre(3, 3, 3, one)) << "the better name, not the first";
  EXPECT_THAT(pick_depth({"V"}), ElementsAre(0, 0, 0, one));
}

TEST(PickQuantity, AVectorIsNoDepth) {
  EXPECT_THAT(pick_depth({"N.X", "N.Y", "N.Z", "Y"}), ElementsAre(3, 3, 3, one));
  EXPECT_THAT(pick_depth({"N.X", "N.Y", "N.Z", "R", "glass.Z"}), ElementsAre(4, 4, 4, one));
  EXPECT_THAT(pick_depth({"U", "V"}), ElementsAre(0, 1, zero, one));
}

TEST(PickQuantity, WithoutANameItIsWhatAColourWouldBe) {
  EXPECT_THAT(pick_depth({"B", "G", "R"}), ElementsAre(2, 1, 0, one));
  EXPECT_THAT(pick_depth({"A", "Y"}), ElementsAre(1, 1, 1, 0));
  EXPECT_THAT(pick_depth({"G"}), ElementsAre(0, 0, zero, one)) << "its first channel is one that the file has";
  EXPECT_THAT(pick_quantity("'f'", std::vector<std::string>{"B", "G", "R", "Z"}, false).source, ElementsAre(2, 1, 0, one));
}

TEST(PickQuantity, TwoOfOneClaimAreRefused) {
  EXPECT_EQ(error_of([] {
              pick_depth({"R", "a.Depth.Z", "b.Depth.Z"});
            }),
            "2 'f': expected one depth, found a.Depth.Z and b.Depth.Z; save one of them alone");
}

TEST(PickChannels, SaysWhatItDoesNotUnderstand) {
  EXPECT_EQ(error_of([] { pick({"R", "normal.X"}, "norml"); }), "2 'f': no layer 'norml'; did you mean 'normal'?");
  for (const std::vector<std::string>& names : {std::vector<std::string>{"C", "M", "Y", "K"}, {"Y", "BY", "RY"}})
    EXPECT_THAT(error_of([&] { pick(names); }), testing::AllOf(testing::StartsWith("2 "), HasSubstr("not understood")));
}

}  // namespace
}  // namespace rainref::image_io
