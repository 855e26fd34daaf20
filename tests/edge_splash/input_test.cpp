// What the effect takes and what it refuses.
#include "config_of.h"
#include "edge_splash/parameters.h"
#include "edge_splash/support.h"
#include "settings.h"

namespace rainref::edge_splash {
namespace {

using testing::Test;

const parallel::Executor& executor() {
  static const parallel::Executor one(1);
  return one;
}
std::string message_of(const Settings& s, const Inputs& in) {
  return error_of([&] { EdgeSplash(s, in, executor()); });
}
std::string message_of_scene(const std::string& variant, const std::vector<std::string>& values) {
  return error_of([&] { check(settings_from(rainref::test::config_of("edge_splash", parameters(), variant, "", values))); });
}

TEST(EdgeSplashInput, DeviceDepthsAndDistancesAreInverse) {
  for (const bool reversed : {true, false}) {
    const DepthRange r{0.3, 1000, reversed};
    EXPECT_EQ(depth_of(r, 0.3), reversed ? 1 : 0);
    EXPECT_EQ(depth_of(r, 1000), reversed ? 0 : 1);
    for (const double z : {0.3, 0.5, 1.0, 7.3, 100.0, 1000.0}) EXPECT_NEAR(distance_of(r, depth_of(r, z)), z, 1e-9 * z * z);
  }
  // The pass's own: 1 / z = depth_scale d + depth_bias.
  Settings s = rainref::test::edge_splash_settings();
  for (const bool reversed : {true, false}) {
    s.depth.reversed = reversed;
    const SplashUniforms u = splash_uniforms(s, 0, 2, 2);
    EXPECT_NEAR(1 / (u.depth_scale * depth_of(s.depth, 12.0) + u.depth_bias), 12.0, reversed ? 1e-4 : 1e-3);
  }
}

TEST(EdgeSplashInput, ImagesOfDifferentSize) {
  Inputs in = inputs_of(32, 24, [](int, int) { return 0.5; });
  in.depth = plane_of(32, 25, [](int, int) { return 0.5; });
  EXPECT_EQ(message_of(corrected(), in), "2 scene.depth_image: expected 32x24 texels as scene.image has, found 32x25");
  in = inputs_of(32, 24, [](int, int) { return 0.5; });
  in.layer = plane_of(16, 24, [](int, int) { return 1.0; });
  EXPECT_EQ(message_of(corrected(), in), "2 scene.layer_image: expected 32x24 texels as scene.image has, found 16x24");
  EXPECT_EQ(message_of(corrected(), Inputs()), "2 scene.image: expected an image of four channels");
}

TEST(EdgeSplashInput, DepthOutsideItsRange) {
  for (const double bad : {1.5, -0.25, std::nan("")}) {
    const std::string found = message_of(published(), inputs_of(32, 24, [=](int x, int y) { return x == 7 && y == 3 ? bad : 0.5; }));
    EXPECT_EQ(found, fmt::format("2 scene.depth_image: expected device depths from 0 to 1, found {} at column 7, row 3 from the bottom "
                                 "(scene.depth_encoding = \"metres\" takes distances)",
                                 bad));
  }
  EXPECT_EQ(message_of(corrected(), inputs_of_distance(32, 24, [](int, int y) { return y == 2 ? 2000.0 : 4.0; })),
            "2 scene.depth_image: expected distances [m] from 0.3 to 1000, found 2000 at column 0, row 2 from the bottom (scene.near and "
            "scene.far are the limits)");
}

TEST(EdgeSplashInput, PlanesThatAreNoRange) {
  Settings s = corrected();
  s.depth = {2, 1, true};
  EXPECT_EQ(message_of(s, inputs_of(8, 8, [](int, int) { return 0.5; })),
            "2 scene.near, scene.far: expected 0 < near < far, found 2 and 1");
}

TEST(EdgeSplashInput, ScalesOfZero) {
  EXPECT_EQ(message_of_scene("corrected", {}), "none");
  for (const char* key : {"edge_splash.band", "edge_splash.noise_size", "edge_splash.edge_step", "edge_splash.edge_bend",
                          "edge_splash.softness", "scene.near"}) {
    const std::string found = message_of_scene("corrected", {fmt::format("{}=0", key)});
    EXPECT_TRUE(found.starts_with("2 ")) << key << ": " << found;
    EXPECT_NE(found.find(key), std::string::npos) << found;
  }
  EXPECT_EQ(message_of_scene("corrected", {"edge_splash.up=[0,0,0]"}), "2 edge_splash.up: expected a direction, found [0, 0, 0]");
  EXPECT_NE(message_of_scene("corrected", {"edge_splash.smallest_band=0.02", "edge_splash.largest_band=0.01"})
                .find("no more than edge_splash.largest_band"),
            std::string::npos);
  EXPECT_NE(message_of_scene("as-published", {"edge_splash.band=1"}).find("edge_splash.band"), std::string::npos)
      << "a key of the other variant";
  // A thickness or threshold of zero is the article's own range, and runs.
  EXPECT_EQ(message_of_scene("as-published", {"edge_splash.thickness=0", "edge_splash.edge_threshold=0"}), "none");
  EXPECT_EQ(message_of_scene("as-published", {"edge_splash.edge_threshold=1"}), "none");
  EXPECT_NE(message_of_scene("as-published", {"edge_splash.edge_threshold=1.01"}).find("edge_splash.edge_threshold"), std::string::npos);
}

TEST(EdgeSplashInput, ANoiseMapThatDoesNotTile) {
  Inputs in = inputs_of(16, 16, [](int, int) { return 0.5; });
  in.noise = plane_of(64, 32, [](int x, int) { return x / 64.0; });
  const EdgeSplash ramp(corrected(), in, executor());
  ASSERT_EQ(ramp.warnings().size(), 1u);
  EXPECT_TRUE(ramp.warnings()[0].starts_with("scene.noise_image does not tile: ")) << ramp.warnings()[0];
  in.noise = plane_of(64, 32, [](int x, int y) { return 0.5 + 0.4 * std::sin(2 * pi * x / 64) * std::cos(2 * pi * y / 32); });
  EXPECT_TRUE(EdgeSplash(corrected(), in, executor()).warnings().empty());
  EXPECT_EQ(seam_warning(make_noise(1)), "");
  in.noise = plane_of(1, 32, [](int, int) { return 0.5; });
  EXPECT_EQ(message_of(published(), in), "2 scene.noise_image: expected at least 2x2 texels, found 1x32");
}

// The map made here tiles exactly: a lattice index is taken modulo the period, so a map twice as wide would repeat it.
TEST(EdgeSplashInput, OwnNoiseTilesAndFillsItsRange) {
  const Image map = make_noise(7, 128);
  int low = 255, high = 0;
  double sum = 0, seam = 0, inside = 0;
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 128; ++x) {
      const int c = code(map, x, y);
      low = std::min(low, c);
      high = std::max(high, c);
      sum += c;
      (x == 127 ? seam : inside) += std::abs(code(map, (x + 1) % 128, y) - c);
    }
  }
  EXPECT_LT(low, 40);
  EXPECT_GT(high, 215);
  EXPECT_NEAR(sum / 128 / 128 / 255, 0.5, 0.03);
  EXPECT_LT(seam / 128, 1.5 * inside / 127 / 128);
  EXPECT_FALSE(same(map, make_noise(8, 128)));
}

