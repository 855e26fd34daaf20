// The drops of a picture by themselves: of a scene whose colours say their place, each drop's colour says where its light is from.
#include "effect/drops_layer.h"

#include <cmath>
#include <fstream>

#include <gmock/gmock.h>

#include "base/error_of.h"
#include "base/temporary_folder.h"
#include "image/flipped.h"
#include "math/half.h"
#include "rainref/simulation.h"
#include "registry/registry.h"
#include "scene/toml.h"
#include "simulation/opened.h"
#include "simulation/small_scenes.h"

namespace rainref::effect {
namespace {

/// The drops over their background: that this is the picture within half a last place of the drops.
void expect_recomposes(const DropsLayer& layer, const Image& colour) {
  for (int y = 0; y < colour.height(); ++y) {
    for (int x = 0; x < colour.width(); ++x) {
      const Half *drop = layer.drops.row<Half>(y) + 4 * x, *behind = layer.background.row<Half>(y) + 4 * x,
                 *seen = colour.row<Half>(y) + 4 * x;
      for (int k = 0; k < 3; ++k) {
        const double over = to_float(drop[k]) + (1 - double{to_float(drop[3])}) * to_float(behind[k]);
        // 2^-11 of a normal half, 2^-25 of others; a float lies between.
        const double half_place = std::max(std::abs(to_float(drop[k])) * 0x1.001p-11, 0x1p-25);
        ASSERT_NEAR(over, to_float(seen[k]), half_place) << "column " << x << ", row " << y << ", cover " << to_float(drop[3]);
      }
    }
  }
}

// A pass has mixed them: colour = (1 - cover) background + cover of what the drop shows.
TEST(DropsLayer, IsWhatTheBackgroundLeavesOpen) {
  Image colour(Format::rgba16f, 3, 1), background(Format::rgba16f, 3, 1);
  const float cover[] = {0, 0.5f, 1}, lamp = 31, drops = 0.25f;
  for (int x = 0; x < 3; ++x) {
    for (int k = 0; k < 3; ++k) {
      background.row<Half>(0)[4 * x + k] = to_half(lamp);
      colour.row<Half>(0)[4 * x + k] = to_half((1 - cover[x]) * lamp + cover[x] * drops);
    }
  }
  const DropsLayer layer = drops_layer(colour, copy_of(background), parallel::Executor(2), [&](int x, int) {
    return DropPixel{cover[x], 0.25, -0.125};
  });
  const auto drop = [&](int k) { return to_float(layer.drops.row<Half>(0)[k]); };
  const auto offset = [&](int k) { return to_float(layer.offset.row<Half>(0)[k]); };
  for (int k = 0; k < 4; ++k) EXPECT_EQ(drop(k), 0);
  EXPECT_EQ(offset(0), 0) << "no drop";
  for (int k = 0; k < 3; ++k) {
    // Nothing of the lamp. colour is rounded to 2^-6.
    EXPECT_NEAR(drop(4 + k), 0.125, 0x1p-7);
    EXPECT_EQ(drop(8 + k), 0.25f);
  }
  EXPECT_EQ(drop(7), 0.5f);
  EXPECT_EQ(drop(11), 1);
  EXPECT_EQ(offset(2), 0.25f);
  EXPECT_EQ(offset(3), -0.125f);
  expect_recomposes(layer, colour);
}

TEST(DropsLayer, OverItsBackgroundItIsThePictureWhateverTheNumbers) {
  Image colour(Format::rgba16f, 64, 64), background(Format::rgba16f, 64, 64);
  std::uint32_t state = 1;
  const auto next = [&] { return static_cast<float>((state = state * 1664525u + 1013904223u) >> 8) * 0x1p-24f; };
  for (int y = 0; y < 64; ++y) {
    for (int i = 0; i < 256; ++i) {
      background.row<Half>(y)[i] = to_half(std::exp2(20 * next() - 10));
      colour.row<Half>(y)[i] = to_half(std::exp2(20 * next() - 10));
    }
  }
  // Shares of all sizes, among them such that a half cannot hold.
  const auto cover = [](int x, int y) { return y < 32 ? x / 63.0 : 1 - std::exp2(-x / 3.0); };
  expect_recomposes(drops_layer(colour, copy_of(background), parallel::Executor(2),
                                [&](int x, int y) {
                                  return DropPixel{cover(x, y), 0, 0};
                                }),
                    colour);
}

/// A picture of 160 x 120 whose red is the place across, from 0 to 1, and whose blue the place from its lower edge; green is 1. Or a depth
/// of 100 m.
std::string places(bool is_depth = false) {
  static const TemporaryFolder folder;
  std::string header = std::string("{'descr': '<f4', 'fortran_order': False, 'shape': (120, 160, ") + (is_depth ? "1), }" : "3), }");
  header.resize(117, ' ');
  const std::string file = (folder / (is_depth ? "depth.npy" : "places.npy")).string();
  std::ofstream out(file, std::ios::binary);
  out << "\x93NUMPY" << '\1' << '\0' << '\x76' << '\0' << header << '\n';
  for (int row = 0; row < 120; ++row) {
    for (int column = 0; column < 160; ++column) {
      const float depth = 100, rgb[3] = {(static_cast<float>(column) + 0.5f) / 160, 1, 1 - (static_cast<float>(row) + 0.5f) / 120};
      if (is_depth)
        out.write(reinterpret_cast<const char*>(&depth), sizeof depth);
      else
        out.write(reinterpret_cast<const char*>(rgb), sizeof rgb);
    }
  }
  return file;
}

struct Given {
  const char* effect;
  std::vector<std::string> set;
};
class DropsLayerOf : public testing::TestWithParam<Given> {};

// What a drop shows has the same share of green lost as of red and blue: their ratio is the place that the offset leads to.
TEST_P(DropsLayerOf, LeadsToThePlaceWhoseLightADropShows) {
  const Effect& effect = *registry::find(GetParam().effect);
  std::vector<std::string> set{"run.size=[160, 120]", "scene.image=" + places(), "display.exposure=0"};
  set.insert(set.end(), GetParam().set.begin(), GetParam().set.end());
  const scene::Config config = scene::parse(small(GetParam().effect, "corrected", set), simulation::effect_table());
  const parallel::Executor executor(2);
  Inputs inputs;
  const std::unique_ptr<Instance> instance = effect.open(config, executor, inputs);
  ASSERT_TRUE(instance->has_drops_layer());
  for (int frame = 0; frame < 20; ++frame) {
    instance->simulate(nullptr);
    instance->render(nullptr);
  }
  const DropsLayer layer = instance->drops_layer(executor);
  const Image& colour = *instance->layers().front().image;
  expect_recomposes(layer, colour);
  int checked = 0, dry = 0, at_rims = 0;
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      const Half *drop = layer.drops.row<Half>(y) + 4 * x, *offset = layer.offset.row<Half>(y) + 2 * x, *seen = colour.row<Half>(y) + 4 * x;
      const double cover = to_float(drop[3]), green = to_float(seen[1]);
      dry += cover == 0;
      // Where there is no drop, the background is the picture.
      if (cover == 0) {
        EXPECT_EQ(to_float(drop[1]), 0);
      }
      if (cover < 1 || green < 0.05) continue;
      const double u = (x + 0.5) / 160 + to_float(offset[0]), v = (y + 0.5) / 120 + to_float(offset[1]);
      if (std::abs(u - 0.5) > 0.4 || std::abs(v - 0.5) > 0.4) continue;  // the picture ends
      ++checked;
      // Halves of ratios: 2^-11 each. At a drop's rim, which shows the scene much smaller, its last level is one texel.
      const double off = std::max(std::abs(to_float(seen[0]) / green - u), std::abs(to_float(seen[2]) / green - v));
      at_rims += off > 0.004;
      EXPECT_EQ(to_float(drop[1]), to_float(seen[1]));
    }
  }
  EXPECT_GT(checked, 50);
  EXPECT_LE(at_rims, checked / 50);
  EXPECT_GT(dry, 500);
}
INSTANTIATE_TEST_SUITE_P(Effects, DropsLayerOf,
                         testing::Values(Given{"windshield",
                                               {"windshield.height_size=[320, 180]", "rain.smallest_drop=3", "rain.rate=200",
                                                "composite.inner=0", "composite.glint_strength=0", "composite.wetness=0", "scene.margin=1",
                                                "blur.fog_density=0", "vehicle.speed=0", "wipers.count=0", "scene.size=[160, 120]"}},
                                         Given{"screen_drops",
                                               {"drops.inner=0", "scene.margin=1", "drops.largest_radius=6", "flow.on=false",
                                                "glass.height=0.015"}},
                                         Given{"rainy_glass", {"scene.depth_image=" + places(true)}}),
                         [](const auto& tested) { return std::string(tested.param.effect); });

