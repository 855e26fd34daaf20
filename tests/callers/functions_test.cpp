// The public functions beside the effects' classes, and the reading of scenes, in every caller's state.
#include <bit>

#include <gtest/gtest.h>

#include "callers/states.h"
#include "edge_splash/host.h"
#include "image/images.h"
#include "puddle/parameters.h"
#include "rainref/error.h"
#include "rainref/puddle.h"
#include "rainref/edge_splash.h"
#include "rainref/rainy_glass.h"
#include "rainref/screen_drops.h"
#include "scene/toml.h"
#include "settings.h"

namespace rainref {
namespace {

using test::CalledIn;
using test::caller_states;
using test::CallerState;

/// What `call` gives in every state is what it gives in the pinned one, and the state is kept.
template <class Call>
void expect_the_same(const Call& call) {
  const auto expected = call();
  for (const CallerState& state : caller_states()) {
    auto found = decltype(expected){};
    CalledIn called(state);
    called([&] { found = call(); });
    EXPECT_EQ(found, expected) << state.name;
    EXPECT_TRUE(called.kept()) << state.name;
  }
}

TEST(AnyCaller, DepthsAndSeams) {
  const edge_splash::DepthRange range{0.3, 700, true};
  // Quotients that no rounding but the one to nearest gives all of.
  for (const double x : {0.1, 0.3, 0.7, 0.9}) {
    expect_the_same([&] { return std::bit_cast<std::uint64_t>(edge_splash::distance_of(range, x)); });
    const double metres = x * 10;  // here, in the test's own state
    expect_the_same([&] { return std::bit_cast<std::uint64_t>(edge_splash::depth_of(range, metres)); });
  }
  const Image map =
      make_image(Format::rgba32f, 7, 5, [](int x, int y, int c) { return static_cast<float>((13 * (4 * x + c) + 7 * y) % 11) / 11; });
  expect_the_same([&] { return std::bit_cast<std::uint64_t>(rainy_glass::seam(map)); });
}

TEST(AnyCaller, PuddlesOfOnesOwnWater) {
  puddle::Settings settings = rainref::test::puddle_settings();
  settings.width = 16;
  settings.height = 9;
  settings.grid = {12, 10};
  settings.shape = puddle::Shape::basin;
  puddle::Surroundings around;
  around.environment = Image(Format::rgba32f, 4, 2);
  around.ground = Image(Format::rgba32f, 4, 4);  // asphalt takes longer than all else
  const parallel::Executor executor(1);
  expect_the_same([&] { return puddle::memory_bytes(settings); });
  std::vector<float> heights(120);
  for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = static_cast<float>(i % 17) * 1.3e-4f;
  settings.storage = Format::rgba8;  // heights are scaled
  expect_the_same([&] {
    puddle::Puddle puddle(settings, around, executor);
    puddle.set_water(heights, heights);
    return std::pair(puddle.courant(), bytes_of(puddle.newest()));
  });
}

/// An effect that shows another picture than it was made with.
template <class T, class Show>
void expect_the_same_picture(T& effect, const Show& show) {
  expect_the_same([&] {
    show(effect);
    effect.next_frame();
    return bytes_of(effect.picture());
  });
}
TEST(AnyCaller, OtherPictures) {
  constexpr int width = 12, height = 9;
  const parallel::Executor executor(1);
  const auto image = [&](Format format, float factor) {
    const int channels = info(format).channels;
    return make_image(format, width, height,
                      [=](int x, int y, int c) { return 1 + factor * static_cast<float>((7 * (channels * x + c) + 13 * y) % 23) / 23; });
  };
  const auto first = [&] { return image(Format::rgba32f, 0); };
  const auto metres = [&] { return image(Format::r32f, 5); };
  const Image colour = image(Format::rgba32f, 3e-3f), depth = metres();
  // Frames of one time: what differs is the picture alone.
  edge_splash::Settings splash;
  splash.fps = 1e12;
  edge_splash::Inputs in;
  in.colour = first();
  in.depth = metres();
  in.depth_is_distance = true;
  edge_splash::EdgeSplash splashes(splash, in, executor);
  in.colour = image(Format::rgba32f, 3e-3f);
  expect_the_same_picture(splashes, [&](edge_splash::EdgeSplash& e) { e.show(in); });

  screen_drops::Settings drops = rainref::test::screen_drops_settings();
  drops.width = width, drops.height = height, drops.fps = 1e12;
  screen_drops::ScreenDrops window(drops, {first(), {}}, executor);
  expect_the_same_picture(window, [&](screen_drops::ScreenDrops& e) { e.show(colour); });

  rainy_glass::Settings glass = rainref::test::rainy_glass_settings();
  glass.width = width, glass.height = height, glass.fps = 1e12, glass.map_size = 16;
  rainy_glass::Surroundings around;
  around.colour = first();
  around.depth = metres();
  rainy_glass::RainyGlass pane(glass, around, executor);
  expect_the_same_picture(pane, [&](rainy_glass::RainyGlass& e) { e.show(colour, depth); });
}

TEST(AnyCaller, AnExceptionPutsTheStateBack) {
  puddle::Settings settings = rainref::test::puddle_settings();
  settings.wave_speed = 5;
  puddle::Surroundings around;
  around.environment = Image(Format::rgba32f, 4, 2);
  const parallel::Executor executor(1);
  expect_the_same([&]() -> std::string {
    try {
      puddle::Puddle(settings, around, executor);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  });
}

TEST(AnyCaller, AnExecutor) {
  expect_the_same([] {
    const parallel::Executor executor(3);
    std::vector<std::uint64_t> control(5);
    executor.for_range(5, 1,
                       [&](std::int64_t begin, std::int64_t) { control[static_cast<std::size_t>(begin)] = floating_point_control(); });
    return control;
  });
}

// Decimal fractions that no float has: reading them rounds.
TEST(AnyCaller, AScene) {
  const scene::EffectTable table{{{"puddle", {"as-published", "corrected"}, puddle::parameters()}}};
  const std::string toml =
      "effect = 'puddle'\nvariant = 'corrected'\n[puddle]\ndamping = 0.9000000000000000355\ntint = [0.1, 0.30000000000000000000000001, "
      "7e-1]\n[camera]\nposition = [1e-5, 12345.678901234567, 3]\n";
  const std::vector<std::string> overrides{"rain.rate=12.3456789012345678", "puddle.cell_size=4.1e-3"};
  expect_the_same([&] {
    const scene::Config config = scene::parse(toml, "x.toml", overrides, table);
    const puddle::Settings s = puddle::settings_from(config);
    return std::pair{config.canonical_text(), std::bit_cast<std::uint64_t>(s.rain_rate)};
  });
}

}  // namespace
}  // namespace rainref
