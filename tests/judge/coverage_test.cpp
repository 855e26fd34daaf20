// What the small packs exercise of the pass texts: what their manifests say, for every number of threads.
#include "judge/coverage.h"

#include <fstream>
#include <map>
#include <set>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/temporary_folder.h"
#include "judge/pass_texts.h"
#include "judge/support.h"
#include "scene/toml.h"
#include "scene/unexercised.h"

namespace rainref::judge {
namespace {

perturbed::Coverage coverage_of_pass(const capture::Pack& pack, const std::string& pass, const parallel::Executor& executor) {
  perturbed::Coverage all;
  for (const capture::PackCase& entry : pack.cases) {
    if (entry.pass != pass) continue;
    const capture::PassCase c = pack.read(entry);
    const std::unique_ptr<capture::PassModel> model = bound(pass, binder(pack.effect, pass), c);
    all.add(coverage_of(c, model.get(), executor));
  }
  return all;
}

/// Alternatives of a pass that its cases take, and those that they do not.
struct Sides {
  std::set<std::string> taken, not_taken;
};
Sides sides_of(const capture::Pack& pack, const std::string& pass) {
  Sides out;
  for (const auto& [decision, counts] : coverage_of_pass(pack, pass, parallel::Executor(2)).decisions())
    for (int side = 0; side < perturbed::sides(decision.kind); ++side)
      (counts[static_cast<std::size_t>(side)] > 0 ? out.taken : out.not_taken).insert(alternative(decision, side));
  return out;
}

class PackCoverage : public testing::TestWithParam<test::PackPasses> {};

TEST_P(PackCoverage, IsTheManifestsForEveryNumberOfThreads) {
  const capture::Pack pack(test::pack_folder(GetParam().name));
  const auto manifest = nlohmann::json::parse(contents(pack.folder() / "manifest.json"));
  for (const nlohmann::json& pass : manifest["passes"]) {
    if (!GetParam().has(pass["name"])) continue;
    for (const int threads : {1, 2, 3, 8}) {
      const std::string name = pass["name"];
      const PassCoverage c = summary(coverage_of_pass(pack, name, parallel::Executor(threads)), pack.pass(name).unexercised);
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
      for (const auto& [alternative, reason] : unreached())
        if (c.reasons.contains(alternative)) reasons.insert({alternative, reason});
      EXPECT_EQ(reasons, c.reasons) << pass["name"];
    }
  }
}

/// What the shipped packs of an effect and a variant exercise of a pass, and which reasons their scenes give for the rest.
struct Shipped {
  Sides sides;
  std::map<std::string, std::string> reasons;
};
std::map<std::string, Shipped> shipped_passes() {
  std::map<std::string, Shipped> all;
  for (const test::PackPasses& shipped : test::shipped_packs()) {
    const std::string& name = shipped.name;
    const capture::Pack pack(test::pack_folder(name));
    const std::string file = rainref::test::pack_scene(name);
    const auto scene = scene::unexercised(scene::read_scene(file), file);
    for (const capture::PackPass& pass : pack.passes) {
      Sides sides = sides_of(pack, pass.name);
      Shipped& of = all[pack.effect + " " + pack.variant + " " + pass.name];
      if (scene.contains(pass.name))
        for (const auto& [alternative, reason] : scene.at(pass.name)) {
          // No reason stands for what is done.
          EXPECT_TRUE(sides.not_taken.contains(alternative)) << name << ' ' << pass.name << ": " << alternative;
          of.reasons[alternative] = reason;
        }
      of.sides.taken.merge(sides.taken);
      of.sides.not_taken.merge(sides.not_taken);
    }
  }
  return all;
}

// In what the shipped packs never do a mistake would not be found: so it is a guard, or a scene says why.
TEST(ShippedPacks, ExerciseEveryAlternativeButThoseWithAReason) {
  std::set<std::string> unused;
  for (const auto& [alternative, reason] : unreached()) unused.insert(alternative);
  for (const auto& [pass, of] : shipped_passes()) {
    for (const std::string& a : of.sides.not_taken) {
      unused.erase(a);
      if (of.sides.taken.contains(a)) continue;
      EXPECT_EQ(of.reasons.contains(a) + unreached().contains(a), 1) << pass << ": " << a;
    }
    for (const std::string& a : of.sides.taken) EXPECT_FALSE(unreached().contains(a)) << pass << ": " << a;
  }
  EXPECT_THAT(unused, testing::IsEmpty()) << "no pass text has these";
}
TEST(PassLine, IsTheLineWithoutIndentationAndComment) {
  std::ifstream in(rainref::test::source_folder() + "/src/math/optics-inl.h");
  int n = 0, found = 0;
  for (std::string line; std::getline(in, line);) {
    ++n;
    if (line == "  const N m = N(1.0f) - cosine, m2 = square(m);") {
      EXPECT_EQ(pass_line("math/optics-inl.h", n), "const N m = N(1.0f) - cosine, m2 = square(m);");
      ++found;
    }
    if (line.ends_with("// 1 / 2.4")) {
      EXPECT_TRUE(pass_line("math/optics-inl.h", n).ends_with("N(0x1.aaaaaap-2f));")) << pass_line("math/optics-inl.h", n);
      ++found;
    }
  }
  EXPECT_EQ(found, 2);
  EXPECT_EQ(pass_line("math/optics-inl.h", n + 5), "");
  EXPECT_EQ(pass_line("math/none.h", 1), "");
}
TEST(Alternative, NamesALookupByWhatItReads) {
  using perturbed::DecisionKind;
  EXPECT_EQ(alternative({"clamp", 0, DecisionKind::address, "bed"}, 0), "lookup of bed by clamp: before the first texel");
  EXPECT_EQ(alternative({"border", 0, DecisionKind::load, ""}, 2), "load of an image by border: behind the last texel");
  EXPECT_EQ(alternative({"puddle/none.pass.h", 7, DecisionKind::choice, ""}, 1), "none.pass.h, select the second: line 7");
}

INSTANTIATE_TEST_SUITE_P(Packs, PackCoverage, testing::ValuesIn(test::proven_packs()), test::name_of_pack_test);

}  // namespace
}  // namespace rainref::judge
