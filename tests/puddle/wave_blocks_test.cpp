// Steps of wave_step that are blocked in time give the bits of one step after another.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <fmt/format.h>

#include "capture/hashing.h"
#include "math/simd_target.h"
#include "puddle/scene_support.h"
#include "puddle/support.h"
#include "puddle/kernels.h"

namespace rainref::puddle {
namespace {

// Numbers without a pattern.
class Numbers {
 public:
  explicit Numbers(std::uint32_t seed) : state_(seed) {}
  float below(float limit) {
    state_ = state_ * 1664525u + 1013904223u;
    return limit * static_cast<float>(state_ >> 8) * 0x1p-24f;
  }

 private:
  std::uint32_t state_;
};

struct Case {
  Settings settings;
  int steps = 1;
  bool has_shore = false;
};
test::Water rough(const Settings& s) {
  test::Water water(s);
  Numbers numbers(7);
  std::vector<float> now = water.level(0), before = now;
  const float height = s.variant == Variant::corrected && s.storage != Format::rgba8 ? 0x1p-6f : 0.5f;
  for (float& x : now) x = water.uniforms.rest + height * (numbers.below(1) - 0.5f);
  for (float& x : before) x = water.uniforms.rest + height * (numbers.below(1) - 0.5f);
  water.set(now, before);
  return water;
}
// Of each step; some at the ends of bands of rows.
std::vector<std::vector<Drop>> drops_of(const test::Water& water, int steps) {
  Numbers numbers(11);
  std::vector<std::vector<Drop>> drops(static_cast<std::size_t>(steps));
  for (int step = 0; step < steps; ++step) {
    for (int k = 0; k < (step + 1) % 4 * 5; ++k) {
      const float y = k % 3 ? numbers.below(static_cast<float>(water.height)) : static_cast<float>(64 * k % (water.height + 1));
      const float radius = water.is_corrected() ? 1 + numbers.below(6) : 4;
      drops[static_cast<std::size_t>(step)].push_back(
          {numbers.below(static_cast<float>(water.width)), y, 0.01f + numbers.below(0.1f), radius});
    }
  }
  return drops;
}
std::vector<WaveJob> jobs_of(test::Water& water, const std::vector<std::vector<Drop>>& drops, const Image* shore) {
  std::vector<WaveJob> jobs;
  for (const std::vector<Drop>& fallen : drops) {
    const bool even = jobs.size() % 2 == 0;
    jobs.push_back({water.uniforms, water.is_corrected(), water.settings.rounding, water.settings.boundary,
                    even ? &water.newest : &water.previous, even ? &water.previous : &water.newest, &water.rest_row, shore, fallen});
  }
  return jobs;
}
void expect_same(const Case& c, const parallel::Executor& executor, const std::string& what) {
  test::Water apart = rough(c.settings), together = rough(c.settings);
  Image shore;
  if (c.has_shore) {
    shore = Image(Format::r32f, apart.width, apart.height);
    Numbers numbers(3);
    for (int y = 0; y < apart.height; ++y)
      for (int x = 0; x < apart.width; ++x) shore.row<float>(y)[x] = std::min(1.0f, numbers.below(1.5f));
  }
  const Image* const of_shore = c.has_shore ? &shore : nullptr;
  const auto drops = drops_of(apart, c.steps);
  for (const WaveJob& job : jobs_of(apart, drops, of_shore)) {
    wave_step_rows(job, apart.all());
    if (apart.is_corrected()) wave_previous_rows(job, apart.all());
  }
  step_wave(jobs_of(together, drops, of_shore), executor);
  ASSERT_EQ(apart.now(), together.now()) << what;
  ASSERT_EQ(apart.before(), together.before()) << what;
}

TEST(WaveBlocks, StepsTogetherHaveTheBitsOfStepsApart) {
  const parallel::Executor one(1), two(2), three(3), eight(8);
  const parallel::Executor* const executors[] = {&one, &two, &three, &eight};
  const std::vector<std::string> targets = simd_targets();
  std::size_t number = 0;
  for (const Variant variant : variants) {
    for (const Boundary boundary : boundaries) {
      for (const Format storage : {Format::rg16f, Format::rg32f, Format::rgba8}) {
        for (const int height : {1, 9, 63, 64, 65, 130, 200, 321}) {
          for (const int steps : {1, 2, 5, 12}) {
            const int width = 1 + static_cast<int>(number * 7 % 33);
            Case c{variant == Variant::corrected ? test::corrected(4, 4) : test::as_published(width, height), steps};
            Settings& s = c.settings;
            s.grid = {width, height};
            s.boundary = boundary;
            s.storage = storage;
            s.rounding = number % 2 ? Rounding::rne : Rounding::rtz;
            s.step = 1 + 0.75 * static_cast<double>(number % 5);  // as published whole and fractional
            s.rim_width = number % 4 < 2 ? 0 : 3.5 * s.cell_size;
            c.has_shore = variant == Variant::corrected && number % 3 == 0;
            select_simd_target(targets[number % targets.size()]);
            expect_same(
                c, *executors[number % 4],
                fmt::format("{}, boundary {}, {}, {} x {}, {} steps, {} threads, {}", name(variant), static_cast<int>(boundary),
                            info(storage).name, width, height, steps, executors[number % 4]->threads(), targets[number % targets.size()]));
            ++number;
          }
        }
      }
    }
  }
  select_simd_target("");
}

// Which rows are fetched ahead shows in no bit: those that are left do. Some are taken by every visit, none beyond the last.
TEST(WaveBlocks, RowsAheadAreTakenOffAsTheyAreFetched) {
  const std::vector<std::vector<Drop>> none(1);
  for (const std::string& target : simd_targets()) {
    select_simd_target(target);
    for (const Format storage : {Format::rg16f, Format::rg32f}) {
      Settings s = test::corrected(4, 4);
      s.grid = {40, 512};
      s.storage = storage;
      test::Water plain = rough(s), fetching = rough(s);
      const WaveJob job = jobs_of(fetching, none, nullptr)[0];
      const auto step = [&](int y0, int y1, RowsAhead ahead) { return wave_step_rows(job, {0, y0, 40, y1}, ahead); };
      const int taken = step(0, 8, {40, 512}).y0 - 40;
      EXPECT_GE(taken, 2) << target;
      EXPECT_EQ(step(8, 24, {40 + taken, 512}).y0, 40 + 3 * taken) << target;
      EXPECT_EQ(step(24, 504, {511, 512}).y0, 512) << target;
      EXPECT_EQ(step(504, 512, {40, 40}).y0, 40) << target;
      wave_step_rows(jobs_of(plain, none, nullptr)[0], plain.all());
      EXPECT_EQ(plain.now(), fetching.now()) << target;
      EXPECT_EQ(step(0, 8, {0, 512}).y0, taken) << target;  // rows ahead that begin with those made
    }
  }
  select_simd_target("");
}

// Nobody reads the levels in between, or somebody does.
TEST(WaveBlocks, AFrameHasTheSameWaterWhetherItsStepsAreReadOrNot) {
  for (const Variant variant : variants) {
    for (const Boundary boundary : boundaries) {
      Settings s = variant == Variant::corrected ? test::corrected(4, 4) : test::as_published(40, 200);
      s.grid = {40, 200};
      s.boundary = boundary;
      s.rain_rate = 200;
      s.smallest_drop = 0.5;
      s.cell_size = 0.01;
      s.step_rate = 500;
      s.fps = 60;
      const Surroundings around = test::uniform_surroundings(1, 0.5f);
      const parallel::Executor executor(2);
      Puddle unread(s, around, executor), read(s, around, executor), timed(s, around, executor);
      capture::HashRecorder hashes, times(false);
      for (int frame = 0; frame < 5; ++frame) {
        unread.simulate();
        read.simulate(&hashes);
        timed.simulate(&times);
        const Hash128 expected = capture::hash_of(read.wave());
        ASSERT_EQ(capture::hash_of(unread.wave()).text(), expected.text()) << name(variant) << ", frame " << frame;
        ASSERT_EQ(capture::hash_of(timed.wave()).text(), expected.text()) << name(variant) << ", frame " << frame;
      }
      EXPECT_EQ(unread.steps(), read.steps());
      EXPECT_GT(unread.steps(), variant == Variant::corrected ? 5 * 5 : 4);
      for (const capture::HashRecorder::Time& t : times.times()) EXPECT_EQ(t.calls, read.steps()) << t.pass;
    }
  }
}

}  // namespace
}  // namespace rainref::puddle
