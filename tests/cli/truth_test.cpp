// Traced pictures and `run --compare-truth`, as a user meets them.
#include "cli/traced_pictures.h"
#include "image_io/read.h"
#include "math/simd_target.h"

namespace rainref::cli {
namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

class Truth : public TracedPictures {};

TEST_F(Truth, TracedPicturesComeWithNamedChannels) {
  const Outcome o = rainref(
      {"run", "corrected.toml", "-o", "o", "--image", "both", "--set", "compositor.picture=traced", "--set", "compositor.samples=4"});
  ASSERT_EQ(o.code, 0) << o.err;
  const image_io::Picture exr = image_io::read(folder / "o/puddle.0001.exr");
  EXPECT_THAT(exr.channel_names, IsSupersetOf({"R", "G", "B", "normal.X", "normal.Y", "normal.Z", "depth.Z", "film", "mask"}));
  EXPECT_EQ(exr.image.format(), Format::rgba16f);
  EXPECT_EQ(traced("o").size(), 6u);
}

TEST_F(Truth, EmbreesConfigurationAndThreadsChangeNoBit) {
  const auto expected = trace("corrected", "a");
  EXPECT_EQ(trace("corrected", "b", {"--set", "compositor.embree_config=isa=sse2"}), expected);
  EXPECT_EQ(trace("corrected", "c", {"--threads", "3", "--simd", simd_targets().back()}), expected);
  EXPECT_NE(trace("corrected", "d", {"--set", "compositor.depth=1"}), expected);
}

TEST_F(Truth, ComparisonWritesPicturesAndPercentiles) {
  const Outcome o = rainref({"run", "corrected.toml", "-o", "o", "--compare-truth", "--every", "1"});
  ASSERT_EQ(o.code, 0) << o.err;
  const nlohmann::json truth = summary("o")["truth"];
  ASSERT_EQ(truth.size(), 2u);
  for (int frame = 0; frame < 2; ++frame) {
    EXPECT_EQ(truth[frame]["frame"], frame);
    EXPECT_EQ(truth[frame]["pixels"], 24 * 16);
    for (const char* name : {"hit_distance", "normal_angle", "ground_offset", "colour", "display", "ground_display", "schlick"}) {
      const nlohmann::json& d = truth[frame]["differences"][name];
      EXPECT_LE(d["p50"], d["p90"]) << name;
      EXPECT_LE(d["p99"], d["max"]) << name;
      const image_io::Picture picture = image_io::read(folder / "o" / d["picture"].get<std::string>());
      EXPECT_EQ(picture.image.width(), 24);
    }
  }
}

TEST_F(Truth, WhatCannotBeComparedIsRefused) {
  expect_refusal({"run", "published.toml", "-o", "o", "--compare-truth"}, 2,
                 HasSubstr("--compare-truth: puddle as-published has no traced truth"));
  expect_refusal({"run", "published.toml", "-o", "o", "--set", "compositor.picture=traced"}, 2, HasSubstr("compositor.picture"));
  expect_refusal({"run", "corrected.toml", "-o", "o", "--set", "compositor.picture=traced", "--set", "compositor.samples=3"}, 2,
                 HasSubstr("--set compositor.samples: expected 1, 4, 8 or 16 [1], found 3"));
  expect_refusal({"run", "corrected.toml", "-o", "o", "--set", "compositor.samples=32"}, 2,
                 HasSubstr("--set compositor.samples: expected 1, 4, 8 or 16 [1], found 32"));
  expect_refusal({"run", "corrected.toml", "-o", "o", "--set", "compositor.picture=painted"}, 2, HasSubstr("'passes', 'traced'"));
  expect_refusal({"run", "corrected.toml", "-o", "o", "--set", "compositor.picture=traced", "--set", "compositor.surroundings=street"}, 2,
                 HasSubstr("compositor.surroundings: expected \"picture\""));
}

// Packs and captures are of passes: nothing of the compositor is in them.
TEST_F(Truth, PacksKnowNothingOfIt) {
  const Outcome o =
      rainref({"run", "corrected.toml", "-o", "o", "--capture", "all", "--image", "none", "--set", "compositor.picture=traced"});
  ASSERT_EQ(o.code, 0) << o.err;
  EXPECT_THAT(contents(folder / "o/capture/manifest.json"), Not(HasSubstr("compositor")));
  EXPECT_THAT(rainref({"describe", "puddle"}).out, HasSubstr("compositor.embree_config"));
}

}  // namespace
}  // namespace rainref::cli