TEST(EdgeSplashInput, HalfResolutionKeepsTheMean) {
  Inputs in = inputs_of(8, 8, [](int, int) { return 0.5; });
  in.noise = uniform_noise(32);
  const Image half = prepare_noise(in.noise, corrected()), whole = prepare_noise(in.noise, published());
  EXPECT_EQ(half.width(), 16);
  EXPECT_EQ(whole.width(), 32);
  double sum = 0;
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) sum += half.row<float>(y)[x];
  }
  EXPECT_NEAR(sum / 256, 0.5, 1e-6);  // codes 0 to 255 equally often
}

TEST(EdgeSplashInput, ColourIsDecodedAndAlphaKept) {
  Inputs in = inputs_of(4, 4, [](int, int) { return 0.5; });
  in.colour = Image(Format::rgba8, 4, 4);
  for (int y = 0; y < 4; ++y) {
    for (int i = 0; i < 16; ++i) in.colour.row<Unorm8>(y)[i].code = i % 4 == 3 ? 64 : 188;
  }
  in.colour_is_encoded = true;
  const Image scene = prepare_scene(in.colour, in.colour_is_encoded);
  EXPECT_NEAR(to_float(scene.row<Half>(0)[0]), 0.5029, 1e-3);  // sRGB 188
  EXPECT_NEAR(to_float(scene.row<Half>(0)[3]), 64 / 255.0, 1e-3);
  // As published the alpha is blended like a colour; corrected keeps it.
  EdgeSplash e(corrected(), in, executor());
  e.next_frame();
  EXPECT_EQ(e.colour().row<Half>(0)[3].bits, scene.row<Half>(0)[3].bits);
}

}  // namespace
}  // namespace rainref::edge_splash
