// Pass wipe_drops: swept areas (physics: W10), what is left after a stroke (W11), the bow wave (W12), conservation.
#include <gtest/gtest.h>

#include <numeric>

#include "windshield/motion_plain.h"
#include "windshield/support.h"
#include "windshield/wipe_drops.h"

namespace rainref::windshield {
namespace {

using N = plain::Plain<float>;
constexpr bool corrected = true;

// One blade whose widened sweep lies on the default glass as a whole.
WiperSettings inner_blade(double cycles_per_minute = 60, double half_width = 0.008) {
  WiperSettings s;
  s.blades = {{{0.7, 0.08}, 0.15, 0.6, 20 * degree, 140 * degree, 0}};
  s.cycles_per_minute = cycles_per_minute;
  s.half_width = half_width;
  return s;
}
WipeDropsUniforms uniforms_of(const std::vector<Wiper>& wipers, bool is_corrected, int columns = 0, int rows = 0, const Capture& capture = {}) {
  return wipe_drops_uniforms(default_glass(), is_corrected, static_cast<int>(wipers.size()), capture, radius_scale, columns, rows);
}
std::uint64_t wipe(DropArrays& drops, const std::vector<Wiper>& wipers, Image& film) {
  static const parallel::Executor executor(2);
  return wipe_drops(uniforms_of(wipers, corrected, film.width(), film.height()), corrected, wipers, drops.spans(), &film, executor);
}

// ---- geometry, written again in double with polar angles -----------------------------------------------------------
struct Point {
  double x, y;
};
Point in_plane(const DropArrays& d, std::size_t i) {
  const Real2 p = default_glass().plane().to_plane({d.u[i], d.v[i]});
  return {p[0], p[1]};
}
double blade_distance(const Wiper& w, double angle, Point p) {
  const double rx = p.x - w.pivot[0], ry = p.y - w.pivot[1];
  const double along = std::clamp(rx * std::cos(angle) + ry * std::sin(angle), double(w.inner_radius), double(w.outer_radius));
  return std::hypot(rx - along * std::cos(angle), ry - along * std::sin(angle));
}
// Distance of p from the blade, at its nearest in the sweep: 0 where the blade itself passes.
double sweep_distance(const Wiper& w, Point p) {
  const double a0 = std::atan2(w.previous_axis[1], w.previous_axis[0]);
  const double turn = std::remainder(std::atan2(w.axis[1], w.axis[0]) - a0, 2 * pi);
  const double to = std::remainder(std::atan2(p.y - w.pivot[1], p.x - w.pivot[0]) - a0, 2 * pi) / turn;
  const double radius = std::hypot(p.x - w.pivot[0], p.y - w.pivot[1]);
  double distance = std::min(blade_distance(w, a0, p), blade_distance(w, a0 + turn, p));
  if (0 <= to && to <= 1) distance = std::min(distance, std::max({0.0, w.inner_radius - radius, radius - w.outer_radius}));
  return distance;
}

// ---- W10 -----------------------------------------------------------------------------------------------------------
struct Area {
  double value, error;  // error: half a cell along the outline
};
template <class Inside>
Area count(Inside inside, double perimeter) {
  constexpr int columns = 1750, rows = 1000;
  const WipeDropsUniforms u = uniforms_of({}, corrected);
  int hits = 0;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const auto p = motion_scalar::to_plane(u.frame, N(static_cast<float>((x + 0.5) / columns)), N(static_cast<float>((y + 0.5) / rows)));
      hits += inside(p.x, p.y);
    }
  }
  const double cell = 1.4 / columns;
  return {hits * cell * (0.8 / rows), perimeter * cell / 2};
}
TEST(MotionWipe, SweptAreasAreThoseOfGeometry) {
  const double w = 0.03;
  const WiperSettings s = inner_blade(60, w);
  const Blade& b = s.blades[0];
  const double length = b.outer_radius - b.inner_radius, middle = 0.5 * (b.outer_radius + b.inner_radius);
  for (const auto& [from, to] : {std::pair{0.2, 0.22}, std::pair{0.2, 0.3}, std::pair{0.8, 0.65}}) {
    // The last one turns back.
    const std::vector<Wiper> records = wipers_between(s, default_glass().plane(), from < to ? from : 1 - from + 0.5, from < to ? to : 1 - to + 0.5, corrected);
    ASSERT_EQ(records.size(), 1u);
    const Wiper& record = records[0];
    const double turn = std::abs(std::remainder(std::atan2(record.axis[1], record.axis[0]) - std::atan2(record.previous_axis[1], record.previous_axis[0]), 2 * pi));
    const double perimeter = 2 * length + 2 * (middle + w) * turn + 2 * pi * w;

    const Area sweep = count([&](N x, N y) { return motion_scalar::in_sweep(record, x, y); }, perimeter);
    EXPECT_NEAR(sweep.value, length * middle * turn + 2 * w * middle * turn + 2 * w * length + pi * w * w, sweep.error);
    const WipeDropsUniforms u = uniforms_of(records, false);
    const Area quad = count([&](N x, N y) { return motion_scalar::in_quad(u, record, x, y); }, perimeter);
    EXPECT_NEAR(quad.value, length * middle * std::sin(turn), quad.error);
    const Area capsule = count(
        [&](N x, N y) { return motion_scalar::under_blade(record, record.axis, x - N(record.pivot[0]), y - N(record.pivot[1])); }, perimeter);
    EXPECT_NEAR(capsule.value, 2 * w * length + pi * w * w, capsule.error);
  }
}

