// Drive cycles: totals that regulations publish, smoothness of the curve, and every way in which a table may be wrong.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "base/error_of.h"
#include "windshield/support.h"
#include "source_folder.h"

namespace rainref::windshield {
namespace {

const std::string cycles = rainref::test::source_folder() + "/scenes/windshield/cycles/";
using testing::HasSubstr;

/// What is published of a cycle, to the digits that were; of the NEDC the distances of its parts, which its own operations pass by 6 m.
struct Known {
  const char* file;
  double seconds, metres, published, tolerance, top;  ///< metres: sum of the samples; top: [m/s]
};
constexpr double mile = 1609.344, mph = 0.44704, kmh = 1 / 3.6;
constexpr Known known_cycles[] = {{"wltc_3b.csv", 1800, 23266.3, 23266, 0.5, 131.3 * kmh},
                                  {"us06.csv", 600, 12887.6, 8.01 * mile, 0.005 * mile, 80.3 * mph},
                                  {"udds.csv", 1369, 11990.4, 7.45 * mile, 0.005 * mile, 56.7 * mph},
                                  {"nedc.csv", 1180, 11013.2, 4 * 1013 + 6955, 7, 120 * kmh}};

// The samples are h = 1 s apart. Between two of them the cubic's integral is the trapezoid's and h^2 (m0 - m1) / 12 of the
// slopes at its ends: the sum over the table telescopes, and a cycle begins and ends at rest, so nothing of it is left.
// 0.05 m is the rounding of the sums above.
TEST(DriveCycle, TotalsAreTheRegulations) {
  for (const Known& k : known_cycles) {
    const DriveCycle c = read_drive_cycle(cycles + k.file);
    const double distance = c.speed.integral(0, k.seconds);
    double trapezoids = 0;
    for (int t = 0; t < k.seconds; ++t) trapezoids += (c.speed.value(t) + c.speed.value(t + 1)) / 2;
    EXPECT_NEAR(distance, trapezoids, 1e-8) << k.file;  // 1800 additions of at most 23 km, 3e-12 each
    EXPECT_NEAR(distance, k.metres, 0.05) << k.file;
    EXPECT_NEAR(distance, k.published, k.tolerance) << k.file;
    // It takes as long as it should: at rest at the end, and nothing beyond.
    EXPECT_EQ(c.speed.value(k.seconds), 0) << k.file;
    EXPECT_EQ(c.speed.integral(k.seconds, k.seconds + 100), 0) << k.file;
    EXPECT_EQ(c.yaw_rate.value(100), 0);
  }
}

// The curve passes through its samples and never beyond them, so its top speed is the table's: 0.02 m/s are half of the
// last digit published.
TEST(DriveCycle, PeaksAreTheRegulations) {
  for (const Known& k : known_cycles) {
    const DriveCycle c = read_drive_cycle(cycles + k.file);
    double most = 0, least = 0, most_sampled = 0;
    for (int i = 0; i <= 10 * k.seconds; ++i) {
      const double v = c.speed.value(0.1 * i);
      most = std::max(most, v);
      least = std::min(least, v);
      if (i % 10 == 0) most_sampled = std::max(most_sampled, v);
    }
    EXPECT_NEAR(most, k.top, 0.025) << k.file;
    EXPECT_EQ(most, most_sampled) << k.file;
    EXPECT_EQ(least, 0) << k.file;
  }
}

// UN/ECE R83 gives the NEDC as operations, straight lines between these times [s] and speeds [km/h], all at whole seconds:
// trapezoids of 1 s are then exact. The extra-urban part is published as 6.955 km.
TEST(DriveCycle, TheNedcIsTheRegulationsOperations) {
  using Operations = std::vector<std::array<double, 2>>;
  const Operations urban{{0, 0},    {11, 0},   {15, 15},  {23, 15},  {25, 10},  {28, 0},   {49, 0},   {54, 15},  {56, 15},
                         {61, 32},  {85, 32},  {93, 10},  {96, 0},   {117, 0},  {122, 15}, {124, 15}, {133, 35}, {135, 35},
                         {143, 50}, {155, 50}, {163, 35}, {176, 35}, {178, 32}, {185, 10}, {188, 0},  {195, 0}};
  const Operations extra_urban{{0, 0},     {20, 0},    {25, 15},  {27, 15},  {36, 35},  {38, 35},  {46, 50},   {48, 50},
                               {61, 70},   {111, 70},  {119, 50}, {188, 50}, {201, 70}, {251, 70}, {286, 100}, {316, 100},
                               {336, 120}, {346, 120}, {362, 80}, {370, 50}, {380, 0},  {400, 0}};
  const DriveCycle c = read_drive_cycle(cycles + "nedc.csv");
  constexpr double digits = 5e-6;  // the table has five
  const auto expect_part = [&](const Operations& all, double from) {
    double metres = 0;
    for (std::size_t i = 1; i < all.size(); ++i) {
      const auto [t0, v0] = all[i - 1];
      const auto [t1, v1] = all[i];
      metres += (v0 + v1) / 2 * (t1 - t0) * kmh;
      for (double t = t0; t <= t1; ++t)
        EXPECT_NEAR(c.speed.value(from + t), (v0 + (v1 - v0) * (t - t0) / (t1 - t0)) * kmh, 1.01 * digits) << from + t;
    }
    const double last = all.back()[0];
    EXPECT_NEAR(c.speed.integral(from, from + last), metres, last * digits);
    return metres;
  };
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(expect_part(urban, 195 * k), 1014.6, 0.05);
  EXPECT_NEAR(expect_part(extra_urban, 780), 6955, 0.5);
}

// The derivative is that of the value and the value that of the integral, by central differences; all three are
// continuous at the samples.
TEST(DriveCycle, DerivativeAndIntegralAreExact) {
  const DriveCycle c = parse_key_frames("0 0 0; 3 12 0.2; 4 13 -0.3; 9 13 0; 11.5 2 0.1; 14 7 0", "k");
  const double h = 1e-4;
  for (const Pchip* curve : {&c.speed, &c.yaw_rate}) {
    for (double t = 0.05; t < 14; t += 0.1) {
      // Cubics: a central difference is off by h^2 / 6 of the third derivative, below 1e3 here, and 1e-16 / h of
      // rounding.
      EXPECT_NEAR((curve->value(t + h) - curve->value(t - h)) / (2 * h), curve->derivative(t), 1e-5) << t;
      EXPECT_NEAR(curve->integral(t - h, t + h) / (2 * h), curve->value(t), 1e-6) << t;
    }
    for (const double knot : {3.0, 4.0, 9.0, 11.5}) {
      EXPECT_NEAR(curve->value(knot - 1e-9), curve->value(knot + 1e-9), 1e-7);
      EXPECT_NEAR(curve->derivative(knot - 1e-9), curve->derivative(knot + 1e-9), 1e-6);
    }
  }
  EXPECT_EQ(c.speed.value(3), 12);
  EXPECT_EQ(c.speed.derivative(9.0), 0);   // a corner of the table is flat: level before, falling after
  EXPECT_EQ(c.speed.derivative(11.5), 0);  // a minimum as well
}

// A straight line is kept; on x^2 the inner slopes are the harmonic means of the chords, written out here.
TEST(DriveCycle, SlopesAreFritschAndButlands) {
  const Pchip line({0, 1, 3, 7}, {1, 3, 7, 15});
  for (const double t : {0.0, 0.3, 1.0, 2.2, 5.0, 7.0}) {
    EXPECT_NEAR(line.value(t), 1 + 2 * t, 1e-14);
    EXPECT_NEAR(line.derivative(t), 2, 1e-14);
  }
  const Pchip parabola({0, 1, 2, 3}, {0, 1, 4, 9});
  EXPECT_NEAR(parabola.derivative(1), 2 * 1 * 3 / (1 + 3.0), 1e-15);
  EXPECT_NEAR(parabola.derivative(2), 2 * 3 * 5 / (3 + 5.0), 1e-15);
  EXPECT_NEAR(parabola.derivative(0), 0, 1e-15);  // the parabola through the first three points
  EXPECT_NEAR(parabola.derivative(3), 6, 1e-14);
  // Steps of 1 and 2, chords of 1 and 2: the weight of a chord grows with the other step.
  EXPECT_NEAR(Pchip({0, 1, 3}, {0, 1, 5}).derivative(1), (5 + 4) / (5 / 1.0 + 4 / 2.0), 1e-15);
  EXPECT_EQ(parabola.value(-5), 0);
  EXPECT_EQ(parabola.value(8), 9);
  EXPECT_EQ(parabola.derivative(8), 0);
  EXPECT_NEAR(parabola.integral(-2, 5) - parabola.integral(0, 3), 18, 1e-13);
}

TEST(DriveCycle, CommentsSpacesAndWindowsLineEndsAreAccepted) {
  const DriveCycle c =
      parse_drive_cycle("\xef\xbb\xbf# a comment\r\n\r\nspeed_mps , time_s,yaw_rad_s\r\n 5,0,0\r\n# another\r\n10,2,0.5\r\n", "f.csv");
  EXPECT_EQ(c.speed.value(0), 5);
  EXPECT_EQ(c.speed.value(1), 7.5);
  EXPECT_EQ(c.yaw_rate.value(2), 0.5);
}

TEST(DriveCycle, DamageIsNamedWithFileAndLine) {
  const auto message = [](const std::string& csv) { return usage_error([&] { parse_drive_cycle(csv, "f.csv"); }); };
  const std::string head = "time_s,speed_mps\n0,0\n";
  EXPECT_EQ(message(head + "1,nan\n"), "f.csv:3: speed_mps: expected a number, found 'nan'");
  EXPECT_EQ(message(head + "1,inf\n"), "f.csv:3: speed_mps: expected a number, found 'inf'");
  EXPECT_EQ(message(head + "1,\n"), "f.csv:3: speed_mps: expected a number, found ''");
  EXPECT_EQ(message(head + "1s,4\n"), "f.csv:3: time_s: expected a number, found '1s'");
  EXPECT_EQ(message(head + "# gap\n\n0,4\n"), "f.csv:5: time_s: expected more than 0 of the row before, found 0");
  EXPECT_EQ(message(head + "1,-2\n"), "f.csv:3: speed_mps: expected 0 to 100 m/s, found -2");
  EXPECT_EQ(message(head + "1,131\n"), "f.csv:3: speed_mps: expected 0 to 100 m/s, found 131");
  EXPECT_EQ(message(head + "1,2,3\n"), "f.csv:3: expected 2 fields, found 3");
  EXPECT_EQ(message("time_s,speed_mps,yaw_rad_s\n0,0,99\n"), "f.csv:2: yaw_rad_s: expected -10 to 10 rad/s, found 99");
  EXPECT_THAT(message(head), HasSubstr("f.csv:3: expected at least two rows, found 1"));
  EXPECT_THAT(message("time_s,yaw_rad_s\n"),
              HasSubstr("f.csv:1: expected a header of time_s,speed_mps[,yaw_rad_s], found none of the column 'speed_mps'"));
  EXPECT_THAT(message("time_s,speed_mp\n"), HasSubstr("found the column 'speed_mp'; did you mean 'speed_mps'?"));
  EXPECT_THAT(message("time_s,time_s\n"), HasSubstr("the column 'time_s' stands twice"));
  EXPECT_THAT(message("0,0\n1,1\n"), HasSubstr("f.csv:1: expected a header"));
  EXPECT_THAT(message("# nothing\n"), HasSubstr("found no line with text"));
  EXPECT_THAT(message(""), HasSubstr("found no line with text"));
}

TEST(DriveCycle, KeyFramesAreTheSameTableInline) {
  const DriveCycle c = parse_key_frames("0 0; 10 13.9;20 0;", "vehicle.key_frames");
  EXPECT_EQ(c.speed.value(10), 13.9);
  EXPECT_EQ(c.speed.derivative(10), 0);
  const auto message = [](const std::string& text) { return usage_error([&] { parse_key_frames(text, "vehicle.key_frames"); }); };
  EXPECT_EQ(message("0 0; 10 13.9; 10 0"), "vehicle.key_frames, key frame 3: time_s: expected more than 10 of the row before, found 10");
  EXPECT_EQ(message("0 0; 10 -1"), "vehicle.key_frames, key frame 2: speed_mps: expected 0 to 100 m/s, found -1");
  EXPECT_EQ(message("0 0 0; 10 1"),
            "vehicle.key_frames, key frame 2: expected \"time speed\" in every one or \"time speed yaw_rate\" in every "
            "one, found '10 1'");
  EXPECT_THAT(message("0"), HasSubstr("key frame 1: expected \"time speed\""));
  EXPECT_THAT(message("0 0"), HasSubstr("expected at least two rows, found 1"));
}

TEST(DriveCycle, AMissingFileIsAnIoError) {
  EXPECT_THAT(error_of([] { read_drive_cycle("no/such.csv"); }), testing::AllOf(testing::StartsWith("4 "), HasSubstr("no/such.csv")));
}

}  // namespace
}  // namespace rainref::windshield
