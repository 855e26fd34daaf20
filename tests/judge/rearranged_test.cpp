// Legal regroupings of formulas, written out as a compiler or an engineer writes them: none fails, and mistakes still do.
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <map>

#include "capture/bound_texture.h"
#include "drops/records.h"
#include "drops/splat/uniforms.h"
#include "drops/uniforms.h"
#include "judge/mini_port.h"
#include "judge/profiles.h"
#include "judge/reference_outputs.h"
#include "judge/rearranging.h"
#include "judge/support.h"
#include "puddle/uniforms.h"

namespace rainref::judge {
namespace {

using capture::Array;
using capture::PassCase;

const std::vector<std::string> rearranging = test::rearranging_profiles();

PassCase case_of(const char* pack_name, const char* pass) {
  const capture::Pack pack(test::pack_folder(pack_name));
  for (const capture::PackCase& entry : pack.cases)
    if (entry.pass == pass) return pack.read(entry);
  throw std::runtime_error("no case");
}
CaseJudgement judged(const PassCase& c, const std::vector<Array>& port, const std::string& profile_name) {
  const auto model = binder(c.effect, c.pass)(c);
  const ModeJudgements all =
      judge_case(c, model.get(), port, {&profile(profile_name), &profile("typical"), &test_executor(), std::nullopt});
  return *std::min_element(all.judgements.begin(), all.judgements.end(),
                           [](const auto& a, const auto& b) { return a.failing + a.rearranged < b.failing + b.rearranged; });
}

// ---- wave_step -----------------------------------------------------------------------------------------------------
/// What a texel of the new level is computed from: no drops, no shore.
struct Around {
  float here, previous, left, right, down, up, damping, courant_sq;
};
using Formula = std::function<float(const Around&)>;

/// The pack's case without drops and shore, its levels kept in floats.
struct Wave {
  PassCase c;
  std::vector<float> levels;
  int width, height;