// At 65 cycles, 100 degrees, 0.65 m and 60 frames the chord loses 1.6e-3 of the area at the fastest step.
TEST(MotionWipe, TheQuadLosesWhatTheChordCuts) {
  const double turn = 5.94 / 60;
  EXPECT_NEAR(1 - std::sin(turn) / turn, 1.6e-3, 0.05e-3);
  EXPECT_NEAR(0.65 * turn * turn / 8, 0.8e-3, 0.005e-3);
  // A point under the arc and beyond the chord: the corrected sweep has it, the quad does not.
  WiperSettings s;
  s.blades = {{{0.7, 0.0}, 0.16, 0.65, 90 * degree - turn / 2, turn, 0}};
  s.half_width = 1e-4;
  s.cycles_per_minute = 30;
  const std::vector<Wiper> records = wipers_between(s, default_glass().plane(), 0, 1, corrected);
  const N x(0.7f), y(0.65f - 0.4e-3f);
  EXPECT_TRUE(motion_scalar::in_sweep(records[0], x, y));
  EXPECT_FALSE(motion_scalar::in_quad(uniforms_of(records, false), records[0], x, y));
}

// However fast the blade and slow the frames: each point of the whole stroke is swept by one of its steps.
TEST(MotionWipe, FastWipersLeaveNoGap) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const double cycles_per_minute : {45.0, 65.0, 600.0}) {
    for (const double fps : {10.0, 30.0, 60.0, 144.0}) {
      WiperSettings s = inner_blade(cycles_per_minute, 1e-4);
      const Blade& b = s.blades[0];
      std::vector<Wiper> all;
      for (int n = 0; n < 0.5 * fps * 60 / cycles_per_minute; ++n) {
        for (const Wiper& w : wipers_between(s, default_glass().plane(), n / fps, (n + 1) / fps, corrected)) all.push_back(w);
      }
      for (int i = 0; i < 2000; ++i) {
        const double angle = b.start_angle + unit(random) * b.sweep, radius = b.inner_radius + unit(random) * (b.outer_radius - b.inner_radius);
        const N x(static_cast<float>(b.pivot[0] + radius * std::cos(angle))), y(static_cast<float>(b.pivot[1] + radius * std::sin(angle)));
        EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Wiper& w) { return motion_scalar::in_sweep(w, x, y); })) << cycles_per_minute << " " << fps;
      }
    }
  }
}

