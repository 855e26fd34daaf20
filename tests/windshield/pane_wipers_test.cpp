// Wipers of further panes: what a rear wiper clears against the geometry of its stroke, and that it clears nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "windshield/golden_scenes.h"
#include "windshield/parameters.h"
#include "windshield/sweep_geometry.h"

namespace rainref::windshield {
namespace {

using testing::HasSubstr;

/// A rear window of 1.2 m x 0.5 m at 45 degrees, and an upright left one; texels of 2.5 mm.
constexpr const char* car = R"([run]
fps = 60
size = [16, 9]
[vehicle]
speed = 0
[wipers]
count = 0
[windshield]
panes = "-1 -0.6 1, -1 0.6 1, -0.6464466094067263 -0.6 1.3535533905932737; 0.2 0.8 0.9, 1.2 0.8 0.9, 0.2 0.8 1.4"
height_size = [560, 320]
mask_tau = 4
)";
/// Its whole sweep lies on the rear window.
constexpr Blade rear_blade{{0.6, -0.02}, 0.12, 0.45, 25 * degree, 130 * degree, 0};
constexpr const char* rear_wiper = R"([pane_1_wipers]
count = 1
arrangement = "custom"
half_width = 0.02
pivot_0 = [0.6, -0.02]
inner_radius_0 = 0.12
outer_radius_0 = 0.45
start_angle_0 = 25
sweep_0 = 130
)";
constexpr double half_width = 0.02;

/// The stroke in one record, in the plane of the rear window.
Wiper whole_stroke(const PlaneFrame& plane) {
  WiperSettings s;
  s.blades = {rear_blade};
  s.cycles_per_minute = 60;
  s.half_width = half_width;
  return wipers_between(s, plane, 0, 0.5, true).at(0);
}
Windshield make(const std::string& variant, const std::string& more) {
  static const parallel::Executor executor(2);
  return Windshield(config_of(variant, car + more), small_surroundings(), executor);
}
bool is_zero(const Image& mask) {
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x)
      if (to_float(mask.row<Half>(y)[x]) != 0) return false;
  return true;
}

class PaneWipers : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Variants, PaneWipers, testing::Values("as-published", "corrected"),
                         [](const auto& i) { return i.param == std::string("corrected") ? "corrected" : "as_published"; });

// A stroke over, the texels of the rear window just wiped are those of the widened sector, whose area is that of the formula; no other
// texel of any pane was.
TEST_P(PaneWipers, AStrokeClearsItsArcAndNothingElse) {
  // As published outlines of single frames are wiped: at this speed they overlap at the tip.
  Windshield run = make(GetParam(), rear_wiper + std::string("cycles_per_minute = 24\n"));
  for (int n = 0; n < 76; ++n) {  // as published the blade stands in the first frame
    run.simulate();
    run.skip();
  }
  const Image& mask = run.mask(1);
  const double texel = 2.5e-3, length = rear_blade.outer_radius - rear_blade.inner_radius,
               middle = 0.5 * (rear_blade.outer_radius + rear_blade.inner_radius), turn = rear_blade.sweep;
  ASSERT_EQ(mask.width(), 480);
  ASSERT_EQ(mask.height(), 200);
  const Wiper stroke = whole_stroke({{1.2, 0, 0.5}, {1 / 1.2, 0, 2}});
  int cleared = 0;
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      const double distance = sweep_distance(stroke, {(x + 0.5) * texel, (y + 0.5) * texel});
      const float wiped = to_float(mask.row<Half>(y)[x]);
      cleared += wiped > 0.25f;
      // Half a texel of soft edge to either side, and what frames' outlines as published leave between them at the tip.
      if (distance > half_width + texel) {
        ASSERT_EQ(wiped, 0) << x << " " << y;
      } else if (distance < half_width - 2 * texel) {
        ASSERT_GT(wiped, 0.25f) << x << " " << y;
      }
    }
  }
  const double area = (length + 2 * half_width) * middle * turn + 2 * half_width * length + pi * half_width * half_width;
  const double outline = 2 * length + 2 * middle * turn + 2 * pi * half_width;
  EXPECT_NEAR(cleared * texel * texel, area, outline * texel);
  EXPECT_TRUE(is_zero(run.mask(0)));
  EXPECT_TRUE(is_zero(run.mask(2)));
}

