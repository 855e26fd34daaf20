// Where the car drives under bridges and through tunnels: when a pane is under them, and that no rain falls there.
#include "windshield/motion/shelter.h"

#include <gtest/gtest.h>

#include "drops/host.h"
#include "drops/uniforms.h"
#include "windshield/golden_scenes.h"
#include "windshield/support.h"
#include "windshield/wet_pane.h"

namespace rainref::windshield {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

VehicleSettings at_speed(double speed) {
  VehicleSettings s;
  s.speed = speed;
  return s;
}

TEST(DriveShelter, ShareOfTheTimeInTheOpen) {
  const Vehicle car(at_speed(10));
  const Shelter s(parse_shelter("20 50; 70 80"), car, 0);  // 2 to 5 s, 7 to 8 s
  EXPECT_EQ(s.open_share(0, 1), 1);
  EXPECT_EQ(s.open_share(0, 2), 1);
  EXPECT_EQ(s.open_share(2, 5), 0);
  EXPECT_EQ(s.open_share(3.1, 3.1 + 1.0 / 60), 0) << "exactly";
  EXPECT_EQ(s.open_share(100, 101), 1);
  // A rounding of each end and of the quotient, in parts of a second.
  EXPECT_NEAR(s.open_share(0, 10), 0.6, 1e-15);
  EXPECT_NEAR(s.open_share(1.75, 2.25), 0.5, 2e-15);
  EXPECT_NEAR(s.open_share(4, 9), 0.6, 1e-15);
  EXPECT_TRUE(s.is_open_until(2));
  EXPECT_FALSE(s.is_open_until(2.001));
}

// What is carried before the origin comes under a roof sooner and leaves it sooner.
TEST(DriveShelter, APaneIsWhereItsMiddleIs) {
  const Vehicle car(at_speed(10));
  const Shelter front(parse_shelter("20 50"), car, 2), rear(parse_shelter("20 50"), car, -1);  // 1.8 to 4.8 s, 2.1 to 5.1 s
  EXPECT_NEAR(front.open_share(1.5, 2), 0.6, 2e-15);
  EXPECT_EQ(front.open_share(4.9, 5), 1);
  EXPECT_NEAR(rear.open_share(5, 6), 0.9, 2e-15);
  EXPECT_EQ(rear.open_share(2, 2.1), 1);
}

// Parked it is under the roof for ever or never; a car that stops below one waits there as long as it stands.
TEST(DriveShelter, ParkedAndWaiting) {
  const Vehicle parked(at_speed(0));
  EXPECT_EQ(Shelter(parse_shelter("-1 5"), parked, 0).open_share(1e5, 1e5 + 1), 0);
  EXPECT_EQ(Shelter(parse_shelter("0 5"), parked, 0).open_share(0, 1), 0) << "the stretch has its beginning";
  EXPECT_EQ(Shelter(parse_shelter("-5 0"), parked, 0).open_share(0, 1), 1) << "and not its end";
  EXPECT_EQ(Shelter(parse_shelter("1 5"), parked, 0).open_share(0, 1), 1);
  EXPECT_EQ(Shelter({}, parked, 0).open_share(0, 1), 1);

  VehicleSettings stopping;
  stopping.key_frames = "0 10; 2 10; 4 0; 24 0; 26 10";
  const Vehicle car(stopping);
  const double stop = car.at(4).distance;
  EXPECT_EQ(car.at(24).distance, stop);
  const Shelter s(parse_shelter(fmt::format("{} {}", stop - 0.5, stop + 0.5)), car, 0);
  EXPECT_EQ(s.open_share(4, 24), 0);
  EXPECT_EQ(s.open_share(0, 3), 1);
  EXPECT_EQ(s.open_share(26, 30), 1);
}

// Of a drive whose speed changes: the open time summed over moments whose place is in the open. Sum of a million moments of 40 us: each of
// the four ends is missed by half of one at most.
TEST(DriveShelter, SpeedChanges) {
  VehicleSettings settings;
  settings.key_frames = "0 2; 10 20; 20 5; 40 12";
  const Vehicle car(settings);
  const std::vector<Stretch> roofs = parse_shelter("30 90; 200.5 300");
  const Shelter s(roofs, car, 1.5);
  int open = 0;
  constexpr int moments = 1000000;
  for (int k = 0; k < moments; ++k) open += !is_covered(roofs, car.at((k + 0.5) * 40.0 / moments).distance + 1.5);
  EXPECT_NEAR(s.open_share(0, 40), open / double{moments}, 2.0 / moments);
}

std::vector<double> ends(const char* text) {
  std::vector<double> all;
  for (const Stretch& s : parse_shelter(text)) all.insert(all.end(), {s.from, s.to});
  return all;
}
TEST(DriveShelter, StretchesAreOrderedAndJoined) {
  EXPECT_THAT(ends(""), ElementsAre());
  EXPECT_THAT(ends(" ; "), ElementsAre());
  EXPECT_THAT(ends("70 80; 20 50;"), ElementsAre(20, 50, 70, 80));
  EXPECT_THAT(ends("20 50; 50 60; 10 15; 25 30"), ElementsAre(10, 15, 20, 60));
}

TEST(DriveShelter, WhatCannotBeIsNamed) {
  const auto message = [](const std::string& text) { return usage_error([&] { parse_shelter(text); }); };
  EXPECT_EQ(message("1 2; 5"),
            "rain.shelter, stretch 2: expected \"from to\", ascending numbers of at most 10000000 m, and at most 64 stretches; found '5'");
  for (const char* row : {"5 5", "6 5", "1 2 3", "a 5", "1 nan", "1 inf", "-1e8 0", "1 1e8"})
    EXPECT_THAT(message(row), HasSubstr(fmt::format("stretch 1: expected \"from to\", ascending numbers of at most 10000000 m, and at "
                                                    "most 64 stretches; found '{}'",
                                                    row)));
  std::string many;
  for (int k = 0; k < 64; ++k) many += fmt::format("{} {};", k, k + 0.5);
  EXPECT_EQ(message(many), "");
  EXPECT_THAT(message(many + "70 71"), HasSubstr("stretch 65"));
  for (const char* variant : {"as-published", "corrected"})
    EXPECT_THAT(usage_error([&] { settings_from(config_of(variant, "[rain]\nshelter = '3 2'\n")); }), HasSubstr("rain.shelter, stretch 1"));
}

/// Drops that arrived on the windshield before the last step.
class Arrived : public Recorder {
 public:
  void before(const PassStart& start) override {
    if (start.pass == "spawn" && start.step == 0) count = reinterpret_cast<const drops::SpawnUniforms*>(start.uniforms.data())->first_id;
  }
  void pass(const PassCall&) override {}
  double count = 0;
};

constexpr const char* small_drive = "[run]\nfps = 20\nsize = [16, 9]\n[vehicle]\nspeed = 9\n[windshield]\nheight_size = [40, 24]\n";

// Half of the way is covered, in stretches that begin and end anywhere in frames: half of the drops of that rain come, a Poisson number.
TEST(ShelteredDrive, HalfTheWayIsHalfTheDrops) {
  std::string stretches;
  for (int k = 0; k < 50; ++k) stretches += fmt::format("{} {};", 4 * k, 4 * k + 2);
  const parallel::Executor executor(2);
  const scene::Config config = config_of(
      "corrected", std::string(small_drive) + "lifetime = 1\n[rain]\nrate = 60\nsmallest_drop = 0.5\nshelter = '" + stretches + "'\n");
  const Settings settings = settings_from(config);
  Windshield run(config, small_surroundings(), executor);
  Arrived arrived;
  constexpr int frames = 444;  // 50 times 4 m at 9 m/s: 22.2 s; a frame is 0.45 m
  for (int n = 0; n <= frames; ++n) run.simulate(&arrived);
  const Glass glass = make_glass(settings.corners);
  const double flux =
      drops::flux(settings.drops, glass.normal[2], wind_along_normal(glass, Vehicle(settings.vehicle).at(0), {0, 0, 0})).drops;
  const double in_the_open = flux * glass.area * frames / 20, expected = 0.5 * in_the_open;
  ASSERT_GT(expected, 10000);
  // Five times the root; and the windshield begins within a stretch and ends within one: half a stretch of time at most.
  EXPECT_NEAR(arrived.count, expected, 5 * std::sqrt(expected) + flux * glass.area * 0.5 * 2 / 9);
}

// Of steps that a roof's edge cuts the mean is the share of the open time, to a rounding.
TEST(ShelteredDrive, MeanOfAStepIsTheOpenShare) {
  const auto thresholds = [](const std::string& shelter) {
    const parallel::Executor executor(1);
    Windshield run(config_of("corrected", std::string(small_drive) + "[rain]\nrate = 60\nshelter = '" + shelter + "'\n"),
                   small_surroundings(), executor);
    struct : Recorder {
      void before(const PassStart& start) override {
        if (start.pass != "spawn") return;
        for (const PassInput& in : start.inputs)
          if (in.name == "count_thresholds") {
            const RecordView& v = std::get<RecordView>(in.content);
            const auto* t = static_cast<const drops::CountThreshold*>(v.data);
            // 1 - P(no drop) and so on, of 2^32: the sum over thresholds is the mean of a Poisson number above its first.
            mean = reinterpret_cast<const drops::SpawnUniforms*>(start.uniforms.data())->first_count;
            for (std::size_t i = 0; i < v.count; ++i) mean += 1 - t[i].threshold * 0x1p-32;
          }
      }
      void pass(const PassCall&) override {}
      double mean = 0;
    } recorder;
    run.simulate(&recorder);
    return recorder.mean;
  };
  const double all = thresholds("");
  // The middle of the windshield, before the car by 1.9 m - 0.8 m cos(27 deg) / 2, drives 0.45 m in the step.
  const double middle = 1.9 - 0.4 * std::cos(27 * degree);
  ASSERT_GT(all, 5);
  for (const double share : {0.0, 0.25, 0.7})
    EXPECT_NEAR(thresholds(fmt::format("{:.12f} 100", middle + share * 0.45)), share * all, 1e-6 * all)
        << share;  // 2^-32 of each threshold
}

// In a tunnel no drop comes on any pane, and what is on the glass is wiped and dries.
TEST(ShelteredDrive, NothingFallsInATunnel) {
  for (const std::string variant : {"as-published", "corrected"}) {
    const parallel::Executor executor(2);
    Windshield run(
        config_of(variant, std::string(small_drive) + "panes = '0.2 0.8 0.9, 1.2 0.8 0.9, 0.2 0.7 1.5'\nlifetime = 3\n" +
                               (variant == "corrected" ? "[rain]\nrate = 60\n" : "spawn_rate = 900\n[rain]\n") + "shelter = '18 1000'\n"),
        small_surroundings(), executor);
    Arrived arrived;
    double at_entry = 0;
    for (int n = 0; n < 160; ++n) {
      run.simulate(&arrived);
      // The windshield's middle is there after 1.83 s, the side window's after 1.92 s.
      if (n == 38) {
        at_entry = arrived.count;
        EXPECT_GT(run.drops(1).size(), 0u);
      }
    }
    EXPECT_GT(at_entry, 400) << variant;
    EXPECT_EQ(arrived.count, at_entry) << variant;
    EXPECT_EQ(run.drops(0).size(), 0u) << variant;
    EXPECT_EQ(run.drops(1).size(), 0u) << variant;
    EXPECT_EQ(run.mass_balance().residual(), 0);
  }
}

// As published the count of each step is that of the integral over the open time: after any time it is the whole part of it.
TEST(ShelteredDrive, AsPublishedCountsTheOpenTime) {
  for (const std::string rain : {"spawn_rate = 700\n[rain]\n", "[rain]\nkey_frames = '0 700; 1 700'\n"}) {
    const parallel::Executor executor(1);
    Windshield run(config_of("as-published", std::string(small_drive) + rain + "shelter = '4 9.3; 12 12.1'\n"), small_surroundings(),
                   executor);
    const double middle = 1.9 - 0.4 * std::cos(27 * degree);
    const auto open_time = [&](double t) {
      const auto under = [&](double from, double to) { return std::max(std::min(t, (to - middle) / 9) - (from - middle) / 9, 0.0); };
      return t - under(4, 9.3) - under(12, 12.1);
    };
    for (int n = 0; n < 40; ++n) {
      Arrived seen;
      run.simulate(&seen);
      ASSERT_EQ(seen.count, std::floor(700 * open_time(n / 20.0) + 1e-6)) << n;
    }
  }
}

std::vector<std::string> hashes(const std::string& variant, const std::string& toml) {
  const parallel::Executor executor(2);
  Windshield run(config_of(variant, toml), small_surroundings(), executor);
  std::vector<std::string> lines;
  for (int n = 0; n < 6; ++n) {
    capture::HashRecorder recorder;
    run.next_frame(&recorder);
    for (const capture::HashLine& line : recorder.take_lines()) lines.push_back(line.text());
  }
  return lines;
}
// A roof that is not met changes no bit.
TEST(ShelteredDrive, ARoofElsewhereIsNone) {
  for (const std::string variant : {"as-published", "corrected"}) {
    const std::string drive = std::string(small_drive) + (variant == "corrected" ? "" : "spawn_rate = 961.7\n") +
                              "[falling_rain]\non = true\n[rain]\n" + (variant == "corrected" ? "rate = 80\n" : "");
    EXPECT_EQ(hashes(variant, drive + "shelter = '-9 -7; 5000 6000'\n"), hashes(variant, drive)) << variant;
    EXPECT_NE(hashes(variant, drive + "shelter = '2 6000'\n"), hashes(variant, drive)) << variant;
  }
}

// The streaks behind the glass are those of the run without a roof whose places are in the open.
TEST(ShelteredDrive, RainBehindTheGlassEndsAtTheRoof) {
  const parallel::Executor executor(1);
  const std::string drive = std::string(small_drive) + "[falling_rain]\non = true\nsmallest_drop = 0.5\n[rain]\nrate = 80\n";
  Windshield plain(config_of("corrected", drive), small_surroundings(), executor),
      sheltered(config_of("corrected", drive + "shelter = '8 12'\n"), small_surroundings(), executor);
  for (int n = 0; n < 30; ++n) {
    plain.next_frame();
    sheltered.next_frame();
    std::vector<double> expected, found;
    const double driven = 9 * (n / 20.0);
    for (const FallingDropView& d : plain.falling()) {
      const double place = driven + 0.5 * (d.from[0] + d.to[0]);
      if (place < 8 || place >= 12) expected.push_back(d.from[1]);
    }
    for (const FallingDropView& d : sheltered.falling()) found.push_back(d.from[1]);
    ASSERT_EQ(found, expected) << n;
    if (n == 10) {
      EXPECT_LT(found.size(), plain.falling().size());
    }
  }
}

}  // namespace
}  // namespace rainref::windshield