// ---- corrected: drops ----------------------------------------------------------------------------------------------
// Captured drops keep their radius, stand half_width and their own radius ahead of the blade, and move with it.
TEST(MotionWipe, CapturedDropsRideAheadOfTheBlade) {
  const WiperSettings s = inner_blade();
  for (const double start : {0.2, 0.7}) {  // forth and back
    const std::vector<Wiper> records = wipers_between(s, default_glass().plane(), start, start + 1.0 / 60, corrected);
    DropArrays drops = random_drops(20000, 4);
    const DropArrays before = drops;
    Image film(Format::r32f, 8, 8);
    EXPECT_EQ(wipe(drops, records, film), 0u);
    const Wiper& w = records[0];
    const double rate = w.rate, angle = std::atan2(w.axis[1], w.axis[0]);
    int captured = 0;
    for (std::size_t i = 0; i < drops.size(); ++i) {
      const Point was = in_plane(before, i), is = in_plane(drops, i);
      const bool inside = before.life[i] > 0 && sweep_distance(w, was) <= s.half_width;
      const bool near_outline = std::abs(sweep_distance(w, was) - s.half_width) < 1e-6;
      if (near_outline) continue;
      if (!inside) {
        EXPECT_EQ(drops.u[i], before.u[i]);
        EXPECT_EQ(drops.velocity_v[i], before.velocity_v[i]);
        continue;
      }
      ++captured;
      const double rx = is.x - w.pivot[0], ry = is.y - w.pivot[1];
      const double a = radius_scale * std::cbrt(before.mass[i]);
      EXPECT_NEAR(std::hypot(rx, ry), std::hypot(was.x - w.pivot[0], was.y - w.pivot[1]), 1e-6);
      EXPECT_NEAR(w.direction * (std::cos(angle) * ry - std::sin(angle) * rx), s.half_width + a, 1e-6);
      const Real2 velocity = default_glass().plane().to_plane({drops.velocity_u[i], drops.velocity_v[i]});
      EXPECT_NEAR(velocity[0], -rate * ry, 2e-6);
      EXPECT_NEAR(velocity[1], rate * rx, 2e-6);
      EXPECT_EQ(drops.mass[i], before.mass[i]);
      EXPECT_EQ(drops.life[i], before.life[i]);
    }
    EXPECT_GT(captured, 100);
  }
}

// Many steps at many speeds, drops drifting all the time: after each step no live drop lies strictly inside what was swept in it.
TEST(MotionWipe, NoLiveDropIsLeftInAFreshSweep) {
  for (const char* arrangement : {"tandem", "opposed"}) {
    for (const double cycles_per_minute : {20.0, 45.0, 65.0, 300.0}) {
      WiperSettings s = default_wipers(default_glass(), arrangement);
      s.cycles_per_minute = cycles_per_minute;
      DropArrays drops = random_drops(3000, 5);
      Image film(Format::r32f, 16, 16);
      std::mt19937 random(6);
      std::uniform_real_distribution<float> unit(-0.5f, 0.5f);
      std::uint64_t removed = 0;
      for (int n = 0; n < 100; ++n) {
        const std::vector<Wiper> records = wipers_between(s, default_glass().plane(), n / 60.0, (n + 1) / 60.0, corrected);
        removed += wipe(drops, records, film);
        for (std::size_t i = 0; i < drops.size(); ++i) {
          if (!(drops.life[i] > 0)) continue;
          for (const Wiper& w : records) {
            if (w.direction == 0) continue;
            ASSERT_GE(sweep_distance(w, in_plane(drops, i)), s.half_width - 2e-7) << arrangement << " " << cycles_per_minute << " " << n;
          }
          drops.u[i] += 0.02f * unit(random);
          drops.v[i] += 0.02f * unit(random);
        }
      }
      const auto live = std::count_if(drops.life.begin(), drops.life.end(), [](float life) { return life > 0; });
      EXPECT_GT(live, 2000) << arrangement;
      if (std::string(arrangement) == "tandem") {
        EXPECT_EQ(removed, 0u) << "parallel blades squeeze nothing";
      }
    }
  }
}

// Two blades that turn through each other: each pushes drops into the sweep of the other. What finds no place is thrown off, and counted.
TEST(MotionWipe, DropsBetweenBladesThatMeetAreThrownOff) {
  WiperSettings s;
  s.blades = {{{0.6, -0.06}, 0.16, 0.6, 100 * degree, -40 * degree, 0}, {{0.8, -0.06}, 0.16, 0.6, 80 * degree, 40 * degree, 0}};
  s.cycles_per_minute = 60;
  const std::vector<Wiper> records = wipers_between(s, default_glass().plane(), 0, 0.5, corrected);
  DropArrays drops = random_drops(5000, 12);
  const DropArrays before = drops;
  Image film(Format::r32f, 16, 16);
  const std::uint64_t removed = wipe(drops, records, film);
  std::uint64_t thrown = 0;
  for (std::size_t i = 0; i < drops.size(); ++i) {
    if (drops.life[i] > 0) {
      for (const Wiper& w : records) ASSERT_GE(sweep_distance(w, in_plane(drops, i)), s.half_width - 2e-7);
    } else if (before.life[i] > 0) {
      thrown += static_cast<std::uint64_t>(before.mass[i]);
    }
  }
  EXPECT_GT(thrown, 0u);
  EXPECT_EQ(removed, thrown);
}

