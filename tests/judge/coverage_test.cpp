// What the small packs exercise of the pass texts: what their manifests say, for every number of threads.
#include "judge/coverage.h"

#include <array>
#include <cstring>
#include <map>
#include <set>
#include <span>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/temporary_folder.h"
#include "judge/support.h"
#include "reports/figures.h"
#include "scene/toml.h"
#include "scene/unexercised.h"

namespace rainref::judge {
namespace {

Exercise coverage_of_pass(const capture::Pack& pack, const std::string& pass, const parallel::Executor& executor) {
  Exercise all;
  for (const capture::PackCase& entry : pack.cases) {
    if (entry.pass != pass) continue;
    const capture::PassCase c = pack.read(entry);
    const std::unique_ptr<capture::PassModel> model = bound(pass, binder(pack.effect, pass), c);
    all.add(coverage_of(c, model.get(), executor));
  }
  return all;
}

class PackCoverage : public testing::TestWithParam<test::PackPasses> {};

TEST_P(PackCoverage, IsTheManifestsForEveryNumberOfThreads) {
  const capture::Pack pack(test::pack_folder(GetParam().name));
  const auto manifest = nlohmann::json::parse(contents(pack.folder() / "manifest.json"));
  for (const nlohmann::json& pass : manifest["passes"]) {
    if (!GetParam().has(pass["name"])) continue;
    for (const int threads : {1, 2, 3, 8}) {
      const std::string name = pass["name"];
      const Exercise exercised = coverage_of_pass(pack, name, parallel::Executor(threads));
      const PassCoverage c = summary(exercised, pack.pass(name).unexercised);
      if (c.alternatives == 0) {
        EXPECT_FALSE(pass.contains("coverage")) << pass["name"];
        continue;
      }
      EXPECT_EQ(pass["coverage"]["exercised"], c.taken) << pass["name"];
      EXPECT_EQ(pass["coverage"]["alternatives"], c.alternatives) << pass["name"];
      EXPECT_EQ(pass["coverage"]["never"].get<std::vector<std::string>>(), c.never) << pass["name"];
      // The scene's own; what nothing can take is known without the manifest.
      auto reasons = pass["coverage"]["reasons"].get<std::map<std::string, std::string>>();
      for (const auto& [alternative, reason] : reasons) EXPECT_TRUE(c.reasons.contains(alternative)) << pass["name"] << alternative;
      for (const Alternative& a : exercised.alternatives())
        if (!a.is_taken && !a.guard.empty()) reasons.insert({a.name, a.guard});
      EXPECT_EQ(reasons, c.reasons) << pass["name"];
    }
  }
}

// A sample takes nothing that all do not take, knows the same alternatives, and says that it is one.
TEST(Coverage, OfASampleSaysSo) {
  for (const test::BoundPass& pass : test::enveloped_passes({test::shipped_pack("puddle-corrected", {"wave_step"})})) {
    const test::BoundCase& b = pass.cases.back();
    const parallel::Executor executor(2);
    const Exercise all = coverage_of(*b.c, b.model.get(), executor), some = coverage_of(*b.c, b.model.get(), executor, 50);
    EXPECT_FALSE(all.is_sampled);
    EXPECT_TRUE(some.is_sampled);
    const std::vector<Alternative> every = all.alternatives(), sampled = some.alternatives();
    ASSERT_EQ(sampled.size(), every.size()) << pass.name();
    for (std::size_t k = 0; k < every.size(); ++k) {
      EXPECT_EQ(sampled[k].name, every[k].name);
      EXPECT_LE(sampled[k].is_taken, every[k].is_taken) << every[k].name;
    }
    EXPECT_EQ(reports::coverage_text(summary(all), 0).find("by a sample"), std::string::npos);
    EXPECT_NE(reports::coverage_text(summary(some), 0).find(" alternatives by a sample"), std::string::npos);
  }
}

/// What the shipped packs of an effect and a variant exercise of a pass, and which reasons their scenes give for the rest.
struct Shipped {
  Exercise exercised;
  std::map<std::string, std::string> reasons;
  std::map<std::string, int> lines;  ///< of names
};
std::map<std::string, Shipped> shipped_passes() {
  std::map<std::string, Shipped> all;
  for (const test::PackPasses& shipped : test::shipped_packs()) {
    const std::string& name = shipped.name;
    const capture::Pack pack(test::pack_folder(name));
    const std::string file = rainref::test::pack_scene(name);
    const auto scene = scene::unexercised(scene::read_scene(file), file);
    for (const capture::PackPass& pass : pack.passes) {
      const Exercise exercised = coverage_of_pass(pack, pass.name, parallel::Executor(2));
      Shipped& of = all[pack.effect + " " + pack.variant + " " + pass.name];
      of.exercised.add(exercised);
      // A name is of one line in each pack, though what a run does not reach has no number; those of guards are not told apart.
      for (const Alternative& a : exercised.alternatives())
        EXPECT_EQ(of.lines.emplace(a.name, a.line).first->second, a.line) << name << ' ' << pass.name << ": " << a.name;
      if (!scene.contains(pass.name)) continue;
      const PassCoverage c = summary(exercised, scene.at(pass.name));
      for (const auto& [alternative, reason] : scene.at(pass.name)) {
        EXPECT_TRUE(c.reasons.contains(alternative)) << "it is done: " << name << ' ' << pass.name << ": " << alternative;
        of.reasons[alternative] = reason;
      }
    }
  }
  return all;
}

// In what the shipped packs never do a mistake would not be found: so it is a guard, or a scene says why.
TEST(ShippedPacks, ExerciseEveryAlternativeButThoseWithAReason) {
  for (const auto& [pass, of] : shipped_passes())
    for (const Alternative& a : of.exercised.alternatives()) {
      const bool has_own = !a.is_taken && of.reasons.contains(a.name);
      EXPECT_EQ(has_own + !a.guard.empty(), a.is_taken ? 0 : 1) << pass << ": " << a.name;
    }
}

/// A made-up run of the windshield's normals, corrected.
capture::PassCase run_of_normals(float slope_shear, int columns) {
  capture::PassCase c;
  c.effect = "windshield";
  c.variant = "corrected";
  c.pass = "normals";
  const std::array<float, 4> slopes{3, slope_shear, 1, 0};  // slope_x, slope_shear, slope_y, padding
  c.uniforms.resize(sizeof slopes);
  std::memcpy(c.uniforms.data(), slopes.data(), sizeof slopes);
  c.inputs.resize(1);
  c.inputs[0].name = "height";
  c.inputs[0].array.width = columns;
  c.inputs[0].array.height = 1;
  c.outputs.resize(1);
  return c;
}
// An upright pane has no shear: a port that leaves the shear out gives the same bits. So it is with an image of one texel.
TEST(CoverageOf, CountsUniformsThatAreNeither0Nor1AndImagesOfMoreThanOneTexel) {
  const parallel::Executor executor(1);
  Exercise all = coverage_of(run_of_normals(-1, 1), nullptr, executor);
  EXPECT_EQ(all.values, (std::map<std::string, bool>{{"input height: more than one texel", false},
                                                     {"uniform slope_shear: neither 0 nor 1", false},
                                                     {"uniform slope_x: neither 0 nor 1", true},
                                                     {"uniform slope_y: neither 0 nor 1", false}}));
  all.add(coverage_of(run_of_normals(0.5f, 2), nullptr, executor));
  EXPECT_EQ(all.values, (std::map<std::string, bool>{{"input height: more than one texel", true},
                                                     {"uniform slope_shear: neither 0 nor 1", true},
                                                     {"uniform slope_x: neither 0 nor 1", true},
                                                     {"uniform slope_y: neither 0 nor 1", false}}));
  const PassCoverage c = summary(all, {{"uniform slope_y: neither 0 nor 1", "the slope is 1"}});
  EXPECT_EQ(c.taken, 3);
  EXPECT_EQ(c.alternatives, 4);
  EXPECT_THAT(c.never, testing::IsEmpty());
  EXPECT_THAT(c.reasons, testing::ElementsAre(testing::Pair("uniform slope_y: neither 0 nor 1", "the slope is 1")));
}

/// What the reference gives: all values of all invocations, and the lists.
std::vector<std::byte> given(const capture::PassCase& c, const capture::PassModel& model) {
  std::vector<std::byte> all;
  std::vector<scalar::Scalar<float>> values(static_cast<std::size_t>(model.values()));
  const auto append = [&](const std::span<const std::byte> bytes) { all.insert(all.end(), bytes.begin(), bytes.end()); };
  for (int y = 0; y < model.height(); ++y)
    for (int x = 0; x < model.width(); ++x) {
      model.evaluate(x, y, values.data());
      append(std::as_bytes(std::span(values)));
    }
  for (const capture::CaseOutput& out : c.outputs)
    if (const capture::KeyedModel* list = model.keyed(out.name))
      if (const auto bytes = list->reference()) append(*bytes);
  return all;
}
// What a variant is said not to read changes nothing that it stores: else a mistake in it would be found, and counted as not to be.
TEST(ShippedPacks, AUniformThatAVariantDoesNotReadChangesNothing) {
  int tried = 0;
  for (const test::PackPasses& one : test::shipped_packs()) {
    const std::string& name = one.name;
    const capture::Pack pack(test::pack_folder(name));
    std::set<std::string> seen;
    for (const capture::PackCase& entry : pack.cases) {
      const Bind bind = binder(pack.effect, entry.pass);
      if (!bind || !seen.insert(entry.pass).second) continue;
      const capture::PassCase c = pack.read(entry);
      const std::unique_ptr<capture::PassModel> model = bound(entry.pass, bind, c);
      if (!model) continue;
      const std::vector<std::byte> expected = given(c, *model);
      ASSERT_FALSE(expected.empty()) << name << ' ' << entry.pass;
      for (const scene::Member& m : pack.pass(entry.pass).block.members) {
        if (is_read_by(m, pack.variant)) continue;
        capture::PassCase other = c;
        for (int k = 0; k < m.components; ++k) {
          const float number = 0.375f;
          const std::int32_t whole = 1;
          std::memcpy(other.uniforms.data() + m.offset + 4 * static_cast<std::size_t>(k),
                      m.scalar == scene::Scalar::float32 ? static_cast<const void*>(&number) : &whole, 4);
        }
        ASSERT_EQ(given(other, *bound(entry.pass, bind, other)), expected) << name << ' ' << entry.pass << ' ' << m.name;
        ++tried;
      }
    }
  }
  EXPECT_GE(tried, 60);
}

TEST(Alternatives, HaveNamesOfFunctionKindAndNumber) {
  using perturbed::Perturbed;
  Exercise e;
  {
    perturbed::Behaviour counting;
    counting.coverage = &e.decisions;
    const perturbed::Scope scope(counting);
    const Perturbed zero(0.0f), one(1.0f);
    max(one, zero);
    scalar::guard<Perturbed>(max(one, zero), "one is larger");
    max(zero, one);
    [&] { saturate(one); }();
  }
  e.values["uniform x: neither 0 nor 1"] = false;
  e.guards["uniform x: neither 0 nor 1"] = "it is 1";
  const auto is = [](const char* name, bool is_taken, const char* guard) {
    return testing::AllOf(testing::Field(&Alternative::name, name), testing::Field(&Alternative::is_taken, is_taken),
                          testing::Field(&Alternative::guard, guard));
  };
  EXPECT_THAT(
      e.alternatives(),
      testing::ElementsAre(
          is("coverage_test.cpp, TestBody: max, the first", true, ""), is("coverage_test.cpp, TestBody: max, the second", false, ""),
          is("coverage_test.cpp, TestBody: guarded max, the first", true, ""),
          is("coverage_test.cpp, TestBody: guarded max, the second", false, "one is larger"),
          is("coverage_test.cpp, TestBody: max 2, the first", false, ""), is("coverage_test.cpp, TestBody: max 2, the second", true, ""),
          is("coverage_test.cpp, a lambda: clamp, below", false, ""), is("coverage_test.cpp, a lambda: clamp, within", true, ""),
          is("coverage_test.cpp, a lambda: clamp, above", false, ""), is("uniform x: neither 0 nor 1", false, "it is 1")));
}
TEST(Alternatives, NameALookupByWhatItReads) {
  using perturbed::DecisionKind;
  EXPECT_EQ(name_of({"clamp", 0, DecisionKind::address, "", "bed"}, 1, false, 0), "lookup of bed by clamp: before the first texel");
  EXPECT_EQ(name_of({"border", 0, DecisionKind::load, "", ""}, 1, false, 2), "load of an image by border: behind the last texel");
}

INSTANTIATE_TEST_SUITE_P(Packs, PackCoverage, testing::ValuesIn(test::proven_packs()), test::name_of_pack_test);

}  // namespace
}  // namespace rainref::judge
