// The scalar evaluations against the reference: every other test of waves rests on them. Every offset, width and target:
// wave_definition_test.cpp.
#include <cstring>

#include "puddle/support.h"

namespace rainref::puddle {
namespace {

using testing::Le;

struct DropsOfSteps : Recorder {
  std::vector<std::vector<Drop>> steps;
  void pass(const PassCall& call) override {
    if (call.pass != "raindrops") return;
    const auto& records = std::get<RecordView>(call.outputs[0].content);
    const auto* first = static_cast<const Drop*>(records.data);
    steps.emplace_back(first, first + records.count);
  }
};

template <class Storage>
::testing::AssertionResult same_bits(const Image& plane, const std::vector<Storage>& level) {
  for (int y = 0; y < plane.height(); ++y) {
    for (int x = 0; x < plane.width(); ++x) {
      const Storage& expected = level[static_cast<std::size_t>(y) * plane.width() + x];
      if (std::memcmp(plane.row<Storage>(y) + x, &expected, sizeof(Storage)) != 0)
        return ::testing::AssertionFailure() << "at " << x << ", " << y;
    }
  }
  return ::testing::AssertionSuccess();
}

Settings rainy(Variant variant, Boundary boundary) {
  Settings s = no_rain(variant, 37, 70);  // odd, three tiles, no multiple of any vector
  s.boundary = boundary;
  s.drop_count = 10;
  s.drop_intensity = 1;
  s.rain_speed = 7;
  s.rain_rate = 100;
  s.cell_size = 0.01;
  s.step_rate = 120;
  s.smallest_drop = 1;
  return s;
}

template <class Storage>
void expect_reference_bits(const Settings& s, int frames) {
  SCOPED_TRACE(text(s));
  Puddle puddle = puddle_of(s);
  ScalarWave<Storage> plain(s);
  std::size_t drops_seen = 0;
  for (int frame = 0; frame < frames; ++frame) {
    DropsOfSteps drops;
    puddle.simulate(&drops);
    for (const auto& of_step : drops.steps) {
      plain.step(of_step);
      for (const Drop& d : of_step) drops_seen += d.amplitude != 0;
    }
    ASSERT_TRUE(same_bits(puddle.newest(), plain.newest)) << "frame " << frame;
    ASSERT_TRUE(same_bits(puddle.previous(), plain.previous)) << "frame " << frame;
  }
  EXPECT_GT(drops_seen, 50u);
  EXPECT_GT(rms(minus(stored_values(puddle.newest()), Field(cells_of(s), encoding(s).rest))), 1e-6) << "there are waves";
}

TEST(WaveOracle, PlainFloatsGiveTheBitsOfTheReferenceInEveryStorage) {
  for (const Variant variant : variants) {
    for (const Boundary boundary : boundaries) {
      Settings s = rainy(variant, boundary);
      expect_reference_bits<float>(s, 60);
      s.storage = Format::rg16f;
      expect_reference_bits<Half>(s, 30);
      s.rounding = Rounding::rtz;
      expect_reference_bits<Half>(s, 30);
      s.storage = Format::rgba8;
      expect_reference_bits<Unorm8>(s, 30);
      if (variant == Variant::as_published) continue;
      s.rim_width = 0.08;  // 8 cells
      expect_reference_bits<Unorm8>(s, 30);
      s.storage = Format::rg16f;
      expect_reference_bits<Half>(s, 30);
      s.storage = Format::rg32f;
      expect_reference_bits<float>(s, 60);
    }
  }
}

// The float evaluation lies as far from the double evaluation as rounding alone can carry it.
TEST(WaveOracle, FloatsAreWithinRoundingOfDoubles) {
  for (const Variant variant : variants) {
    for (const Boundary boundary : boundaries) {
      Settings s = variant == Variant::as_published ? as_published(37, 70, 0.98, boundary) : corrected(37, 70, 0.98, 0.6, boundary);
      SCOPED_TRACE(text(s));
      const Field newest = noise(cells_of(s), 1), previous = noise(cells_of(s), 2);
      OracleWave oracle = oracle_of(s, newest, previous);
      ScalarWave<float> plain(s);
      for (std::size_t i = 0; i < newest.size(); ++i) {
        plain.newest[i] = static_cast<float>(oracle.newest[i]);
        plain.previous[i] = static_cast<float>(oracle.previous[i]);
        oracle.newest[i] = plain.newest[i];
        oracle.previous[i] = plain.previous[i];
      }
      double top = std::max(largest(newest), largest(previous));
      for (int n = 1; n <= 200; ++n) {
        oracle.step();
        plain.step();
        const Field exact = heights(oracle.newest, s), got = heights(Field(plain.newest.begin(), plain.newest.end()), s);
        top = std::max(top, largest(exact));
        // step_rounding is for waves no higher than 1; here the highest is `top`. Coherent sum of all roundings.
        ASSERT_THAT(rms(minus(got, exact)), Le(step_rounding * ulp_float * std::max(1.0, top) * growth(s, n))) << "step " << n;
      }
      record(text(s), rms(minus(heights(Field(plain.newest.begin(), plain.newest.end()), s), heights(oracle.newest, s))));
    }
  }
}

TEST(WaveOracle, StepUniformsOfTheOracleAreThoseOfThePuddle) {
  const Settings s = corrected(8, 6, 0.98, 0.5);
  const WaveStepUniforms expected = wave_step_uniforms(s), got = OracleWave(s).uniforms();
  EXPECT_EQ(std::memcmp(&expected, &got, sizeof got), 0);
  // C^2 (1 + gamma) / 2, rounded once.
  EXPECT_EQ(got.courant_sq, static_cast<float>(0.25 * 1.98 / 2));
  EXPECT_EQ(got.damping, 0.98f);
}

}  // namespace
}  // namespace rainref::puddle
