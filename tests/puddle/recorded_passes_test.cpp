// What the puddle records of its passes: enough to run each of them elsewhere.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>

#include "pass/same_as_definition.h"
#include "puddle/golden_scenes.h"
#include "puddle/info.h"
#include "puddle/uniforms.h"
#include "random/counter.h"
#include "source_folder.h"

namespace rainref::puddle {
namespace {

using capture::CaseInput;
using capture::PassCase;

/// A tiny sky: the street costs a second.
Surroundings tiny_surroundings() {
  Surroundings around;
  around.environment = Image(Format::rgba32f, 16, 8);
  for (int y = 0; y < 8; ++y) {
    for (int i = 0; i < 64; ++i) around.environment.row<float>(y)[i] = 0.01f * static_cast<float>(i + 10 * y);
  }
  around.ground = Image(Format::rgba8, 4, 4);
  return around;
}

std::vector<PassCase> cases_of(const Settings& s, int frames) {
  const parallel::Executor executor(2);
  Puddle puddle(s, tiny_surroundings(), executor);
  return rainref::test::captured(effect_info(), s.variant == Variant::corrected, "", [&](Recorder& recorder) {
    for (int frame = 0; frame < frames; ++frame) puddle.next_frame(&recorder);
  });
}
Settings small(Variant variant) {
  Settings s = golden::named(golden_scenes(), fmt::format("puddle/{}/rg16f", name(variant))).settings();
  s.width = 19;
  s.height = 11;
  s.grid = {17, 13};
  s.shape = Shape::basin;  // the bed of a natural puddle costs most of a second
  return s;
}

/// The records or uniforms of a case as values.
template <class T>
std::vector<T> values(const std::vector<std::byte>& bytes) {
  std::vector<T> out(bytes.size() / sizeof(T));
  if (!bytes.empty()) std::memcpy(out.data(), bytes.data(), bytes.size());
  return out;
}

class RecordedPasses : public testing::TestWithParam<Variant> {};

TEST_P(RecordedPasses, TheBoundaryIsAnAddressRule) {
  for (const auto& [boundary, address] : {std::pair(Boundary::reflecting, Address::clamp), std::pair(Boundary::periodic, Address::repeat),
                                          std::pair(Boundary::fixed, Address::border)}) {
    for (const Format storage : {Format::rg16f, Format::rgba8}) {
      Settings s = small(GetParam());
      s.boundary = boundary;
      s.storage = storage;
      s.rounding = Rounding::rtz;
      for (const PassCase& c : cases_of(s, 1)) {
        const CaseInput* wave = c.input("wave");
        if (!wave) continue;
        EXPECT_EQ(wave->array.format, storage);
        if (c.pass == "wave_step") {
          EXPECT_EQ(wave->address_u, address);
          EXPECT_EQ(wave->filter, Filter::none);
          // The first step reads level water: the border is its stored value, decoded.
          if (c.step == 0 && storage == Format::rgba8) {
            const auto code = static_cast<float>(std::to_integer<int>(wave->array.levels[0][0]));
            EXPECT_EQ(wave->border[0], code / 255);
          }
        } else {
          EXPECT_EQ(wave->address_u,
                    GetParam() == Variant::as_published && boundary == Boundary::periodic ? Address::repeat : Address::clamp);
          EXPECT_TRUE(wave->linear);
        }
      }
    }
  }
}

TEST_P(RecordedPasses, ListeningChangesNothing) {
  const Settings s = small(GetParam());
  const std::vector<PassCase> cases = cases_of(s, 3);
  const parallel::Executor executor(1);
  Puddle alone(s, tiny_surroundings(), executor);
  for (int frame = 0; frame < 3; ++frame) alone.simulate();
  alone.render();
  const scene::UniformBlock none{};
  EXPECT_EQ(cases.back().output("picture")->array.levels, capture::array_of(BufferView(alone.picture()), none).levels);
}

INSTANTIATE_TEST_SUITE_P(Puddle, RecordedPasses, testing::Values(Variant::as_published, Variant::corrected),
                         [](const auto& tested) { return tested.param == Variant::corrected ? "corrected" : "as_published"; });

TEST(RecordedTime, IsThatOfTheFrameAndOfTheStep) {
  Settings s = small(Variant::corrected);
  s.fps = 24;
  s.step_rate = 120;
  for (const PassCase& c : cases_of(s, 2)) {
    EXPECT_EQ(c.time, static_cast<float>(c.frame / 24.0)) << c.folder();
    EXPECT_EQ(c.dt, c.pass == "raindrops" || c.pass == "wave_step" ? static_cast<float>(1 / 120.0) : static_cast<float>(1 / 24.0))
        << c.folder();
    EXPECT_LT(c.step, 5);
  }
}

// The drops drawn again from the uniforms and tables alone, as docs/effects/puddle.md says.
std::vector<Drop> drawn(const PassCase& c) {
  const auto u = values<RainfallUniforms>(c.uniforms).at(0);
  const auto craters = values<Drop>(c.input("craters")->array.levels[0]);
  const auto thresholds = values<std::uint32_t>(c.input("count_thresholds")->array.levels[0]);
  EXPECT_EQ(static_cast<int>(thresholds.size()), u.threshold_count);
  const auto block = [&](std::uint32_t purpose, std::uint32_t a, std::uint32_t b) {
    const random::Block k = random::pcg4d({u.seed[0], u.seed[1], purpose, 0});
    return random::pcg4d({a ^ k[0], b ^ k[1], k[2], k[3]});
  };
  const auto shelter = values<ShelterCell>(c.input("shelter")->array.levels[0]);
  const auto objects = values<Drop>(c.input("objects")->array.levels[0]);
  EXPECT_EQ(shelter.size(), std::size_t{u.shelter_columns} * u.shelter_rows);
  EXPECT_EQ(static_cast<int>(objects.size()), u.object_count);
  std::vector<Drop> out;
  if (craters.empty()) return objects;
  int count = u.first_count;
  for (const std::uint32_t t : thresholds) count += t <= block(1, u.step, 0)[0];
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(count); ++i) {
    const random::Block r = block(2, u.step, i);
    if (!shelter.empty()) {
      const std::uint32_t column = (r[0] >> 16) * u.shelter_columns >> 16, row = (r[1] >> 16) * u.shelter_rows >> 16;
      if (r[3] >> 16 >= shelter[column + row * u.shelter_columns].open) continue;
    }
    Drop d = craters[r[2] >> 22];
    d.x = static_cast<float>(((r[0] >> 16) * u.columns) >> 8) / 256;
    d.y = static_cast<float>(((r[1] >> 16) * u.rows) >> 8) / 256;
    out.push_back(d);
    if (u.boundary == 2) continue;
    const auto w = static_cast<float>(u.columns), h = static_cast<float>(u.rows);
    const float xs[] = {d.x, u.boundary == 1 ? d.x - w : -d.x, u.boundary == 1 ? d.x + w : 2 * w - d.x};
    const float ys[] = {d.y, u.boundary == 1 ? d.y - h : -d.y, u.boundary == 1 ? d.y + h : 2 * h - d.y};
    for (int k = 1; k < 9; ++k) {
      const float x = xs[k % 3], y = ys[k / 3];
      if (x + d.radius > 0 && x - d.radius < w && y + d.radius > 0 && y - d.radius < h) out.push_back({x, y, d.amplitude, d.radius});
    }
  }
  out.insert(out.end(), objects.begin(), objects.end());
  return out;
}

TEST(RecordedRain, HoldsAllThatTheDropsDependOn) {
  for (const Boundary boundary : {Boundary::reflecting, Boundary::periodic, Boundary::fixed}) {
    for (const double rate : {0.0, 3.0, 200.0, -200.0}) {
      Settings s = small(Variant::corrected);
      const bool is_special = rate < 0;
      if (is_special) s.shelter = "0 0 1 1; -0.3 -0.3 -0.107 -0.1";
      if (is_special) s.objects = "0.05 0.01: 0 -0.3 0, 2 0.3 0.1; 0.1 0.001: 0.01 0 0, 1 0.4 0.2";
      s.seed = 0x123456789abcdefull;
      s.boundary = boundary;
      s.rain_rate = std::abs(rate);
      std::size_t drops = 0;
      for (const PassCase& c : cases_of(s, 4)) {
        if (c.pass != "raindrops") continue;
        const std::vector<Drop> expected = drawn(c);
        const auto& bytes = c.output("drops")->array.levels[0];
        ASSERT_EQ(bytes.size(), expected.size() * sizeof(Drop)) << c.folder();
        EXPECT_TRUE(expected.empty() || std::memcmp(bytes.data(), expected.data(), bytes.size()) == 0) << c.folder();
        drops += expected.size();
      }
      EXPECT_EQ(drops > 20, std::abs(rate) > 100);
    }
  }
}

TEST(EffectInfo, TheDocumentListsEveryFormula) {
  std::ifstream file(rainref::test::source_folder() + "/docs/effects/puddle.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  for (const capture::PassInfo& pass : effect_info().passes) {
    for (const capture::PassVariant& v : pass.variants) {
      EXPECT_NE(text.find("`" + capture::formula(effect_info(), pass, v) + "`"), std::string::npos)
          << capture::formula(effect_info(), pass, v);
    }
  }
}

TEST(EffectInfo, JudgesWhatNoGpuReproducesAsInput) {
  const auto judge = [](const char* pass, const char* variant) { return effect_info().pass(pass).variant(variant)->judge; };
  EXPECT_EQ(judge("raindrops", "as-published"), capture::Judge::keyed);
  EXPECT_EQ(judge("raindrops", "corrected"), capture::Judge::bits);
  EXPECT_EQ(judge("ground_noise", "as-published"), capture::Judge::input_only);
  for (const char* pass : {"wave_step", "surface_hit", "shade", "display"}) {
    for (const char* variant : {"as-published", "corrected"}) EXPECT_EQ(judge(pass, variant), capture::Judge::envelope) << pass << variant;
  }
}

}  // namespace
}  // namespace rainref::puddle
