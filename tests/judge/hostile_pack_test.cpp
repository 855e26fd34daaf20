// Packs and ports whose shapes, formats, uniforms and records cannot be the pass's: each is refused with one line before anything
// is evaluated. Every one of these ended the program, or gave a verdict from memory that is not its own, once.
#include <cmath>
#include <limits>
#include <set>

#include <gmock/gmock.h>

#include "base/error_of.h"
#include "faults/diagnose.h"
#include "faults/mutate.h"
#include "fuzz/pack_target.h"
#include "judge/check_pack.h"

namespace rainref::judge {
namespace {

using capture::PassCase;
using fuzz::Base;
using testing::AllOf;
using testing::HasSubstr;

/// What is said of files that cannot be the pass's.
testing::Matcher<const std::string&> Refuses(const std::string& part) { return AllOf(testing::StartsWith("3 "), HasSubstr(part)); }

const Base& base_of(const std::string& name) {
  for (const Base& b : fuzz::bases())
    if (b.name == name) return b;
  throw std::runtime_error("no pack " + name);
}
const PassCase& case_of(const Base& base, const std::string& pass) {
  for (const PassCase& c : base.cases)
    if (c.pass == pass) return c;
  throw std::runtime_error("no pass " + pass);
}
const scene::UniformBlock& block_of(const Base& base, const PassCase& c) {
  return registry::effect_of_pack(base.effect).info->pass(c.pass).block(c.variant);
}

/// A pack of one case, its files and manifest in agreement, and a port that stores what is expected.
class Hostile {
 public:
  Hostile(const Base& base, const PassCase& c) : base_(base) {
    const capture::EffectInfo& effect = *registry::effect_of_pack(base.effect).info;
    const fuzz::Folder pack(folder_ / "pack"), port(folder_ / "port");
    const std::string id = c.folder() + "/";
    pack.put(id + "uniforms.bin", c.uniforms);
    manifest = base.head;
    fuzz::Json entry = capture::case_json(c, effect, {id + "uniforms.bin", c.uniforms.size(), file_hash(c.uniforms)});
    entry["inputs"] = entry["outputs"] = fuzz::Json::array();
    for (const capture::CaseInput& i : c.inputs) {
      entry["inputs"].push_back(capture::input_json(i, effect.buffer(i.name, c.variant), pack.put(id + "in." + i.name, i.array)));
      port.put(id + "in." + i.name, i.array);
    }
    for (const capture::CaseOutput& o : c.outputs) {
      entry["outputs"].push_back(
          capture::output_json(o, effect.buffer(o.name, c.variant), effect.pass(c.pass), pack.put(id + "out." + o.name, o.array)));
      port.put(id + "out." + o.name, o.array);
    }
    port.put(id + "uniforms.bin", c.uniforms);
    manifest["cases"].push_back(std::move(entry));
    write();
  }
  void write() const { put(folder_ / "pack" / capture::manifest_name, manifest.dump()); }
  /// What validate and mutate say; both must refuse it in the same words.
  std::string refusal() const {
    ValidateOptions options;
    options.executor = &executor();
    options.explain = faults::diagnose;
    const auto by_validate = error_of([&] { validate(capture::Pack(folder_ / "pack"), folder_ / "port", options); });
    const auto by_mutate = error_of([&] { faults::mutate(capture::Pack(folder_ / "pack"), options, 16); });
    EXPECT_EQ(by_validate, by_mutate);
    return by_validate;
  }
  PortJudgement shadowed() const {
    ValidateOptions options;
    options.executor = &executor();
    const ShadowPlan plan = ShadowPlan::of_manifest(capture::Pack(folder_ / "pack"), false);
    std::vector<std::string> passes;
    for (const capture::PackPass& pass : plan.passes) passes.push_back(pass.name);
    return shadow(plan, folder_ / "port", dumped_runs(folder_ / "port", base_.effect, passes), options);
  }
  std::filesystem::path folder() const { return folder_ / "pack"; }
  std::filesystem::path port() const { return folder_ / "port"; }

  fuzz::Json manifest;