// One stroke over N uniform drops: 1 - swept / glass of them are where they were, within 4 standard deviations.
TEST(MotionWipe, AStrokeLeavesTheUnsweptShare) {
  for (const double fps : {24.0, 60.0}) {
    const WiperSettings s = inner_blade(60);
    const Blade& b = s.blades[0];
    DropArrays drops(40000);
    std::mt19937 random(8);
    std::uniform_real_distribution<float> unit(0, 1);
    for (std::size_t i = 0; i < drops.size(); ++i) {
      drops.u[i] = unit(random);
      drops.v[i] = unit(random);
      drops.mass[i] = 50000;
    }
    const DropArrays before = drops;
    Image film(Format::r32f, 4, 4);
    for (int n = 0; n < fps / 2; ++n) wipe(drops, wipers_between(s, default_glass().plane(), n / fps, (n + 1) / fps, corrected), film);
    double still = 0;
    for (std::size_t i = 0; i < drops.size(); ++i) still += drops.u[i] == before.u[i] && drops.v[i] == before.v[i];
    // The widened sector, and behind its end drops that the last edge pushed: those stand beyond it, at most where others stood, and move nothing.
    const double length = b.outer_radius - b.inner_radius, middle = 0.5 * (b.outer_radius + b.inner_radius), w = s.half_width;
    const double swept = (length + 2 * w) * middle * b.sweep + 2 * w * length + pi * w * w;
    const double p = 1 - swept / (1.4 * 0.8), n = static_cast<double>(drops.size());
    EXPECT_NEAR(still / n, p, 4 * std::sqrt(p * (1 - p) / n)) << fps;
  }
}

TEST(MotionWipe, ABladeAtRestTouchesNothing) {
  const WiperSettings s = inner_blade();
  const std::vector<Wiper> records = wipers_at(s, default_glass().plane(), 0.3);
  DropArrays drops = random_drops(5000, 9);
  const DropArrays before = drops;
  Image film(Format::r32f, 32, 32);
  for (int y = 0; y < 32; ++y) std::fill_n(film.row<float>(y), 32, 5.0f);
  EXPECT_EQ(wipe(drops, records, film), 0u);
  EXPECT_TRUE(drops == before);
  EXPECT_EQ(film.row<float>(16)[16], 5);
  const parallel::Executor executor(1);
  wipe_drops(uniforms_of(records, false), false, records, drops.spans(), nullptr, executor);
  EXPECT_TRUE(drops == before);
}

// ---- corrected: film -----------------------------------------------------------------------------------------------
std::uint64_t quanta_in(const Image& film) {
  std::uint64_t sum = 0;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) sum += static_cast<std::uint64_t>(film.row<float>(y)[x]);
  }
  return sum;
}
std::uint64_t quanta_in(const DropArrays& d) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < d.size(); ++i) sum += d.life[i] > 0 ? static_cast<std::uint64_t>(d.mass[i]) : 0;
  return sum;
}
// Film and drops lose to the quantum what is returned, whatever the sizes, with drops that can hold no more.
TEST(MotionWipe, WaterIsConservedToTheQuantum) {
  std::mt19937 random(10);
  for (const auto& [columns, rows] : {std::pair{64, 40}, std::pair{257, 129}, std::pair{1, 1}, std::pair{3, 500}}) {
    for (const char* arrangement : {"tandem", "opposed"}) {
      WiperSettings s = default_wipers(default_glass(), arrangement);
      Image film(Format::r32f, columns, rows);
      DropArrays drops = random_drops(2000, static_cast<std::uint32_t>(columns));
      for (std::size_t i = 0; i < drops.size(); i += 3) drops.mass[i] = 0x1p24f - static_cast<float>(random() % 1000);
      std::uint64_t taken = 0, removed_in_all = 0;
      for (int n = 0; n < 90; ++n) {
        for (int y = 0; y < rows; ++y) {
          for (int x = 0; x < columns; ++x) film.row<float>(y)[x] = static_cast<float>(random() % 7 == 0 ? 1u << 24 : random() % 3000);
        }
        const std::uint64_t film_before = quanta_in(film), drops_before = quanta_in(drops);
        const std::uint64_t removed = wipe(drops, wipers_between(s, default_glass().plane(), n / 60.0, (n + 1) / 60.0, corrected), film);
        ASSERT_EQ(film_before + drops_before, quanta_in(film) + quanta_in(drops) + removed) << columns << "x" << rows << " step " << n;
        for (const float m : drops.mass) ASSERT_LE(m, 0x1p24f);
        taken += quanta_in(drops) > drops_before;
        removed_in_all += removed;
      }
      if (columns > 1) {
        EXPECT_GT(taken, 10u);
        EXPECT_GT(removed_in_all, 0u);
      }
    }
  }
}

