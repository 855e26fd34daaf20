// Rain, wipers and wind over time.
#include <gtest/gtest.h>

#include "drops/uniforms.h"
#include "rain/rain.h"
#include "windshield/golden_scenes.h"
#include "windshield/motion/weather.h"
#include "windshield/motion/wipers.h"
#include "windshield/support.h"

namespace rainref::windshield {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// ---- wipers ----------------------------------------------------------------------------------------------------------------

// Slow is 30 a minute, half a cycle a second, fast is a whole one.
TEST(WiperMotion, EachModeAtItsRate) {
  const WiperMotion m("0 slow; 10 fast; 20 off", 30, 60);
  EXPECT_EQ(m.cycles(0), 0);
  EXPECT_EQ(m.cycles(7), 3.5);
  EXPECT_EQ(m.cycles(10), 5);
  EXPECT_EQ(m.cycles(13.25), 8.25);
  EXPECT_EQ(m.cycles(20), 15);
  EXPECT_EQ(m.cycles(1e6), 15);
  EXPECT_THAT(m.changes(0, 30), ElementsAre(10, 20));
  EXPECT_THAT(m.changes(10, 20), ElementsAre());
}
// Switched off amid a stroke they complete it as fast as they were, and rest exactly where they began.
TEST(WiperMotion, OffCompletesTheStroke) {
  const WiperMotion m("0 slow; 3.5 off; 10 fast", 30, 60);
  EXPECT_EQ(m.cycles(3.5), 1.75);
  EXPECT_EQ(m.cycles(3.75), 1.875);
  EXPECT_EQ(m.cycles(4), 2);
  EXPECT_EQ(m.cycles(9), 2);
  EXPECT_EQ(m.cycles(10.5), 2.5);
  EXPECT_THAT(m.changes(0, 20), ElementsAre(3.5, 4, 10));
  // From fast at the fast rate; and on again before the stroke is over they simply go on.
  const WiperMotion quick("0 fast; 0.25 off; 0.5 slow", 30, 60);
  EXPECT_EQ(quick.cycles(0.5), 0.5);
  EXPECT_EQ(quick.cycles(1.5), 1);
}
TEST(WiperMotion, IntermittentStrokesInItsPeriod) {
  const WiperMotion m("5 off; 10 intermittent 6; 25 off", 30, 60);  // what the first says holds from the start
  EXPECT_EQ(m.cycles(9.9), 0);
  EXPECT_EQ(m.cycles(11), 0.5);
  EXPECT_EQ(m.cycles(12), 1);
  EXPECT_EQ(m.cycles(15.9), 1);
  EXPECT_EQ(m.cycles(17), 1.5);
  EXPECT_EQ(m.cycles(23), 2.5);
  EXPECT_EQ(m.cycles(100), 3);
  EXPECT_THAT(m.changes(0, 24.5), ElementsAre(10, 12, 16, 18, 22, 24));
  EXPECT_THAT(m.changes(16, 18), ElementsAre());
  // From slow: the stroke of then is completed, the next one begins at a multiple of the period behind the key frame.
  const WiperMotion after("0 slow; 1 intermittent 3", 30, 60);
  EXPECT_EQ(after.cycles(2), 1);
  EXPECT_EQ(after.cycles(4), 1);
  EXPECT_EQ(after.cycles(5), 1.5);
  // No period is shorter than a stroke.
  EXPECT_EQ(WiperMotion("0 intermittent 0.5", 30, 60).cycles(7), 3.5);
}
// Continuous, never backward, at whatever time it is asked.
TEST(WiperMotion, IsContinuousAndNeverGoesBack) {
  const WiperMotion m("0 slow; 1.7 off; 3.1 intermittent 2.9; 20.3 fast; 31.9 intermittent 7; 60 off; 61 slow", 43, 71);
  double before = 0;
  for (int i = 1; i < 80000; ++i) {
    const double now = m.cycles(i * 1e-3);
    ASSERT_GE(now, before) << i;
    ASSERT_LE(now - before, 71 / 60.0 * 1.001e-3) << i;
    before = now;
  }
}
TEST(WiperMotion, WhatCannotBeIsNamed) {
  const auto message = [](const char* text) { return usage_error([&] { WiperMotion(text, 45, 65); }); };
  EXPECT_THAT(message("0 on"), HasSubstr("wipers.key_frames, key frame 1: expected \"time off\""));
  EXPECT_THAT(message("0 off; 5 intermittent"), HasSubstr("key frame 2: expected \"time off\""));
  EXPECT_THAT(message("0 off; 5 intermittent 0"), HasSubstr("key frame 2: period: expected more than 0"));
  EXPECT_THAT(message("0 off; 5 slow 3"), HasSubstr("key frame 2: expected"));
  EXPECT_THAT(message("0 off; 0 slow"), HasSubstr("key frame 2: time: expected more than 0 of the row before, found 0"));
  EXPECT_THAT(message("-1 off"), HasSubstr("key frame 1: time: expected a number not below 0, found '-1'"));
  EXPECT_THAT(message("x off"), HasSubstr("time"));
  EXPECT_THAT(message(";"), HasSubstr("expected at least one row"));
}

// The records of a keyed drive hold every angle that is passed, each beginning with the bits in which the one before ended; at rest the
// blades lie where they began; and slow all the time is what no key frames are.
TEST(WiperMotion, RecordsFollowIt) {
  const Glass& glass = default_glass();
  WiperSettings plain = default_wipers(glass), keyed = plain;
  keyed.keyed.emplace("0 slow; 1.9 off; 4 intermittent 3; 11.5 fast", plain.cycles_per_minute, 60);
  const double fps = 30;
  Wiper before = wipers_at(keyed, glass.plane(), 0)[0];
  double turned = 0;
  for (int n = 0; n < 15 * 30; ++n) {
    const double from = n / fps, to = (n + 1) / fps;
    for (const Wiper& w : wipers_between(keyed, glass.plane(), from, to, true)) {
      if (w.pivot[0] != before.pivot[0]) continue;  // the other blade
      EXPECT_EQ(w.previous_axis[0], before.axis[0]) << n;
      EXPECT_EQ(w.previous_axis[1], before.axis[1]) << n;
      turned += std::abs(std::atan2(w.axis[1], w.axis[0]) - std::atan2(w.previous_axis[1], w.previous_axis[0]));
      before = w;
    }
  }
  ASSERT_EQ(keyed.keyed->cycles(15), 8.5);  // at a turn
  EXPECT_NEAR(turned, 2 * keyed.keyed->cycles(15) * plain.blades[0].sweep, 1e-3);
  const std::vector<Wiper> rest = wipers_between(keyed, glass.plane(), 3, 3 + 1 / fps, true);
  ASSERT_EQ(rest.size(), 2u);
  EXPECT_EQ(rest[0].direction, 0);
  EXPECT_EQ(rest[0].axis[0], wipers_at(plain, glass.plane(), 0)[0].axis[0]);
  WiperSettings slow = plain;
  slow.keyed.emplace("0 slow", plain.cycles_per_minute, 65);
  for (const bool corrected : {false, true}) {
    const auto a = wipers_between(plain, glass.plane(), 0.3, 0.9, corrected), b = wipers_between(slow, glass.plane(), 0.3, 0.9, corrected);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].axis[0], b[i].axis[0]);
  }
}

