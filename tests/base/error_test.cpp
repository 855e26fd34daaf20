// Errors say their place first, keep their exit codes, and suggest the nearest name.
#include "rainref/error.h"

#include <gtest/gtest.h>

namespace rainref {
namespace {

const std::vector<std::string> names = {"rain_rate", "wind_speed", "damping", "seed", "grid", "fov", "r8"};

TEST(SourceLocation, LeavesOutWhatIsUnknown) {
  EXPECT_EQ((SourceLocation{"scene.toml", 12, 5}.text()), "scene.toml:12:5");
  EXPECT_EQ((SourceLocation{"scene.toml", 12, 0}.text()), "scene.toml:12");
  EXPECT_EQ((SourceLocation{"scene.toml", 0, 5}.text()), "scene.toml");
  EXPECT_EQ(SourceLocation{}.text(), "");
}

TEST(Error, PutsThePlaceBeforeTheMessage) {
  const Error at(ExitCode::io, SourceLocation{"a.exr", 3}, "is cut short");
  EXPECT_STREQ(at.what(), "a.exr:3: is cut short");
  EXPECT_EQ(at.code(), ExitCode::io);
  EXPECT_STREQ(Error(ExitCode::usage, SourceLocation{}, "no place").what(), "no place");
  EXPECT_STREQ(Error(ExitCode::fail, "plain").what(), "plain");
}

TEST(Error, IsCaughtAsAStandardException) {
  try {
    throw Error(ExitCode::internal, "a defect");
  } catch (const std::exception& e) {
    EXPECT_STREQ(e.what(), "a defect");
    return;
  }
}

TEST(Error, ExitCodesAreTheOnesThatScriptsKnow) {
  EXPECT_EQ(static_cast<int>(ExitCode::pass), 0);
  EXPECT_EQ(static_cast<int>(ExitCode::fail), 1);
  EXPECT_EQ(static_cast<int>(ExitCode::usage), 2);
  EXPECT_EQ(static_cast<int>(ExitCode::port_files), 3);
  EXPECT_EQ(static_cast<int>(ExitCode::io), 4);
  EXPECT_EQ(static_cast<int>(ExitCode::internal), 5);
}

TEST(NearestName, FindsEachKindOfSlip) {
  EXPECT_EQ(nearest_name("rain_rate", names), "rain_rate");
  EXPECT_EQ(nearest_name("rainrate", names), "rain_rate");    // a letter lost
  EXPECT_EQ(nearest_name("rainn_rate", names), "rain_rate");  // a letter too many
  EXPECT_EQ(nearest_name("rain-rate", names), "rain_rate");   // a wrong letter
  EXPECT_EQ(nearest_name("rian_rate", names), "rain_rate");   // two neighbours exchanged
  EXPECT_EQ(nearest_name("dmaping", names), "damping");       // two slips in seven letters
  EXPECT_EQ(nearest_name("DAMPING", names), "");              // case counts
}

TEST(NearestName, AnExchangeOfNeighboursIsOneSlip) {
  EXPECT_EQ(nearest_name("gird", names), "grid");  // as two slips it would be over a third of four letters
  EXPECT_EQ(nearest_name("fvo", names), "fov");
  EXPECT_EQ(nearest_name("8r", names), "r8");
}

TEST(NearestName, TheLimitIsAThirdOfTheLongerNameAndAtLeastOne) {
  const std::vector<std::string> nine = {"abcdefghi"};
  EXPECT_EQ(nearest_name("abcdefxyz", nine), "abcdefghi");  // 3 of 9
  EXPECT_EQ(nearest_name("abcdewxyz", nine), "");           // 4 of 9
  EXPECT_EQ(nearest_name("abcdef", nine), "abcdefghi");     // 3 of 9, by the longer name
  EXPECT_EQ(nearest_name("abcde", nine), "");
  const std::vector<std::string> one = {"x"};
  EXPECT_EQ(nearest_name("y", one), "x");
  EXPECT_EQ(nearest_name("", one), "x");
  EXPECT_EQ(nearest_name("yz", one), "");
}

TEST(NearestName, TheNearerWinsAndTiesGoToTheEarlier) {
  const std::vector<std::string> choices = {"wave_out", "wave_on", "wave_in"};
  EXPECT_EQ(nearest_name("wave_an", choices), "wave_on");  // as far from wave_in
  EXPECT_EQ(nearest_name("wave_i", choices), "wave_in");
}

TEST(NearestName, NoNamesGiveNone) {
  EXPECT_EQ(nearest_name("anything", {}), "");
  EXPECT_EQ(did_you_mean("anything", {}), "");
}

TEST(DidYouMean, IsTheEndOfASentence) {
  EXPECT_EQ(did_you_mean("wind_sped", names), "; did you mean 'wind_speed'?");
  EXPECT_EQ(did_you_mean("elephants", names), "");
}

}  // namespace
}  // namespace rainref