// Film is cleared exactly where the pass says so, everywhere on the image: the box that saves time hides no texel.
TEST(MotionWipe, FilmIsClearedWhereItIsSwept) {
  for (const char* arrangement : {"tandem", "opposed"}) {
    for (const double fps : {3.0, 20.0, 60.0}) {
      for (const double t : {0.0, 0.31, 0.66, 1.0}) {
        const std::vector<Wiper> records = wipers_between(default_wipers(default_glass(), arrangement), default_glass().plane(), t, t + 1 / fps, corrected);
        Image film(Format::r32f, 131, 77);
        for (int y = 0; y < film.height(); ++y) std::fill_n(film.row<float>(y), film.width(), 3.0f);
        DropArrays drops(1);
        drops.life[0] = 0;
        const std::uint64_t removed = wipe(drops, records, film);
        const WipeDropsUniforms u = uniforms_of(records, corrected, film.width(), film.height());
        std::uint64_t swept = 0;
        for (int y = 0; y < film.height(); ++y) {
          for (int x = 0; x < film.width(); ++x) {
            const bool is_swept = motion_scalar::swept_texel<N>(u, records.data(), x, y).wiper.v >= 0;
            ASSERT_EQ(film.row<float>(y)[x], is_swept ? 0 : 3) << x << "," << y;
            swept += is_swept;
          }
        }
        EXPECT_EQ(removed, 3 * swept);
        EXPECT_GT(swept, 0u);
      }
    }
  }
}

// The lowest id in the bin takes it, wherever it lies in memory.
TEST(MotionWipe, TheLowestIdTakesTheFilm) {
  const WiperSettings s = inner_blade();
  const std::vector<Wiper> records = wipers_between(s, default_glass().plane(), 0.25, 0.25 + 1.0 / 60, corrected);
  const double angle = wiper_angle(s.blades[0], 60, 0.25 + 0.5 / 60);
  const Real2 place = default_glass().plane().to_glass({0.7 + 0.4 * std::cos(angle), 0.08 + 0.4 * std::sin(angle)});
  DropArrays drops(3);
  drops.id = {9, 2, 5};
  for (int i = 0; i < 3; ++i) {
    drops.u[i] = static_cast<float>(place[0]);
    drops.v[i] = static_cast<float>(place[1]);
    drops.mass[i] = 100;
  }
  Image film(Format::r32f, 700, 400);
  for (int y = 0; y < film.height(); ++y) std::fill_n(film.row<float>(y), film.width(), 1.0f);
  const std::uint64_t before = quanta_in(film);
  const std::uint64_t removed = wipe(drops, records, film);
  EXPECT_EQ(drops.mass[0], 100);
  EXPECT_EQ(drops.mass[2], 100);
  EXPECT_GT(drops.mass[1], 100);
  EXPECT_EQ(before - quanta_in(film), removed + static_cast<std::uint64_t>(drops.mass[1]) - 100);
  // A bin is 1/64 of the blade's length: its share of the swept film is as much of r^2.
  const double near = 0.15 - 0.008, far = 0.6 + 0.008, width = (far - near) / film_bins;
  const double r0 = near + width * std::floor((0.4 - near) / width), r1 = r0 + width;
  const double turn = wiper_angle(s.blades[0], 60, 0.25 + 1.0 / 60) - wiper_angle(s.blades[0], 60, 0.25), texel = 1.4 / 700 * 0.8 / 400;
  const double share = ((r1 * r1 - r0 * r0) / 2 * turn + 2 * 0.008 * width) / texel;
  EXPECT_NEAR(drops.mass[1] - 100, share, 0.15 * share);  // some hundred texels: their outline is rough
}