// ---- rain and wind ----------------------------------------------------------------------------------------------------------

TEST(Weather, FollowsItsKeyFrames) {
  WeatherSettings s;
  s.wind_key_frames = "0 0 0 0; 10 5 -2 0.5; 20 5 -2 0.5";
  s.rain_key_frames = "5 0; 10 60; 30 60; 40 0";
  const Weather w(s);
  EXPECT_EQ(w.wind(-1), (Real3{0, 0, 0}));
  EXPECT_EQ(w.wind(10), (Real3{5, -2, 0.5}));
  EXPECT_EQ(w.wind(15), (Real3{5, -2, 0.5}));
  EXPECT_EQ(w.rain(0), 0);
  EXPECT_EQ(w.rain(20), 60);
  EXPECT_EQ(w.rain(1000), 0);
  for (double t = 0; t < 50; t += 0.1) {
    EXPECT_GE(w.rain(t), 0);
    EXPECT_LE(w.rain(t), 60);
    EXPECT_NEAR((w.rained(t + 1e-4) - w.rained(t - 1e-4)) / 2e-4, w.rain(t), 1e-3);
  }
}
TEST(Weather, WhatCannotBeIsNamed) {
  const auto refused = [](const char* variant, const std::string& keys) {
    return usage_error([&] { settings_from(config_of(variant, keys)); });
  };
  const parallel::Executor executor(1);
  const auto built = [&](const char* variant, const std::string& keys) {
    return usage_error([&] { Windshield(config_of(variant, keys), small_surroundings(), executor); });
  };
  EXPECT_THAT(refused("corrected", "rain.rate = 3\nrain.key_frames = '0 0; 1 5'\n"),
              HasSubstr("rain.rate: expected none beside rain.key_frames, found 3"));
  EXPECT_THAT(refused("as-published", "windshield.spawn_rate = 3\nrain.key_frames = '0 0; 1 5'\n"),
              HasSubstr("windshield.spawn_rate: expected none"));
  EXPECT_THAT(refused("corrected", "world.wind = [1, 0, 0]\nworld.wind_key_frames = '0 0 0 0; 1 5 0 0'\n"),
              HasSubstr("world.wind: expected none"));
  EXPECT_THAT(refused("corrected", "wipers.fast_cycles_per_minute = 70\n"), HasSubstr("wipers.fast_cycles_per_minute: expected none"));
  EXPECT_EQ(built("corrected", "rain.key_frames = '0 0; 1 500'\n"),
            "rain.key_frames, key frame 2: rate: expected 0 to 200 mm/h, found 500");
  EXPECT_EQ(built("as-published", "rain.key_frames = '0 0; 1 500'\n"), "");
  EXPECT_EQ(built("corrected", "rain.key_frames = '0 0'\n"), "rain.key_frames, key frame 1: expected at least two rows, found 1");
  EXPECT_EQ(built("corrected", "rain.key_frames = '0 0; 0 1'\n"),
            "rain.key_frames, key frame 2: time: expected more than 0 of the row before, found 0");
  EXPECT_EQ(built("corrected", "world.wind_key_frames = '0 0 0; 1 1 1'\n"),
            "world.wind_key_frames, key frame 1: expected \"time x y z\", found '0 0 0'");
  EXPECT_EQ(built("corrected", "world.wind_key_frames = '0 0 0 0; 1 1 1 inf'\n"),
            "world.wind_key_frames, key frame 2: z: expected a number, found 'inf'");
}