  Wave(const char* pack, Format format) : c(case_of(pack, "wave_step")) {
    std::erase_if(c.inputs, [](const capture::CaseInput& i) { return i.name == "shore"; });
    capture::CaseInput& drops = input_of(c, "drops");
    drops.array.width = 0;
    drops.array.levels = {{}};
    puddle::WaveStepUniforms u = capture::uniforms_of<puddle::WaveStepUniforms>(c);
    u.drop_count = 0;
    std::memcpy(c.uniforms.data(), &u, sizeof u);
    capture::CaseInput& wave = input_of(c, "wave");
    levels = capture::decoded(wave.array);
    width = wave.array.width;
    height = wave.array.height;
    if (format == Format::rg32f) {
      wave.array.format = c.outputs[0].array.format = format;
      const auto* bytes = reinterpret_cast<const std::byte*>(levels.data());
      // A little of everything below the halves, as a wave of floats has it.
      for (std::size_t k = 0; k < levels.size(); ++k) levels[k] = levels[k] * (1.0f + 0x1p-13f * static_cast<float>(k % 97));
      wave.array.levels = c.outputs[0].array.levels = {{bytes, bytes + levels.size() * 4}};
    }
    const auto model = binder(c.effect, c.pass)(c);
    c.outputs[0].array = reference_outputs(c, *model, test_executor())[0];
  }
  float at(int x, int y, int channel) const { return levels[static_cast<std::size_t>(2 * (y * width + x) + channel)]; }
  /// The interior by a formula, the rest as the reference.
  std::vector<Array> by(const Formula& formula) const {
    const auto u = capture::uniforms_of<puddle::WaveStepUniforms>(c);
    std::vector<Array> port{c.outputs[0].array};
    const Slot slot = slots_of(c)[0];
    for (int y = 1; y < height - 1; ++y)
      for (int x = 1; x < width - 1; ++x)
        store_value(slot,
                    formula({at(x, y, 0), at(x, y, 1), at(x - 1, y, 0), at(x + 1, y, 0), at(x, y - 1, 0), at(x, y + 1, 0), u.damping,
                             u.courant_sq}),
                    slot.store_rounding, port[0].levels[0].edit().data() + slot.offset(x, y));
    return port;
  }
};

float around(const Around& a) { return (a.left + a.right) + (a.down + a.up); }

struct Rewrite {
  const char* name;
  Formula formula;
  bool is_as_written = false;
};
const std::vector<Rewrite>& corrected_rewrites() {
  static const std::vector<Rewrite> all{
      {"as written",
       [](const Around& a) { return (a.here + a.damping * (a.here - a.previous)) + a.courant_sq * (around(a) - 4.0f * a.here); }, true},
      {"here + the rest",
       [](const Around& a) { return a.here + (a.damping * (a.here - a.previous) + a.courant_sq * (around(a) - 4.0f * a.here)); }},
      {"(1 + g) u - g p",
       [](const Around& a) { return ((1.0f + a.damping) * a.here - a.damping * a.previous) + a.courant_sq * (around(a) - 4.0f * a.here); }},
      {"(1 + g - 4 C^2) u - g p + C^2 sum",
       [](const Around& a) {
         return (1.0f + a.damping - 4.0f * a.courant_sq) * a.here - a.damping * a.previous + a.courant_sq * around(a);
       }},
      {"C^2 in each term",
       [](const Around& a) {
         const float moving = a.here + a.damping * (a.here - a.previous);
         return moving + a.courant_sq * a.left + a.courant_sq * a.right + a.courant_sq * a.down + a.courant_sq * a.up -
                a.courant_sq * 4.0f * a.here;
       }},
      {"differences of neighbours",
       [](const Around& a) {
         const float moving = a.here + a.damping * (a.here - a.previous);
         return moving + a.courant_sq * ((a.left - a.here) + (a.right - a.here) + (a.down - a.here) + (a.up - a.here));
       }},
  };
  return all;
}
const std::vector<Rewrite>& published_rewrites() {
  static const std::vector<Rewrite> all{
      {"as written",
       [](const Around& a) {
         const float d = -(a.previous - 0.5f) * 2.0f + (((a.down + a.left) + a.right) + a.up - 2.0f);
         return d * a.damping * 0.5f + 0.5f;
       },
       true},
      // As the compiler of an H200 (driver 580) makes it of the project's own GLSL.
      {"constants merged",
       [](const Around& a) { return ((((a.down + a.left) + a.right) + a.up) - 2.0f * a.previous - 1.0f) * a.damping * 0.5f + 0.5f; }},
      {"damping / 2 first", [](const Around& a) { return ((around(a) - 1.0f) - 2.0f * a.previous) * (a.damping * 0.5f) + 0.5f; }},
      {"multiplied through",
       [](const Around& a) {
         const float half = a.damping * 0.5f;
         return half * around(a) - a.damping * a.previous + (0.5f - half);
       }},
  };
  return all;
}
const std::vector<Rewrite>& rewrites(const std::string& pack) {
  return pack.find("corrected") == std::string::npos ? published_rewrites() : corrected_rewrites();
}

TEST(RearrangedPort, RegroupedWavesWarnAndDoNotFail) {
  for (const char* pack : {"puddle-corrected", "puddle-as-published"})
    for (const Format format : {Format::rg16f, Format::rg32f}) {
      const Wave wave(pack, format);
      std::int64_t found = 0;
      for (const Rewrite& r : rewrites(pack))
        for (const std::string& p : rearranging) {
          const CaseJudgement j = judged(wave.c, wave.by(r.formula), p);
          EXPECT_EQ(j.failing, 0) << pack << ' ' << info(format).name << ' ' << p << ": " << r.name << ", " << j.reason;
          EXPECT_TRUE(!r.is_as_written || j.rearranged == 0) << pack << ' ' << p;
          found += j.rearranged;
          if (j.rearranged > 0) {
            EXPECT_EQ(j.status, Status::warn);
            EXPECT_NE(j.reason.find("rearrangements (distributed)"), std::string::npos) << j.reason;
          }
        }
      EXPECT_GT(found, format == Format::rg32f ? 100 : -1) << pack << ": the rewrites change nothing";
    }
}
// Under profiles without rearrangement the same ports fail.
TEST(RearrangedPort, WhereNothingMayBeRearrangedItFails) {
  const Wave wave("puddle-corrected", Format::rg32f);
  EXPECT_GT(judged(wave.c, wave.by(corrected_rewrites()[2].formula), "cuda").failing, 100);
}

/// One mistake each.
const std::vector<Rewrite>& corrected_mistakes() {
  static const std::vector<Rewrite> all{
      {"C^2 off by 1e-4",
       [](const Around& a) { return (a.here + a.damping * (a.here - a.previous)) + a.courant_sq * 1.0001f * (around(a) - 4.0f * a.here); }},
      {"4.0001 for 4",
       [](const Around& a) { return (a.here + a.damping * (a.here - a.previous)) + a.courant_sq * (around(a) - 4.0001f * a.here); }},
      {"damping dropped", [](const Around& a) { return (a.here + (a.here - a.previous)) + a.courant_sq * (around(a) - 4.0f * a.here); }},
      {"sign of the previous level",
       [](const Around& a) { return (a.here + a.damping * (a.here + a.previous)) + a.courant_sq * (around(a) - 4.0f * a.here); }},
      {"a neighbour twice",
       [](const Around& a) {
         return (a.here + a.damping * (a.here - a.previous)) + a.courant_sq * ((a.left + a.left) + (a.down + a.up) - 4.0f * a.here);
       }},
      {"half intermediates",
       [](const Around& a) {
         const float moving = to_float(to_half(a.here + a.damping * (a.here - a.previous)));
         return moving + a.courant_sq * (around(a) - 4.0f * a.here);
       }},
  };
  return all;
}
TEST(RearrangedPort, MistakesStillFail) {
  const Wave wave("puddle-corrected", Format::rg32f);
  for (const Rewrite& r : corrected_mistakes())
    for (const std::string& p : rearranging) EXPECT_EQ(judged(wave.c, wave.by(r.formula), p).status, Status::fail) << p << ": " << r.name;
}

// What only multiplying out two sums would explain fails, and says so. A made-up pass: a square of a difference.
struct SquaredDifference {
  int width = 64, height = 4, values = 1;
  float first = 0, second = 0;
  template <class N>
  void operator()(int x, int y, N* out) const {
    const N a = N(first) + N::index(x) * N(0.01f), b = N(second) + N(static_cast<float>(y)) * N(0.1f);
    out[0] = (a - b) * (a - b);
  }
};
/// Of such a pass, by a port that multiplies out.
struct Squares {
  std::unique_ptr<capture::PassModel> model;
  PassCase c;
  std::vector<Array> port;