// ---- as published: the bow wave ------------------------------------------------------------------------------------
// A blade of constant rate. The drop's lag behind its target settles at v dt (1 - follow) / follow.
TEST(MotionWipe, AsPublishedDropsLagBehindTheBlade) {
  const Glass glass = default_glass();
  const parallel::Executor executor(1);
  for (const double follow : {0.5, 0.6, 0.9}) {
    const double rate = 0.5, dt = 0.004, radius = 0.4;
    DropArrays drops(1);
    const auto record = [&](int n) {
      WiperSettings s;
      // One stroke from angle to angle + rate dt is one record with these ends.
      s.blades = {{{0.7, 0.0}, 0.16, 0.65, 40 * degree + rate * dt * n, rate * dt, 0}};
      s.half_width = 0.005;
      s.cycles_per_minute = 30 / dt;
      return wipers_between(s, glass.axes(), 0, dt, false);
    };
    const double start = 40 * degree;
    const Real2 place = glass.axes().to_glass({0.7 + radius * std::cos(start), radius * std::sin(start)});
    drops.u[0] = static_cast<float>(place[0]);
    drops.v[0] = static_cast<float>(place[1]);
    Capture capture{follow, 0.5, 0.25};
    const int steps = 200;
    for (int n = 0; n < steps; ++n) {
      const std::vector<Wiper> records = record(n);
      ASSERT_NEAR(records[0].rate, rate, 1e-4);
      wipe_drops(uniforms_of(records, false, 0, 0, capture), false, records, drops.spans(), nullptr, executor);
    }
    const Real2 p = glass.axes().to_plane({drops.u[0], drops.v[0]});
    const double angle = start + rate * dt * steps, rx = p[0] - 0.7, ry = p[1];
    const double ahead = std::cos(angle) * ry - std::sin(angle) * rx, reached = std::hypot(rx, ry);
    const double lag = 0.005 - ahead, speed = rate * reached;
    EXPECT_NEAR(lag, speed * dt * (1 - follow) / follow, 0.02 * speed * dt) << follow;
    EXPECT_NEAR(drops.mass[0], 1 + 0.25 * steps, 1e-4);
    // The velocity is the blade's: half of what is missing is made up each step.
    const Real2 velocity = glass.axes().to_plane({drops.velocity_u[0], drops.velocity_v[0]});
    EXPECT_NEAR(std::hypot(velocity[0], velocity[1]), speed, 0.02 * speed);
    EXPECT_LT(velocity[0], 0);
  }
}

// A drop that the blade leaps over at its edge: within the quad it is taken, in front and behind it is not; dead ones never.
TEST(MotionWipe, AsPublishedTakesWhatLiesInQuadOrCapsule) {
  const Glass glass = default_glass();
  const parallel::Executor executor(1);
  const WiperSettings s = inner_blade();
  const std::vector<Wiper> records = wipers_between(s, glass.axes(), 0.2, 0.25, false);
  const double a0 = wiper_angle(s.blades[0], 60, 0.2), a1 = wiper_angle(s.blades[0], 60, 0.25), turn = a1 - a0;
  struct Case {
    double angle, radius;
    float life;
    bool taken;
  };
  for (const Case& c : {Case{a0 + turn / 2, 0.3, 1, true}, Case{a1 + 0.015, 0.4, 1, true}, Case{a1 + 0.025, 0.4, 1, false}, Case{a0 - 0.01, 0.4, 1, false},
                        Case{a0 + turn / 2, 0.62, 1, false}, Case{a1, 0.605, 1, true}, Case{a0 + turn / 2, 0.3, 0, false}}) {
    DropArrays drops(1);
    const Real2 place = glass.axes().to_glass({0.7 + c.radius * std::cos(c.angle), 0.08 + c.radius * std::sin(c.angle)});
    drops.u[0] = static_cast<float>(place[0]);
    drops.v[0] = static_cast<float>(place[1]);
    drops.life[0] = c.life;
    wipe_drops(uniforms_of(records, false), false, records, drops.spans(), nullptr, executor);
    EXPECT_EQ(drops.mass[0], c.taken ? 1.02f : 1.0f) << c.angle << " " << c.radius;
  }
}

}  // namespace
}  // namespace rainref::windshield