/// The hash of every buffer of some frames.
std::vector<std::string> hashes(const std::string& variant, const std::string& toml, int frames = 6) {
  const parallel::Executor executor(2);
  Windshield run(config_of(variant, toml), small_surroundings(), executor);
  std::vector<std::string> lines;
  for (int n = 0; n < frames; ++n) {
    capture::HashRecorder recorder;
    run.next_frame(&recorder);
    for (const capture::HashLine& line : recorder.take_lines()) lines.push_back(line.text());
  }
  return lines;
}
// Key frames that say the same all the time give the bits of no key frames.
TEST(Weather, ConstantKeyFramesAreNone) {
  const std::string common = "[run]\nsize = [33, 19]\n[vehicle]\nspeed = 9\n[windshield]\nheight_size = [40, 24]\n";
  EXPECT_EQ(
      hashes("corrected", common + "[rain]\nrate = 80\n[world]\nwind = [2, 3, 0]\n"),
      hashes(
          "corrected",
          common + "[rain]\nkey_frames = '0 80; 1 80'\n[world]\nwind_key_frames = '0 2 3 0; 9 2 3 0'\n[wipers]\nkey_frames = '0 slow'\n"));
  EXPECT_EQ(hashes("as-published", common + "spawn_rate = 960\n"),
            hashes("as-published", common + "[rain]\nkey_frames = '0 960; 1 960'\n[wipers]\nkey_frames = '0 slow'\n"));
}