// What is on the glass beside drops, and before it, belongs to the background.
TEST(DropsLayer, OfAnyWindshieldOverItsBackgroundIsThePicture) {
  const std::vector<std::vector<std::string>> scenes{
      {"variant=as-published"},
      {"smear.on=true", "condensation.on=true", "interior.on=true", "falling_rain.on=true", "wipers.count=2"},
      {"windshield.panes=1.0 0.75 0.95, 1.9 0.8 1.0, 1.1 0.7 1.4"}};
  for (std::vector<std::string> set : scenes) {
    const std::string variant = set.front() == "variant=as-published" ? "as-published" : "corrected";
    SCOPED_TRACE(set.front());
    set.insert(set.end(), {"run.size=[160, 120]", "scene.image=" + places(), "scene.size=[160, 120]"});
    const scene::Config config = scene::parse(small("windshield", variant, set), simulation::effect_table());
    const parallel::Executor executor(2);
    Inputs inputs;
    const std::unique_ptr<Instance> instance = registry::find("windshield")->open(config, executor, inputs);
    for (int frame = 0; frame < 30; ++frame) {
      instance->simulate(nullptr);
      instance->render(nullptr);
    }
    const Image& colour = *instance->layers().front().image;
    const Image seen = copy_of(colour);
    const DropsLayer layer = instance->drops_layer(executor);
    expect_recomposes(layer, colour);
    int covered = 0, elsewhere = 0;
    for (int y = 0; y < 120; ++y) {
      for (int i = 0; i < 4 * 160; ++i) {
        // Asking for it changes nothing.
        ASSERT_EQ(colour.row<Half>(y)[i].bits, seen.row<Half>(y)[i].bits);
        const bool is_cover = i % 4 == 3;
        const float value = to_float(layer.drops.row<Half>(y)[i]);
        covered += is_cover && value > 0;
        elsewhere += !is_cover && value != 0 && to_float(layer.drops.row<Half>(y)[i / 4 * 4 + 3]) == 0;
      }
    }
    EXPECT_GT(covered, 0);
    // Without a drop the background is the picture, but where a coverage is too small for a half.
    EXPECT_LE(elsewhere, covered / 100);
  }
}

TEST(DropsLayer, OthersHaveNone) {
  const auto opened = [](const std::string& effect, const std::string& variant) {
    const parallel::Executor executor(1);
    return error_of([&] { Simulation(small(effect, variant, {"picture.layer=true"}), executor); });
  };
  EXPECT_THAT(opened("puddle", "corrected"), testing::HasSubstr("picture.layer: expected windshield"));
  EXPECT_THAT(opened("screen_drops", "as-published"), testing::HasSubstr("picture.layer: expected windshield"));
  EXPECT_EQ(opened("windshield", "as-published"), "none");
}

}  // namespace
}  // namespace rainref::effect
