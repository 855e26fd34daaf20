// Panes wherever they stand in the car: the rain that reaches each over a drive against geometry, and what the eye sees through several.
#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include <fmt/format.h>

#include "drops/uniforms.h"
#include "rain/rain.h"
#include "rainref/error.h"
#include "windshield/golden_scenes.h"
#include "windshield/support.h"

namespace rainref::windshield {
namespace {

/// A pane of the test's car: corners seen from inside at the lower left, the lower right and the upper left, and what geometry says of
/// them.
struct TestPane {
  const char* name;
  Corners corners;
  Real3 normal;
  double area;
};
/// Turned out of the upright by `lean` toward the sky (negative: toward the road).
const std::vector<TestPane>& car() {
  static const std::vector<TestPane> panes = [] {
    const double s27 = std::sin(27 * degree), c27 = std::cos(27 * degree), s10 = std::sin(10 * degree), c10 = std::cos(10 * degree);
    const double half = std::sqrt(0.5);
    return std::vector<TestPane>{
        {"windshield, 27 degrees from the level",
         {{{1.9, 0.7, 1}, {1.9, -0.7, 1}, {1.9 - 0.8 * c27, 0.7, 1 + 0.8 * s27}}},
         {s27, 0, c27},
         1.12},
        {"rear window, 45 degrees", {{{-1, -0.6, 1}, {-1, 0.6, 1}, {-1 + 0.5 * half, -0.6, 1 + 0.5 * half}}}, {-half, 0, half}, 0.6},
        {"left window, leans in by 10", {{{0.2, 0.8, 0.9}, {1.2, 0.8, 0.9}, {0.2, 0.8 - 0.5 * s10, 0.9 + 0.5 * c10}}}, {0, c10, s10}, 0.5},
        {"right window, leans out by 10",
         {{{1.2, -0.8, 0.9}, {0.2, -0.8, 0.9}, {1.2, -0.8 - 0.5 * s10, 0.9 + 0.5 * c10}}},
         {0, -c10, -s10},
         0.5}};
  }();
  return panes;
}
std::string corners_text(const Corners& c) {
  std::string text;
  for (const Real3& p : c) text += fmt::format("{}{} {} {}", text.empty() ? "" : ", ", p[0], p[1], p[2]);
  return text;
}
/// The first as the windshield, the others as further panes.
std::string panes_toml(const std::vector<TestPane>& panes) {
  std::string toml = "[windshield]\n";
  for (int k = 0; k < 3; ++k)
    toml += fmt::format("corner_{} = [{}, {}, {}]\n", k, panes[0].corners[k][0], panes[0].corners[k][1], panes[0].corners[k][2]);
  std::string others;
  for (std::size_t i = 1; i < panes.size(); ++i) others += corners_text(panes[i].corners) + "; ";
  return toml + "panes = '" + others + "'\nheight_size = [40, 24]\ncapacity = 500\n";
}

/// Drops that arrived so far, by pane: spawn's ids count them.
class Arrivals : public Recorder {
 public:
  explicit Arrivals(int substeps = 1) : substeps_(substeps) {}
  bool reads(int, std::string_view) const override { return false; }
  void before(const PassStart& start) override {
    if (start.pass != "spawn") return;
    drops::SpawnUniforms u;
    std::memcpy(&u, start.uniforms.data(), sizeof u);
    before_[start.step / substeps_] = u.first_id;
  }
  void pass(const PassCall&) override {}
  /// Before the step that was recorded last.
  double of(int pane) const { return static_cast<double>(before_.at(pane)); }