 private:
  static const parallel::Executor& executor() {
    static const parallel::Executor one(1);
    return one;
  }
  const Base& base_;
  TemporaryFolder folder_;
};

TEST(HostilePack, AGoodOneIsTaken) {
  for (const Base& base : fuzz::bases())
    for (PassCase c : base.cases) {
      ASSERT_TRUE(fuzz::settle(base, c)) << c.folder();
      EXPECT_EQ(Hostile(base, c).refusal(), "none") << c.folder();
    }
}

// The heap was written past its end where outputs were fewer than the pass has; exchanged ones blamed the port.
TEST(HostilePack, OtherOutputsThanThePassHasAreRefused) {
  const Base& base = base_of("edge_splash-corrected");
  const PassCase& splash = case_of(base, "splash");
  const auto names = [&](const std::vector<std::size_t>& outputs) {
    std::string out;
    for (const std::size_t k : outputs) out += (out.empty() ? "" : ", ") + splash.outputs[k].name;
    return out;
  };
  ASSERT_EQ(splash.outputs.size(), 4u);
  for (const std::vector<std::size_t>& outputs : {std::vector<std::size_t>{0, 1}, {3}, {1, 0, 2, 3}}) {
    Hostile hostile(base, splash);
    fuzz::Json& of = hostile.manifest["cases"][0]["outputs"];
    const fuzz::Json all = of;
    of = fuzz::Json::array();
    for (const std::size_t k : outputs) of.push_back(all[k]);
    hostile.write();
    EXPECT_THAT(hostile.refusal(), Refuses("expected the outputs " + names({0, 1, 2, 3}) + ", in this order, found " + names(outputs)));
  }
}

// The heap was written past its end where an input was larger than the output, and read past its end where it was smaller.
TEST(HostilePack, AnInputOfAnotherSizeThanTheOutputsIsRefused) {
  int tried = 0;
  for (const Base& base : fuzz::bases()) {
    for (const PassCase& good : base.cases) {
      const capture::PassInfo& pass = registry::effect_of_pack(base.effect).info->pass(good.pass);
      for (std::size_t i = 0; i < good.inputs.size(); ++i) {
        const auto read =
            std::find_if(pass.reads.begin(), pass.reads.end(), [&](const capture::ReadInfo& r) { return r.buffer == good.inputs[i].name; });
        if (!read->per_texel) continue;
        for (const int more : {-1, 1, 40}) {
          PassCase c = good;
          capture::Array& a = c.inputs[i].array;
          fuzz::resize(a, a.width + more, a.height);
          EXPECT_THAT(Hostile(base, c).refusal(), Refuses(c.folder() + ": in." + c.inputs[i].name + ": expected ")) << more;
          ++tried;
        }
      }
    }
  }
  EXPECT_GT(tried, 60);
}

// Every image input of every pass in a format of another channel count, and every output in another one.
TEST(HostilePack, AnotherFormatIsRefused) {
  for (const Base& base : fuzz::bases()) {
    for (const PassCase& good : base.cases) {
      for (std::size_t k = 0; k < good.inputs.size() + good.outputs.size(); ++k) {
        PassCase c = good;
        const bool is_input = k < c.inputs.size();
        capture::Array& a = is_input ? c.inputs[k].array : c.outputs[k - c.inputs.size()].array;
        if (a.is_records) continue;
        a.format = info(a.format).channels == 1 ? Format::rg8 : Format::r8;
        fuzz::resize(a, a.width, a.height);
        a.levels.resize(1);
        a.levels[0].edit().resize(static_cast<std::size_t>(a.width) * static_cast<std::size_t>(a.height) * a.element_bytes());
        EXPECT_THAT(Hostile(base, c).refusal(), Refuses(c.folder() + (is_input ? ": in." : ": out.")));
      }
    }
  }
}

// Uniforms became addresses. Each float of each pass, with a NaN, both infinities and the largest numbers; each integer at its ends.
TEST(HostilePack, UniformsOutOfTheirRangesAreRefused) {
  int tried = 0;
  for (const Base& base : fuzz::bases()) {
    for (const PassCase& good : base.cases) {
      const scene::UniformBlock& block = block_of(base, good);
      for (const scene::Member& m : block.members) {
        for (const float number : {std::numeric_limits<float>::quiet_NaN(), INFINITY, -INFINITY, 3e38f, -3e38f}) {
          if (m.scalar != scene::Scalar::float32) continue;
          PassCase c = good;
          std::memcpy(c.uniforms.data() + m.offset, &number, sizeof number);
          EXPECT_THAT(capture::uniform_fault(*registry::effect_of_pack(base.effect).info, c), HasSubstr("uniform " + m.name)) << number;
          ++tried;
        }
      }
    }
  }
  EXPECT_GT(tried, 1000);
}
TEST(HostilePack, AUniformThatWouldBeAnAddressIsRefusedByPackAndShadow) {
  struct Step {
    const char *pack, *pass, *member;
    float value;
    const char* says;
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Step& step :
       {Step{"puddle-as-published", "wave_step", "step", 1e5f, "uniform step is 100000, expected 1 to 8"},
        Step{"puddle-as-published", "wave_step", "step", 200, "uniform step is 200, expected 1 to 8"},
        Step{"edge_splash-corrected", "splash", "noise_scale", 3.4e38f,
             "uniform noise_scale.x is 3.3999999521443642e+38, expected 0 to 1e+07"},
        Step{"edge_splash-corrected", "splash", "noise_offset", nan, "uniform noise_offset.x is nan, expected 0 to 1"},
        Step{"puddle-corrected", "surface_hit", "inverse_size", INFINITY, "uniform inverse_size.x is inf, expected 0 to 100000"},
        Step{"puddle-corrected", "surface_hit", "camera_position", nan, "uniform camera_position.x is nan, expected -100000 to 100000"},
        // Steps of nothing: the march took minutes.
        Step{"puddle-as-published", "surface_hit", "epsilon", 0, "uniform epsilon is 0, expected 1e-05 to 1"}}) {
    const Base& base = base_of(step.pack);
    PassCase c = case_of(base, step.pass);
    for (const scene::Member& m : block_of(base, c).members)
      if (m.name == step.member) std::memcpy(c.uniforms.data() + m.offset, &step.value, sizeof step.value);
    EXPECT_THAT(Hostile(base, c).refusal(), Refuses(c.folder() + ": " + step.says));
    // A port that took such a uniform in its own run fails for it, with a report.
    const Hostile good(base, case_of(base, step.pass));
    const fuzz::Folder port(good.port());
    port.put(c.folder() + "/uniforms.bin", c.uniforms);
    const PortJudgement j = good.shadowed();
    EXPECT_EQ(j.status, Status::fail);
    bool is_named = false;
    for (const PassJudgement& pass : j.passes) is_named |= pass.pass == step.pass && pass.reason == step.says;
    EXPECT_TRUE(is_named) << step.says;
  }
}

TEST(HostilePack, RecordsThatAreNoNumbersAreRefused) {
  for (const auto& [pack, pass] :
       {std::pair{"windshield-corrected", "merge"}, {"puddle-corrected", "wave_step"}, {"windshield-as-published", "splat"}}) {
    const Base& base = base_of(pack);
    PassCase c = case_of(base, pass);
    for (capture::CaseInput& input : c.inputs) {
      if (input.name != "drops") continue;
      const float nan = std::numeric_limits<float>::quiet_NaN();
      std::memcpy(input.array.levels[0].edit().data() + 2 * input.array.record.size, &nan, sizeof nan);
    }
    EXPECT_THAT(Hostile(base, c).refusal(), AllOf(Refuses("in.drops: record 2: "), HasSubstr(" is nan, expected a finite number")));
  }
}

TEST(HostilePack, WhatThePassDoesNotHaveIsRefused) {
  const Base& base = base_of("puddle-corrected");
  const PassCase& good = case_of(base, "display");
  const auto refusal = [&](const auto& change) {
    Hostile pack(base, good);
    change(pack.manifest["cases"][0]);
    pack.write();
    return pack.refusal();
  };
  EXPECT_THAT(refusal([](fuzz::Json& c) { c["inputs"][0]["name"] = "color"; }),
              HasSubstr("in.color: expected one of the inputs colour, found 'color'; did you mean 'colour'?"));
  EXPECT_THAT(refusal([](fuzz::Json& c) { c["outputs"][0]["name"] = "film"; }),
              HasSubstr("out.film: expected one of the outputs picture, found 'film'"));
  EXPECT_THAT(refusal([](fuzz::Json& c) { c["outputs"][0]["judge"] = "input_only"; }),
              HasSubstr("out.picture: expected judge \"envelope\", found \"input_only\""));
  EXPECT_THAT(refusal([](fuzz::Json& c) { c["outputs"].push_back(c["outputs"][0]); }),
              HasSubstr("out.picture: expected one output of this name, found two"));
  EXPECT_THAT(refusal([](fuzz::Json& c) { c["inputs"].push_back(c["inputs"][0]); }),
              HasSubstr("in.colour: expected one input of this name, found two"));
}

// The diagnosis asks what the other variant's formula gives, also where there is none; merge then wrote where its film has no texel.
TEST(HostilePack, APassIsBoundInVariantsThatItHasAlone) {
  std::set<std::string> refused;
  for (const Base& base : fuzz::bases())
    for (PassCase c : base.cases) {
      const capture::PassEvaluations* evaluations = evaluations_of(c.effect, c.pass);
      // Another effect may run these as published.
      if (!evaluations || !evaluations->bind || c.pass == "integrate" || c.pass == "splat") continue;
      c.variant = c.corrected() ? "as-published" : "corrected";
      if (registry::effect_of_pack(base.effect).info->pass(c.pass).variant(c.variant)) continue;
      EXPECT_THAT(error_of([&] { evaluations->bind(c); }), Refuses(c.folder())) << c.variant;
      refused.insert(c.pass);
    }
  EXPECT_TRUE(refused.contains("merge"));
  EXPECT_GT(refused.size(), 1u);
}

TEST(HostilePack, ADeepManifestIsRefused) {
  const Base& base = base_of("puddle-corrected");
  Hostile pack(base, case_of(base, "display"));
  // The parser takes any depth; what walked the result ran out of stack.
  std::string text = pack.manifest.dump();
  text.insert(text.size() - 1, ",\"deep\":" + std::string(100000, '[') + std::string(100000, ']'));
  put(pack.folder() / capture::manifest_name, text);
  EXPECT_THAT(pack.refusal(), Refuses("nested deeper than 16"));
}

}  // namespace
}  // namespace rainref::judge