/// Arrivals before the last step, and whether a blade moved.
class Drive : public Recorder {
 public:
  void before(const PassStart& start) override {
    if (start.pass == "spawn") arrived = reinterpret_cast<const drops::SpawnUniforms*>(start.uniforms.data())->first_id;
    if (start.pass != "wipe_drops") return;
    for (const PassInput& input : start.inputs)
      if (input.name == "wipers") {
        const RecordView& v = std::get<RecordView>(input.content);
        for (std::size_t i = 0; i < v.count; ++i) moved |= static_cast<const Wiper*>(v.data)[i].direction != 0;
      }
  }
  void pass(const PassCall&) override {}
  double arrived = 0;
  bool moved = false;
};

// From dry to a storm and back: no drop before the rain, arrivals as its integral says, wipers that wait, work and stop, and dry glass
// without a drop in the end.
TEST(KeyedDrive, DryStormDry) {
  constexpr double fps = 20;
  const std::string toml =
      "[run]\nfps = 20\nsize = [16, 9]\n[vehicle]\nspeed = 0\n[rain]\nkey_frames = '4 0; 8 120; 16 120; 20 0'\nsmallest_drop = 0.5\n"
      "[wipers]\nkey_frames = '0 off; 6 intermittent 3; 9 slow; 12 fast; 21.3 off'\n[windshield]\nheight_size = [60, 36]\nfilm_drying = "
      "1e-5\n"
      "capacity = 20000\nhumidity = 0\nlifetime = 8\n";
  const parallel::Executor executor(2);
  Windshield run(config_of("corrected", toml), small_surroundings(), executor);
  WeatherSettings weather;
  weather.rain_key_frames = "4 0; 8 120; 16 120; 20 0";
  const Weather rain(weather);
  double expected = 0;
  std::vector<bool> moved;
  for (int second = 0; second < 34; ++second) {
    Drive seen;
    for (int n = 0; n < 20; ++n) {
      run.simulate(&seen);
      // The glass lies at 27 degrees: flux cos(27) of what falls on level ground. The rate is that of the step's start.
      if (const double rate = rain.rain((20 * second + n) / fps); rate > 0)
        expected += rain::DropSizes(rate, 0.5).flux() * std::cos(27 * degree) * 1.12 / fps;
    }
    moved.push_back(seen.moved);
    if (second < 4) {
      EXPECT_EQ(run.drops().size(), 0u) << second;
    }
    if (second == 15) {
      EXPECT_GT(run.drops().size(), 2000u);
    }
    if (second == 33) {
      EXPECT_NEAR(seen.arrived, expected, 5 * std::sqrt(expected));
    }
  }
  EXPECT_GT(expected, 50000);
  EXPECT_EQ(run.drops().size(), 0u);
  EXPECT_EQ(run.mass_balance().film, 0);
  EXPECT_EQ(run.mass_balance().residual(), 0);
  // Off; one stroke from 6 s on, which takes 1.33 s; then all the time; the last one completed before 22 s.
  for (int second = 0; second < 34; ++second)
    EXPECT_EQ(moved[second], (second >= 6 && second < 8) || (second >= 9 && second < 22)) << second;
}

// As published the count of each step is that of the integral: after any time it is the whole part of it.
TEST(KeyedDrive, AsPublishedCountsTheIntegral) {
  const parallel::Executor executor(1);
  Windshield run(
      config_of("as-published",
                "[run]\nfps = 30\nsize = [16, 9]\n[rain]\nkey_frames = '1 0; 3 700; 5 0'\n[windshield]\nheight_size = [40, 24]\n"),
      small_surroundings(), executor);
  WeatherSettings weather;
  weather.rain_key_frames = "1 0; 3 700; 5 0";
  weather.most_rain = 1e6;
  const Weather rain(weather);
  for (int n = 0; n < 180; ++n) {
    Drive seen;
    run.simulate(&seen);
    ASSERT_EQ(seen.arrived, std::floor(rain.rained(n / 30.0) + 1e-6)) << n;
  }
  EXPECT_GT(rain.rained(6), 1000);
}

}  // namespace
}  // namespace rainref::windshield