 private:
  int substeps_;
  std::map<int, std::uint32_t> before_;
};

struct Rained {
  double drops = 0, water = 0;  ///< of a m^2; water in kg
};
/// Marshall and Palmer's drops of the air, moving with the wind and falling at Gunn and Kinzer's velocities, onto a m^2 with this outward
/// normal (world axes) that moves at `velocity`: each size by itself, none through the glass from behind. [1/s]
Rained flux_by_geometry(double rate, double smallest_mm, const Real3& normal, const Real3& velocity, const Real3& wind) {
  Rained sum;
  const double lambda = 4.1 * std::pow(rate, -0.21), step = 0.005;
  for (double d = smallest_mm + step / 2; d < 6; d += step) {
    const double fall = rain::terminal_velocity(d);
    const Real3 relative{wind[0] - velocity[0], wind[1] - velocity[1], wind[2] - velocity[2] - fall};
    const double arriving = 8000 * std::exp(-lambda * d) * step * std::max(0.0, -dot(relative, normal));
    sum.drops += arriving;
    sum.water += arriving * 998.2 * pi / 6 * d * d * d * 1e-9;
  }
  return sum;
}

constexpr const char* drive = "0 0 0; 10 0 0; 18 20 0; 30 20 0; 34 12 0.3; 38 12 0.3; 42 4 0; 60 4 0";

// Over a drive in a side wind, which stands, speeds up to 20 m/s, turns by more than a right angle to the left and goes on slowly. The
// normals are written down above, not those of the code.
TEST(AnyPane, RainOverADriveIsTheFluxOfGeometry) {
  constexpr double rate = 200, smallest = 0.5, fps = 20;
  constexpr int frames = 60 * 20;
  const Real3 wind{0, -3, 0};
  const parallel::Executor executor(2);
  Windshield run(
      config_of("corrected", fmt::format("[run]\nfps = {}\nsize = [16, 9]\n[vehicle]\nkey_frames = '{}'\n[world]\nwind = [0, -3, 0]\n"
                                         "[rain]\nrate = {}\nsmallest_drop = {}\n{}[wipers]\ncount = 0\n",
                                         fps, drive, rate, smallest, panes_toml(car()))),
      small_surroundings(), executor);
  ASSERT_EQ(run.panes(), 4);
  VehicleSettings settings;
  settings.key_frames = drive;
  const Vehicle vehicle(settings);
  std::vector<Rained> expected(car().size());
  for (int n = 0; n < frames; ++n) {
    run.simulate();
    const VehicleState now = vehicle.at((n + 0.5) / fps);
    const double c = std::cos(now.heading), s = std::sin(now.heading);
    for (std::size_t i = 0; i < car().size(); ++i) {
      const Real3& m = car()[i].normal;
      const Real3 world{c * m[0] - s * m[1], s * m[0] + c * m[1], m[2]};
      const Rained flux = flux_by_geometry(rate, smallest, world, {now.speed * c, now.speed * s, 0}, wind);
      expected[i].drops += flux.drops * car()[i].area / fps;
      expected[i].water += flux.water * car()[i].area / fps;
    }
  }
  Arrivals arrivals;
  run.simulate(&arrivals);
  fmt::print("{:<40}{:>12}{:>12}{:>8}{:>12}{:>12}{:>8}\n", "pane", "drops", "geometry", "%", "water [kg]", "geometry", "%");
  for (std::size_t i = 0; i < car().size(); ++i) {
    const int pane = static_cast<int>(i);
    const double drops = arrivals.of(pane), water = static_cast<double>(run.mass_balance(pane).spawned) * 2e-11;
    const double off = drops / expected[i].drops - 1, off_water = water / expected[i].water - 1;
    fmt::print("{:<40}{:>12.0f}{:>12.0f}{:>8.2f}{:>12.4f}{:>12.4f}{:>8.2f}\n", car()[i].name, drops, expected[i].drops, 100 * off, water,
               expected[i].water, 100 * off_water);
    EXPECT_GT(expected[i].drops, 30000) << car()[i].name;  // so that chance is well below 2 %
    EXPECT_LT(std::abs(off), 0.02) << car()[i].name;
    EXPECT_LT(std::abs(off_water), 0.02 + 3 / std::sqrt(expected[i].drops)) << car()[i].name;
    EXPECT_EQ(run.mass_balance(pane).residual(), 0);
  }
}

/// Arrivals on each pane in a second.
std::vector<double> in_a_second(const std::string& more) {
  const parallel::Executor executor(1);
  Windshield run(config_of("corrected", "[run]\nfps = 10\nsize = [16, 9]\n" + more + "[rain]\nrate = 100\n" + panes_toml(car()) +
                                            "[wipers]\ncount = 0\n"),
                 small_surroundings(), executor);
  for (int n = 0; n < 10; ++n) run.simulate();
  Arrivals arrivals;
  run.simulate(&arrivals);
  std::vector<double> out;
  for (int i = 0; i < run.panes(); ++i) out.push_back(arrivals.of(i));
  return out;
}
// Parked, rain reaches what looks up; at speed it misses the rear window, whose flux is negative; a wind reaches the side that it blows on.
TEST(AnyPane, ParkedAtSpeedAndInAWind) {
  const std::vector<double> parked = in_a_second("[vehicle]\nspeed = 0\n"), fast = in_a_second("[vehicle]\nspeed = 20\n"),
                            windy = in_a_second("[vehicle]\nspeed = 0\n[world]\nwind = [0, 8, 0]\n");
  EXPECT_GT(parked[0], 5000);
  EXPECT_GT(parked[1], 2000);
  EXPECT_GT(parked[2], 100);
  EXPECT_EQ(parked[3], 0);
  EXPECT_GT(fast[0], 1.5 * parked[0]);
  EXPECT_EQ(fast[1], 0);
  EXPECT_NEAR(fast[2], parked[2], 5 * std::sqrt(parked[2]));  // along the glass speed changes nothing
  EXPECT_EQ(windy[2], 0);
  EXPECT_GT(windy[3], 5000);
}

// ---- what is seen through several ------------------------------------------------------------------------------------------

/// Dry, from an eye that has windshield and left window in view.
std::string view_toml(const std::vector<TestPane>& panes) {
  return "[run]\nsize = [61, 37]\n[rain]\nrate = 0\n[camera]\nposition = [0.6, 0, 1.15]\ntarget = [1.6, 0.7, 1.15]\nvertical_fov_deg = "
         "60\n" +
         panes_toml(panes);
}
using Texel = std::array<std::uint16_t, 4>;
constexpr int columns = 61, rows = 37;
std::vector<Texel> seen_through(const std::vector<TestPane>& panes) {
  const parallel::Executor executor(1);
  Windshield run(config_of("corrected", view_toml(panes)), small_surroundings(), executor);
  run.next_frame();
  std::vector<Texel> all(columns * rows);
  for (int y = 0; y < rows; ++y)
    std::memcpy(&all[static_cast<std::size_t>(columns * y)], run.colour().row<Half>(y), columns * sizeof(Texel));
  return all;
}
TEST(AnyPane, EachPixelShowsThePaneThatItLooksThrough) {
  const TestPane &front = car()[0], &left = car()[2];
  const std::vector<Texel> both = seen_through({front, left}), through_front = seen_through({front}), through_left = seen_through({left});
  const Texel cabin = both[0];  // a corner of the picture, below the panes
  int on_front = 0, on_left = 0, beside = 0;
  for (std::size_t i = 0; i < both.size(); ++i) {
    const bool is_left = through_left[i] != cabin;
    EXPECT_EQ(both[i], is_left ? through_left[i] : through_front[i]) << i;
    (is_left ? on_left : through_front[i] == cabin ? beside : on_front) += 1;
  }
  EXPECT_GT(on_front, 50);
  EXPECT_GT(on_left, 50);
  EXPECT_GT(beside, 50);
}

// The windshield's own water does not hang on the panes beside it, and theirs is not its.
TEST(AnyPane, EachHasDropsOfItsOwn) {
  const parallel::Executor executor(2);
  for (const char* variant : {"as-published", "corrected"}) {
    const std::string more = std::string("[run]\nfps = 30\nsize = [16, 9]\n[vehicle]\nspeed = 6\n") +
                             (std::string(variant) == "corrected" ? "[rain]\nrate = 100\n" : "");
    const TestPane& front = car()[0];
    TestPane twin = front;
    for (Real3& p : twin.corners) p[2] += 0.5;
    Windshield one(config_of(variant, more + panes_toml({front})), small_surroundings(), executor),
        two(config_of(variant, more + panes_toml({front, twin})), small_surroundings(), executor);
    for (int n = 0; n < 20; ++n) one.next_frame(), two.next_frame();
    const std::vector<DropView> alone = one.drops(), first = two.drops(0), second = two.drops(1);
    ASSERT_EQ(alone.size(), first.size());
    ASSERT_GT(alone.size(), 50u);
    ASSERT_GT(second.size(), 50u);
    for (std::size_t i = 0; i < alone.size(); ++i) EXPECT_TRUE(alone[i].u == first[i].u && alone[i].mass == first[i].mass);
    EXPECT_NE(first[0].u, second[0].u);
    EXPECT_EQ(two.mass_balance(1).residual(), 0);
    EXPECT_EQ(usage_error([&] { two.drops(2); }), "pane: expected a number from 0 to 1, found 2");
  }
}

std::string refusal(const std::string& toml) {
  const parallel::Executor executor(1);
  return usage_error([&] { Windshield(config_of("corrected", toml), small_surroundings(), executor); });
}
TEST(AnyPane, WhatCannotBeIsNamed) {
  using testing::HasSubstr;
  EXPECT_THAT(refusal("[windshield]\npanes = '1 0 0, 1 1 0'\n"), HasSubstr("windshield.panes, pane 1: expected \"x y z, x y z, x y z\""));
  EXPECT_THAT(refusal("[windshield]\npanes = '1 0 0, 1 1 0, 1 2 0'\n"),
              HasSubstr("windshield.panes, pane 1: expected three corners of a plane"));
  EXPECT_THAT(refusal("[windshield]\npanes = '1 0 x, 1 1 0, 1 2 0'\n"), HasSubstr("windshield.panes, pane 1"));
  EXPECT_THAT(refusal("[windshield]\npanes = '1 0 nan, 1 1 0, 1 2 0'\n"), HasSubstr("windshield.panes, pane 1"));
  // Corners in the order of who stands outside: the eye is before the outer side.
  EXPECT_THAT(refusal("[windshield]\ncorner_0 = [1.9, -0.7, 1]\ncorner_1 = [1.9, 0.7, 1]\ncorner_2 = [1.4, -0.7, 1.5]\n"),
              testing::AllOf(HasSubstr("camera.position: expected an eye behind the glass, found one"), HasSubstr("lower left")));
  EXPECT_THAT(refusal("[windshield]\npanes = '0.2 0.8 0.9, 1.2 0.8 0.9, 0.2 0.8 1.4; 1.2 0.8 0.9, 0.2 0.8 0.9, 1.2 0.8 1.4'\n"),
              HasSubstr("expected an eye behind windshield.panes, pane 2, found one"));
}

}  // namespace
}  // namespace rainref::windshield