  Squares(float first, float second) {
    SquaredDifference pass;
    pass.first = first;
    pass.second = second;
    model = capture::model_of(pass);
    c.effect = "made_up";
    c.pass = "squared";
    capture::CaseOutput out;
    out.name = "squares";
    out.range = {0, 1e6};
    out.array.format = Format::r32f;
    out.array.width = 64;
    out.array.height = 4;
    out.array.levels.emplace_back(64 * 4 * 4);
    c.outputs = {out};
    c.outputs[0].array = reference_outputs(c, *model, test_executor())[0];
    port = {c.outputs[0].array};
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 64; ++x) {
        const float a = first + static_cast<float>(x) * 0.01f, b = second + static_cast<float>(y) * 0.1f;
        put(x, y, a * a - (a + a) * b + b * b);
      }
  }
  void put(int x, int y, float value) {
    const Slot slot = slots_of(c)[0];
    store_value(slot, value, Rounding::rne, port[0].levels[0].edit().data() + slot.offset(x, y));
  }
  CaseJudgement judged(enclosed::Rearrangement how) const {
    enclosed::Profile p = profile("vulkan");
    p.rearrangement = how;
    return judge_case(c, model.get(), port, {&p, nullptr, &test_executor(), std::nullopt}).judgements[0];
  }
};
TEST(RearrangedPort, AProductOfSumsMultipliedOutFailsAndSaysSo) {
  Squares squares(60.1f, 59.5f);
  const CaseJudgement j = squares.judged(enclosed::Rearrangement::distributed);
  EXPECT_GT(j.failing, 5);
  EXPECT_EQ(j.expanded, j.failing);
  EXPECT_NE(j.reason.find("only multiplying out a product of two sums would explain the"), std::string::npos) << j.reason;
  EXPECT_EQ(squares.judged(enclosed::Rearrangement::expanded).failing, 0);
  EXPECT_GT(squares.judged(enclosed::Rearrangement::none).failing, 0);
  // One element that it does not explain, and it is no reason.
  squares.put(9, 2, 77);
  const CaseJudgement other = squares.judged(enclosed::Rearrangement::distributed);
  EXPECT_EQ(other.status, Status::fail);
  EXPECT_EQ(other.reason.find("multiplying out"), std::string::npos) << other.reason;
}
// Where terms cancel nearly all lies inside: that explains nothing.
TEST(RearrangedPort, WhatIsFarOffIsNotSaidToBeMultipliedOut) {
  const Squares squares(1000.1f, 1000.4f);
  const CaseJudgement j = squares.judged(enclosed::Rearrangement::distributed);
  EXPECT_GT(j.failing, 100);
  EXPECT_LT(j.expanded, j.failing);
  EXPECT_EQ(j.reason.find("multiplying out"), std::string::npos) << j.reason;
  EXPECT_EQ(squares.judged(enclosed::Rearrangement::expanded).failing, 0);
}
// Groups that hold the frame before, a camera that looks elsewhere, a buffer that was not cleared, a list cut short: none of it is a
// rearrangement.
TEST(RearrangedPort, MistakesOfTheHostAreNotSaidToBeMultipliedOut) {
  const auto expect_other_reasons = [](const std::string& pack, const std::string& pass, auto change) {
    MiniPort port(pack);
    change(port);
    ValidateOptions options;
    options.only = {pass};
    const PassJudgement j = pass_of(judged(port, options), pass);
    EXPECT_EQ(j.status, Status::fail) << pass;
    std::string all = j.reason;
    for (const CaseJudgement& c : j.cases) all += c.reason;
    EXPECT_EQ(all.find("multiplying out"), std::string::npos) << all;
  };
  expect_other_reasons("puddle-corrected", "wave_step", [](MiniPort& port) {
    port.after = [](const PassCase& c, std::vector<Array>& out) {
      if (c.pass != "wave_step") return;
      const Array& before = c.input("wave")->array;
      const std::size_t texel = before.element_bytes(), row = texel * static_cast<std::size_t>(before.width);
      for (std::size_t y = 0; y < 8; ++y) std::memcpy(&out[0].levels[0].edit()[y * row], &before.levels[0][y * row], 8 * texel);
    };
  });
  expect_other_reasons("puddle-corrected", "shade", [](MiniPort& port) {
    port.before = [](PassCase& c) {
      if (c.pass != "shade") return;
      for (std::size_t at = 0; at < 16; at += 4) change_at<float>(c.uniforms.data() + at, [](float value) { return 0.95f * value; });
    };
  });
  // The drops of a still frame are added to those of the frame before: each half twice.
  expect_other_reasons("windshield-corrected", "splat", [](MiniPort& port) {
    port.after = [](const PassCase& c, std::vector<Array>& out) {
      if (c.pass != "splat") return;
      std::vector<std::byte>& halves = out[0].levels[0].edit();
      for (std::size_t at = 0; at < halves.size(); at += 2) {
        std::uint16_t h;
        std::memcpy(&h, &halves[at], 2);
        h = static_cast<std::uint16_t>(h & 0x7c00 ? h + 0x400 : h << 1);
        std::memcpy(&halves[at], &h, 2);
      }
    };
  });
  expect_other_reasons("windshield-corrected", "splat", [](MiniPort& port) {
    port.before = [](PassCase& c) {
      if (c.pass != "splat") return;
      auto u = capture::uniforms_of<drops::SplatUniforms>(c);
      u.drop_count /= 2;
      std::memcpy(c.uniforms.data(), &u, sizeof u);
    };
  });
}

// ---- integrate -----------------------------------------------------------------------------------------------------
struct Force {
  float gravity, mass, acceleration, inertia, wind, coupling, velocity, drag, dt;
};
TEST(RearrangedPort, RegroupedForcesWarnAndDoNotFail) {
  using Velocity = std::function<float(const Force&)>;
  const std::vector<std::pair<const char*, Velocity>> all{
      {"dt in each term",
       [](const Force& f) {
         return f.velocity + f.gravity * f.mass * f.dt - f.acceleration * f.inertia * f.dt + f.wind * f.coupling * f.dt -
                f.velocity * f.drag * f.dt;
       }},
      {"v (1 - drag dt)", [](const Force& f) {
         return f.velocity * (1.0f - f.drag * f.dt) + (f.gravity * f.mass - f.acceleration * f.inertia + f.wind * f.coupling) * f.dt;
       }}};
  const PassCase c = case_of("windshield-as-published", "integrate");
  const auto u = capture::uniforms_of<drops::IntegrateUniforms>(c);
  const auto glass = capture::records_of<drops::GlassFrame>(*c.input("glass_frame")).front();
  std::int64_t found = 0;
  for (const auto& [name, velocity] : all) {
    std::vector<Array> port{c.outputs[0].array};
    std::map<std::uint32_t, drops::Drop> before;
    for (const drops::Drop& d : capture::records_of<drops::Drop>(*c.input("drops"))) before[d.id] = d;
    auto* moved = reinterpret_cast<drops::Drop*>(port[0].levels[0].edit().data());
    for (int k = 0; k < port[0].width; ++k) {
      const drops::Drop& d = before.at(moved[k].id);
      if (!(d.life > 0)) continue;
      for (int axis = 0; axis < 2; ++axis) {
        moved[k].velocity[axis] = velocity({glass.gravity[axis], d.mass, glass.acceleration[axis], u.inertia_coupling, glass.wind[axis],
                                            u.wind_coupling, d.velocity[axis], u.drag, u.dt});
        moved[k].position[axis] = d.position[axis] + moved[k].velocity[axis] * u.dt;
      }
    }
    for (const std::string& p : rearranging) {
      const CaseJudgement j = judged(c, port, p);
      EXPECT_EQ(j.failing, 0) << p << ": " << name << ' ' << j.reason;
      found += j.rearranged;
    }
    EXPECT_GT(judged(c, port, "cuda").failing, 0) << name;
  }
  EXPECT_GT(found, 0);
}

// ---- every pass ----------------------------------------------------------------------------------------------------
// The reference, and every device that the profile allows as written, lie inside the rearrangements of each pass: the second tier
// holds the first.
TEST(RearrangedPort, TheSecondTierHoldsTheFirst) {
  for (const test::BoundPass& pass : test::enveloped_passes()) {
    if (!test::has_second_tier(pass)) continue;  // proofs_test.cpp names them
    for (const test::BoundCase& b : pass.cases)
      for (const char* name : {"vulkan", "d3d"}) {
        const enclosed::Profile& p = profile(name);
        const perturbed::Variations variations = perturbed::variations_of(p);
        const int texels = b.model->width() * b.model->height();
        int checked = 0;
        for (int k = 0; k < 60; ++k) {
          const int at = static_cast<int>((static_cast<std::int64_t>(k) * 7919) % texels), x = at % b.model->width(),
                    y = at / b.model->width();
          const std::vector<float> got = test::conforming_values(*b.model, x, y, variations, static_cast<std::uint64_t>(k));
          Alternatives all;
          all.rearrange(*b.model, x, y, got.data(), p);
          if (all.gave_up) continue;
          ++checked;
          EXPECT_TRUE(test::one_holds(all, *b.model, got)) << pass.name() << ' ' << name << " at " << x << ',' << y;
        }
        EXPECT_GT(checked, 20) << pass.name();
      }
  }
}

}  // namespace
}  // namespace rainref::judge
