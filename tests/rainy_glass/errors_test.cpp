// Bad settings and images: one clear error each, naming key, expected and found.
#include <gmock/gmock.h>

#include "image/flipped.h"
#include "image/images.h"
#include "rainy_glass/backdrop.h"
#include "rainy_glass/golden_scenes.h"
#include "rainy_glass/parameters.h"
#include "rainy_glass/support.h"
#include "scene/test_card.h"

namespace rainref::rainy_glass {
namespace {

using test::settings;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string error_with(const Settings& s, const Surroundings& around) {
  return error_of([&] { RainyGlass(s, around, test::executor()); });
}

TEST(RainyGlassErrors, DepthOfAnotherSize) {
  const Settings s = settings(Variant::corrected, 12, 9);
  Surroundings around = test::surroundings(s);
  around.depth = Image(Format::r32f, 12, 8);
  EXPECT_THAT(error_with(s, around),
              AllOf(StartsWith("2 "), HasSubstr("scene.depth_image: expected 12x9 like the picture and scene.image, found 12x8")));
  around.colour = Image(Format::rgba32f, 5, 9);
  EXPECT_THAT(error_with(s, around), HasSubstr("scene.image: expected 12x9"));
}
TEST(RainyGlassErrors, DepthOutOfItsRange) {
  const Settings s = settings(Variant::corrected, 12, 9);
  Surroundings around = test::surroundings(s);
  around.depth.row<float>(4)[7] = -2;
  EXPECT_THAT(error_with(s, around),
              HasSubstr("scene.depth_image: expected depths of 0 m or more, found -2 at column 7, row 4 from the bottom"));
}
TEST(RainyGlassErrors, ZeroScales) {
  Settings s = settings(Variant::corrected, 12, 9);
  const Surroundings around = test::surroundings(s);
  s.drop_tile = 0;
  EXPECT_THAT(error_with(s, around), HasSubstr("glass.drop_tile: expected more than 0, found 0"));
  s.drop_tile = 1;
  s.flow_period = 0;
  EXPECT_THAT(error_with(s, around), HasSubstr("rain.flow_period: expected more than 0, found 0"));
  s.flow_period = 1;
  s.smallest_droplet = 0.5;
  EXPECT_THAT(error_with(s, around), HasSubstr("maps.smallest_droplet: expected a radius above 0 and at most"));
}
TEST(RainyGlassErrors, MissingImages) {
  Settings s = settings(Variant::corrected, 12, 9);
  Surroundings around = test::surroundings(s);
  s.use_probe = true;
  EXPECT_THAT(error_with(s, around), HasSubstr("glass.background: 'probe' needs a panorama"));
  s.use_probe = false;
  s.shape = Shape::image;
  EXPECT_THAT(error_with(s, around), HasSubstr("glass.normal_image: expected 12x9"));
  s.shape = Shape::pane;
  around.rivulets = Image(Format::rg32f, 8, 8);
  EXPECT_THAT(error_with(s, around), HasSubstr("maps.rivulets_image: expected four channels, found 2"));
  around.rivulets = Image();
  s.camera_target = s.camera_position;
  EXPECT_THAT(error_with(s, around), StartsWith("2 "));
}
TEST(RainyGlassErrors, HugeMapsNameTheMemory) {
  Settings s = settings(Variant::corrected, 12, 9);
  s.map_size = 60000;
  EXPECT_THAT(error_with(s, test::surroundings(s)), HasSubstr("maps.size 60000 needs"));
}
TEST(RainyGlassErrors, ScenesRefuseWhatTheVariantHasNot) {
  const auto load = [&](const std::string& variant, const std::string& more) { return error_of([&] { config_of(variant, more); }); };
  EXPECT_EQ(load("corrected", ""), "none");
  EXPECT_THAT(load("as-published", "[rain]\nwind = 3\n"), HasSubstr("rain.wind"));
  EXPECT_THAT(load("corrected", "[glass]\ndrop_tile = 0\n"), HasSubstr("glass.drop_tile"));
  EXPECT_THAT(load("corrected", "[glass]\nshape = \"spere\"\n"), HasSubstr("sphere"));
}

// A map that does not tile is warned of: its step at the edges against the step inside.
TEST(RainyGlassMaps, SeamTellsATileFromAPicture) {
  Settings s = settings(Variant::corrected, 8, 8);
  RainyGlass glass(s, test::surroundings(s), test::executor());
  glass.next_frame();
  EXPECT_LT(seam(glass.raindrops()), 2);
  EXPECT_LT(seam(glass.rivulets()), 2);
  const Image ramp = make_image(Format::rgba32f, 32, 32, [](int x, int, int) { return static_cast<float>(x) / 32; });
  EXPECT_GT(seam(ramp), worst_seam);
  EXPECT_EQ(seam(test::uniform_image(Format::rgba32f, 8, 8, 0.5f, 0.5f, 0, 0)), 0);
}
// A map of one's own takes the bake's place: the bake's own picture as a file gives the same frames.
TEST(RainyGlassMaps, FromFilesGiveWhatTheBakeGives) {
  for (const Variant variant : {Variant::as_published, Variant::corrected}) {
    const Settings s = settings(variant, 40, 30);
    Surroundings around = test::surroundings(s), again = test::surroundings(s);
    RainyGlass baked(s, around, test::executor());
    baked.next_frame();
    again.raindrops = copy_of(baked.raindrops());
    again.rivulets = copy_of(baked.rivulets());
    RainyGlass read(s, again, test::executor());
    read.next_frame();
    for (int y = 0; y < s.height; ++y) {
      for (int i = 0; i < 4 * s.width; ++i) ASSERT_EQ(read.colour().row<Half>(y)[i].bits, baked.colour().row<Half>(y)[i].bits);
    }
  }
}
// Mesh normals from a picture: a ball's own normals as an image cover what the ball covers.
TEST(RainyGlassMaps, NormalsFromAnImage) {
  Settings s = settings(Variant::corrected, 48, 36);
  Surroundings around = test::surroundings(s);
  s.shape = Shape::sphere;
  Image surface, orientation;
  make_surface(s, {}, surface, orientation);
  around.normals = Image(Format::rgba32f, s.width, s.height);
  for (int y = 0; y < s.height; ++y) {
    for (int i = 0; i < 4 * s.width; ++i) around.normals.row<float>(y)[i] = to_float(orientation.row<Half>(y)[i]);
  }
  s.shape = Shape::image;
  RainyGlass glass(s, around, test::executor());
  for (int frame = 0; frame < 5; ++frame) glass.next_frame();
  int moved = 0;
  for (int y = 0; y < s.height; ++y) {
    for (int x = 0; x < s.width; ++x) {
      EXPECT_EQ(glass.orientation().row<Half>(y)[4 * x + 3].bits, orientation.row<Half>(y)[4 * x + 3].bits);
      const bool differs = glass.colour().row<Half>(y)[4 * x].bits != to_half(around.colour.row<float>(y)[4 * x]).bits;
      if (to_float(orientation.row<Half>(y)[4 * x + 3]) == 0) {
        EXPECT_FALSE(differs);
      }
      moved += differs;
    }
  }
  EXPECT_GT(moved, 50);
}
// The probe needs no picture of the scene: what glass shows comes from the panorama alone.
TEST(RainyGlassMaps, ProbeStandsInForTheScene) {
  for (const Variant variant : {Variant::as_published, Variant::corrected}) {
    Settings s = settings(variant, 40, 30);
    s.use_probe = true;
    Surroundings around = test::surroundings(s);
    around.probe = test::uniform_image(Format::rgba32f, 16, 8, 0.25f, 0.5f, 0.75f, 1);
    RainyGlass glass(s, around, test::executor());
    for (int frame = 0; frame < 3; ++frame) glass.next_frame();
    int from_probe = 0;
    for (int y = 0; y < s.height; ++y) {
      for (int x = 0; x < s.width; ++x)
        from_probe += std::abs(to_float(glass.colour().row<Half>(y)[4 * x]) - 0.25f) < 1e-3f &&
                      std::abs(to_float(glass.colour().row<Half>(y)[4 * x + 2]) - 0.75f) < 1e-3f;
    }
    if (variant == Variant::as_published) {
      EXPECT_EQ(from_probe, s.width * s.height);
    } else {
      EXPECT_GT(from_probe, 100);
      EXPECT_LT(from_probe, s.width * s.height);  // dry glass shows the scene's own texel
    }
  }
}
// The built-in scene: bars stand before the glass, the street behind it.
TEST(RainyGlassBackdrop, HasBarsBeforeAndAStreetBehind) {
  Settings s = settings(Variant::corrected, 96, 54);
  const Surroundings around = make_backdrop(s, {0.02, 0.2, 0.02}, scene::TestCard(), test::executor());
  int before = 0, behind = 0;
  for (int y = 0; y < s.height; ++y) {
    for (int x = 0; x < s.width; ++x) {
      before += around.depth.row<float>(y)[x] < s.distance + 1e-3f;
      behind += around.depth.row<float>(y)[x] > 2;
    }
  }
  EXPECT_GT(before, 100);
  EXPECT_GT(behind, 2000);
  // A blurred point keeps its light, spread over a disc.
  Image point(Format::rgba32f, 41, 41);
  point.row<float>(20)[80] = 100;
  const Image spread = defocused(point, 6.5, test::executor());
  double sum = 0;
  int lit = 0;
  for (int y = 0; y < 41; ++y) {
    for (int x = 0; x < 41; ++x) sum += spread.row<float>(y)[4 * x], lit += spread.row<float>(y)[4 * x] > 0;
  }
  EXPECT_NEAR(sum, 100, 1e-3);
  EXPECT_NEAR(lit, test::pi * 6.5 * 6.5, 6);
}
}  // namespace
}  // namespace rainref::rainy_glass