// Rain falls, then stops, then the rear wiper makes a stroke: nothing is left in its arc, and the drops of the other panes are those
// that they would be without it, bit for bit.
TEST(PaneWipersCorrected, ItsDropsAreGoneAndAllOthersStay) {
  const std::string rain = "[rain]\nkey_frames = '0 60; 0.5 60; 0.6 0'\nsmallest_drop = 0.5\n";
  Windshield wiped = make("corrected", rain + rear_wiper + "cycles_per_minute = 60\nkey_frames = '0 off; 1 slow'\n"),
             other = make("corrected", rain);
  for (int n = 0; n < 90; ++n) {
    wiped.simulate();
    other.simulate();
  }
  const PlaneFrame plane{{1.2, 0, 0.5}, {1 / 1.2, 0, 2}};
  const Wiper stroke = whole_stroke(plane);
  const auto distance = [&](const DropView& d) {
    const Real2 p = plane.to_plane({d.u, d.v});
    return sweep_distance(stroke, {p[0], p[1]});
  };
  const auto ids = [&](const Windshield& run, bool inside) {
    std::set<std::uint32_t> all;
    for (const DropView& d : run.drops(1)) {
      const double away = distance(d);
      const Real2 p = plane.to_plane({d.u, d.v});
      // Where the blade stands now it has drops beside it.
      if (inside && away < half_width && blade_distance(stroke, 155 * degree, {p[0], p[1]}) > 0.05) all.insert(d.id);
      // To the left runs what it pushed there, beyond the tip flies some of it.
      if (!inside && away > half_width + 0.05 && p[0] > 0.6) all.insert(d.id);
    }
    return all;
  };
  EXPECT_GT(ids(other, true).size(), 200u);
  EXPECT_EQ(ids(wiped, true).size(), 0u);
  // But a few that run down from the arc, or out of it without a wiper.
  const std::set<std::uint32_t> beside = ids(wiped, false), without = ids(other, false);
  const auto stays = [&](std::uint32_t id) { return beside.count(id) == 1; };
  EXPECT_GT(static_cast<double>(std::count_if(without.begin(), without.end(), stays)), 0.98 * static_cast<double>(without.size()));
  EXPECT_EQ(wiped.mass_balance(1).residual(), 0);
  EXPECT_GT(wiped.mass_balance(1).removed, other.mass_balance(1).removed);
  for (const int pane : {0, 2}) {
    const std::vector<DropView> a = wiped.drops(pane), b = other.drops(pane);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
      EXPECT_TRUE(std::tie(a[i].id, a[i].u, a[i].v, a[i].mass) == std::tie(b[i].id, b[i].u, b[i].v, b[i].mass)) << pane << " " << i;
  }
}

/// Steps of a frame in which a pass ran.
class StepsOf : public Recorder {
 public:
  explicit StepsOf(std::string_view name) : name_(name) {}
  bool reads(int, std::string_view) const override { return false; }
  void pass(const PassCall& call) override {
    if (call.pass == name_) steps.push_back(call.step);
  }
  std::vector<int> steps;

 private:
  std::string name_;
};
TEST_P(PaneWipers, PanesWithoutThemRunNoPassOfBlades) {
  const auto steps = [&](const char* pass, const std::string& more) {
    Windshield run = make(GetParam(), more);
    StepsOf recorder(pass);
    run.next_frame(&recorder);
    return recorder.steps;
  };
  for (const char* pass : {"wipe_drops", "wipe_texture"}) {
    EXPECT_EQ(steps(pass, ""), std::vector{0}) << pass;
    EXPECT_EQ(steps(pass, rear_wiper), (std::vector{0, 1})) << pass;
    EXPECT_EQ(steps(pass, "[pane_2_wipers]\ncount = 2\n"), (std::vector{0, 2})) << pass;
  }
}

TEST(PaneWipersKeys, AreThoseOfTheWindshieldForTheirPane) {
  const Settings s =
      settings_from(config_of("as-published", std::string(car) + "[pane_2_wipers]\ncount = 2\narrangement = 'opposed'\nhalf_width = 0.01\n"
                                                                 "follow = 0.3\ninherit = 0.2\ngain = 0.1\nkey_frames = '0 off; 2 fast'\n"
                                                                 "fast_cycles_per_minute = 80\n"));
  ASSERT_EQ(s.pane_wipers.size(), 2u);
  const Settings rear = settings_of_pane(s, 1), left = settings_of_pane(s, 2);
  EXPECT_TRUE(rear.wipers.blades.empty());
  EXPECT_EQ(rear.capture.follow, Capture().follow);
  EXPECT_EQ(rear.surface.half_width, 0.025);
  EXPECT_EQ(left.wipers.blades.size(), 2u);
  EXPECT_GT(left.wipers.blades[1].start_angle, 90 * degree);  // of a blade that comes the other way
  EXPECT_EQ(left.surface.half_width, 0.01);
  EXPECT_EQ(std::tie(left.capture.follow, left.capture.inherit, left.capture.gain), std::tuple(0.3, 0.2, 0.1));
  ASSERT_TRUE(left.wipers.keyed.has_value());
  EXPECT_NEAR(left.wipers.keyed->cycles(2.75), 1, 1e-12);
  // The windshield's own stay.
  EXPECT_TRUE(s.wipers.blades.empty());
  EXPECT_FALSE(s.wipers.keyed.has_value());
  EXPECT_EQ(settings_of_pane(s, 0).surface.half_width, 0.025);
}

std::string refusal(const std::string& more) {
  return usage_error([&] { settings_from(config_of("corrected", car + more)); });
}
TEST(PaneWipersKeys, WhatCannotBeIsNamed) {
  EXPECT_THAT(usage_error([] { settings_from(config_of("corrected", "[pane_2_wipers]\ncount = 1\n")); }),
              HasSubstr("pane_2_wipers.count: expected none, for windshield.panes has 0 panes"));
  EXPECT_THAT(refusal("[pane_3_wipers]\ncount = 1\n"), HasSubstr("pane_3_wipers.count: unknown key; did you mean 'pane_1_wipers.count'?"));
  EXPECT_THAT(refusal("[pane_1_wipers]\ncount = 1\narrangement = 'custom'\nsweep_0 = 0\n"),
              HasSubstr("pane_1_wipers.sweep_0: expected a turn"));
  EXPECT_THAT(refusal("[pane_1_wipers]\ncount = 1\nkey_frames = '0 of'\n"), HasSubstr("pane_1_wipers.key_frames, key frame 1: expected"));
  EXPECT_THAT(refusal("[pane_1_wipers]\ncount = 1\nfast_cycles_per_minute = 50\n"),
              HasSubstr("pane_1_wipers.fast_cycles_per_minute: expected none beside wipers that no pane_1_wipers.key_frames drive"));
}

}  // namespace
}  // namespace rainref::windshield
