// An unknown key: what it may have meant, and when nothing is said.
#include "scene/key_guess.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rainref::scene {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<Parameter> keys() {
  const auto number = [](const char* key, const char* sentence) { return real(key, "1", 0, 1, 0, sentence); };
  return {
      integer("run.frames", "frame", 1, 9, 1, "Number of frames."),
      integer2("run.size", "texel", 1, 9, {1, 1}, "Width and height of the picture."),
      number("rain.rate", "Rain rate."),
      number("vehicle.speed", "Speed of the car."),
      number("wipers.cycles_per_minute", "Strokes in a minute."),
      number("pane_1_wipers.cycles_per_minute", "Strokes in a minute."),
      number("mist.most", "Share of the light that it scatters."),
      boolean("mist.on", false, "Mist lies on the glass."),
      number("glass.tint", "Colour of the glass."),
      number("display.exposure", "Exposure of the picture."),
      number("falling_rain.exposure", "Time for which the shutter is open."),
  };
}
std::vector<std::string> meant(const std::string& name) { return keys_meant(name, "glass", keys()); }
std::string said(const std::string& name) { return did_you_mean_key(name, "glass", keys()); }

TEST(KeyGuess, ASlipOfTheKeyboard) {
  EXPECT_THAT(meant("rain.rte"), ElementsAre("rain.rate"));
  EXPECT_THAT(meant("ran.rate"), ElementsAre("rain.rate"));
  EXPECT_THAT(meant("wiper.cycles_per_mintue"), ElementsAre("wipers.cycles_per_minute"));
  EXPECT_THAT(meant("framse"), ElementsAre("run.frames"));
  EXPECT_THAT(meant("pane_2_wipers.cycles_per_minute"), ElementsAre("pane_1_wipers.cycles_per_minute"));
}

TEST(KeyGuess, AnotherWordAnotherOrderAnotherEnding) {
  EXPECT_THAT(meant("duration"), ElementsAre("run.frames"));
  EXPECT_THAT(meant("resolution"), ElementsAre("run.size"));
  EXPECT_THAT(meant("rain_intensity"), ElementsAre("rain.rate"));
  EXPECT_THAT(meant("speed_of_wiper"), ElementsAre("wipers.cycles_per_minute"));
  EXPECT_THAT(meant("wiperSpeed"), ElementsAre("wipers.cycles_per_minute"));
  EXPECT_THAT(meant("glass_color"), ElementsAre("glass.tint"));
  EXPECT_THAT(meant("car.speed"), ElementsAre("vehicle.speed"));
}

// Two words that agree by other words alone are too little, and one word of two is nothing.
TEST(KeyGuess, NothingFromAnotherGroupUnlessTheWordsAgree) {
  for (const char* name : {"drops.size", "wiper_pressure", "vehicle.exposure", "snow", "zebra", "", ".", "lorry_velocity", "rain.size"})
    EXPECT_THAT(meant(name), IsEmpty()) << name;
  EXPECT_THAT(meant("camera.exposure"), ElementsAre("display.exposure"));
}

TEST(KeyGuess, AGroupStandsForItsSwitch) {
  EXPECT_EQ(said("mist"), "; did you mean 'mist.on'?");
  EXPECT_EQ(said("fog"), "; did you mean 'mist.on' or 'mist.most'?");
  for (const std::string table : {"wipers", "rain", "glass", "run"})
    EXPECT_EQ(said(table), "; `rainref describe glass " + table + "` lists that group");
  EXPECT_EQ(said("wiper_pressure"), "; `rainref describe glass wipers` lists that group");
  EXPECT_EQ(said("snow"), "");
  EXPECT_EQ(said(std::string(100000, 'x')), "");
}

}  // namespace
}  // namespace rainref::scene
