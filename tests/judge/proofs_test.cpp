// Every pass and variant that `rainref list` names is in every proof, or its reason stands here. Prints the list of passes by proof.
#include <gmock/gmock.h>

#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "base/error_of.h"
#include "base/temporary_folder.h"
#include "capture/pass_info.h"
#include "documents/all_written.h"
#include "judge/keyed.h"
#include "judge/rewritten_passes.h"
#include "judge/support.h"
#include "registry/evaluations.h"
#include "registry/registry.h"

namespace rainref::judge {
namespace {

using namespace test;
using Passes = std::set<std::string>;  // "windshield-corrected merge"

/// A proof, the passes that it goes over, and where it stands.
struct Proof {
  std::string name, where;
  Passes passes;
};
/// Why some passes are in none of these proofs; "splat" is that pass in every effect and variant.
struct Absence {
  std::vector<std::string> proofs, passes;
  const char* reason;
};
const std::vector<Absence> absences{
    {{"honest", "tight", "null ports", "tier 2", "rewritten", "mutated", "alternatives", "GLSL", "seeded", "WGSL"},
     {"puddle-as-published ground_noise"},
     "the host makes it: a port takes it as data"},
    {{"honest", "tight", "tier 2", "rewritten"}, {"spawn", "puddle-corrected raindrops"}, "whole numbers alone: judged by bits"},
    {{"mutated"}, {"puddle-corrected raindrops"}, "judged by bits; bits_replay_test.cpp has its mistakes"},
    {{"tier 2"},
     {"puddle-as-published surface_hit"},
     "a march of distances, nearly every comparison of which is open once it is rearranged"},
    {{"tier 2"}, {"merge", "windshield-corrected wipe_drops"}, "water is counted in whole units: what is moved tips one or does not"},
    {{"rewritten"},
     {"surface_hit", "puddle-as-published raindrops", "windshield_frame", "integrate", "necks", "merge", "wipe_drops"},
     "no invocation of an image that one text computes: Lists and RearrangedPort have their rearrangements"},
    {{"seeded"},
     {"screen_drops-corrected spawn", "screen_drops-corrected integrate", "screen_drops-corrected necks", "screen_drops-corrected merge",
      "screen_drops-corrected splat"},
     "its shaders are the windshield's, in which bugs are seeded"},
};

Passes all_passes() {
  Passes all;
  for (const effect::Effect* e : registry::effects())
    for (const std::string& variant : e->variants)
      for (const std::string& pass : e->info->pass_names(variant)) all.insert(e->name + "-" + variant + " " + pass);
  return all;
}
template <class Takes>
Passes those(const std::vector<BoundPass>& all, const Takes& takes) {
  Passes some;
  for (const BoundPass& pass : all)
    if (takes(pass)) some.insert(pass.pass_and_variant);
  return some;
}
/// Passes that have a port: `programs` of a file for each effect, by formula.
Passes ported(const std::string& file) {
  Passes some;
  for (const effect::Effect* e : registry::effects()) {
    const std::string name = rainref::test::source_folder() + "/examples/ports/" + fmt::format(fmt::runtime(file), e->name);
    const auto programs = nlohmann::json::parse(contents(name)).at("programs");
    for (const capture::PassInfo& pass : e->info->passes)
      for (const capture::PassVariant& v : pass.variants)
        if (programs.contains(capture::formula(*e->info, pass, v))) some.insert(e->name + "-" + v.name + " " + pass.name);
  }
  return some;
}

/// Passes whose GLSL port has bugs seeded in it.
Passes seeded() {
  Passes some;
  for (const auto& file : std::filesystem::directory_iterator(rainref::test::source_folder() + "/tests/ports/mutants")) {
    const auto all = nlohmann::json::parse(contents(file.path()));
    for (const nlohmann::json& m : all.at("mutants"))
      some.insert(fmt::format("{}-{} {}", all.at("effect").get<std::string>(), m.at("variant").get<std::string>(),
                              m.at("pass").get<std::string>()));
  }
  return some;
}

std::vector<Proof> proofs() {
  const std::vector<BoundPass> judged = judged_passes();
  const auto is_enveloped_or_listed = [](const BoundPass& p) { return !p.cases.front().slots.empty() || p.cases.front().list(); };
  const Passes modelled = those(judged, is_enveloped_or_listed);
  Passes packed, counted, written;
  for (const PackPasses& p : proven_packs()) {
    const auto manifest = nlohmann::json::parse(contents(pack_folder(p.name) / "manifest.json"));
    for (const nlohmann::json& pass : manifest["passes"]) {
      const std::string name = p.effect_and_variant() + " " + pass["name"].get<std::string>();
      if (!p.has(pass["name"])) continue;
      packed.insert(name);
      if (pass.contains("coverage")) counted.insert(name);
    }
  }
  for (const documents::Written& w : documents::all_written())
    for (const std::string& of : w.packs) written.insert(of + " " + w.pass);
  return {
      {"packed", "tests/judge/small_packs_test.cpp, own_outputs_test.cpp", packed},
      {"alternatives", "tests/judge/coverage_test.cpp", counted},
      {"honest", "tests/judge/honesty_test.cpp, list_proofs_test.cpp", modelled},
      {"tight", "tests/judge/tightness_test.cpp, list_proofs_test.cpp", modelled},
      {"null ports", "tests/judge/null_ports_test.cpp", those(judged, [](const BoundPass&) { return true; })},
      {"tier 2", "tests/judge/rearranged_test.cpp, list_proofs_test.cpp",
       those(judged, [](const BoundPass& p) { return has_second_tier(p); })},
      {"rewritten", "tests/judge/rewritten_passes_test.cpp",
       those(enveloped_passes(), [](const BoundPass& p) { return is_rewritten(*p.cases.front().c); })},
      {"mutated", "tests/faults/mutation_test.cpp, list_faults_test.cpp",
       those(judged, [](const BoundPass& p) { return !p.cases.front().slots.empty() || !keyed_outputs(*p.cases.front().c).empty(); })},
      {"printed", "tests/documents/written_test.cpp", written},
      {"GLSL", "tests/ports: ports_tests", ported("{}/bindings.json")},
      {"seeded", "tests/ports/mutants: ports_tests, scripts/full/mutants", seeded()},
      {"WGSL", "tests/ports/wgsl_test.cpp", ported("wgsl/{}/programs.json")},
  };
}

TEST(Proofs, GoOverEveryPassAndVariant) {
  const Passes all = all_passes();
  const std::vector<Proof> proven = proofs();
  // Of each absence the passes that it is the reason for.
  std::map<std::pair<std::string, std::string>, const char*> reasons;
  for (const Absence& a : absences)
    for (const std::string& proof : a.proofs) {
      EXPECT_TRUE(std::any_of(proven.begin(), proven.end(), [&](const Proof& p) { return p.name == proof; })) << proof << " is no proof";
      for (const std::string& named : a.passes) {
        bool is_any = false;
        for (const std::string& pass : all)
          if (pass == named || pass.ends_with(" " + named)) is_any = reasons.emplace(std::pair(proof, pass), a.reason).second || is_any;
        EXPECT_TRUE(is_any) << named << " is no pass, or has two reasons to be in no proof '" << proof << "'";
      }
    }
  std::string table = fmt::format("{:<40}", "pass");
  for (const Proof& p : proven) table += fmt::format(" {}", p.name);
  int whole = 0;
  for (const std::string& pass : all) {
    table += fmt::format("\n{:<40}", pass);
    bool is_whole = true;
    for (const Proof& p : proven) {
      const auto reason = reasons.find({p.name, pass});
      const bool is_proven = p.passes.contains(pass), has_reason = reason != reasons.end();
      if (is_proven) {
        EXPECT_FALSE(has_reason) << pass << " is in the proof '" << p.name << "': the reason is stale: " << reason->second;
      } else {
        EXPECT_TRUE(has_reason) << pass << " is not in the proof '" << p.name << "' (" << p.where << ")";
      }
      is_whole &= is_proven || has_reason;
      table += fmt::format(" {:<{}}", is_proven ? "yes" : has_reason ? "-" : "NO", p.name.size());
    }
    whole += is_whole;
  }
  fmt::print("{}\n\n", table);
  for (const Proof& p : proven) fmt::print("{:<13} {:2} of {}  {}\n", p.name, p.passes.size(), all.size(), p.where);
  for (const Absence& a : absences) fmt::print("- {}: {}: {}\n", fmt::join(a.proofs, ", "), fmt::join(a.passes, ", "), a.reason);
  fmt::print("{} of {} passes are in every proof, or have a reason not to be\n", whole, all.size());
  EXPECT_EQ(whole, static_cast<int>(all.size()));
}

// The document says which passes have the first tier alone.
TEST(Proofs, TheDocumentNamesWhatHasNoSecondTier) {
  std::map<std::string, std::vector<bool>> have;  // of each name: its variants
  std::vector<std::string> order;
  std::map<std::string, std::string> variants;
  for (const BoundPass& pass : judged_passes()) {
    if (!pass.cases.front().model) continue;
    if (!have.contains(pass.pass)) order.push_back(pass.pass);
    have[pass.pass].push_back(has_second_tier(pass));
    if (!have[pass.pass].back()) variants[pass.pass] = pass.cases.front().c->corrected() ? "corrected " : "as-published ";
  }
  std::vector<std::string> alone;
  for (const std::string& name : order) {
    const std::vector<bool>& all = have.at(name);
    if (std::find(all.begin(), all.end(), false) == all.end()) continue;
    const bool is_some = std::find(all.begin(), all.end(), true) != all.end();
    alone.push_back(fmt::format("{}`{}`", is_some ? variants.at(name) : "", name));
  }
  EXPECT_THAT(contents(rainref::test::source_folder() + "/docs/conformance.md"),
              testing::HasSubstr(fmt::format("The first tier alone is there for {}.", fmt::join(alone, ", "))));
}

// Given again, an effect would be judged by other passes than those that the proofs go over.
TEST(Evaluations, OfAnEffectAreGivenOnce) {
  const std::size_t passes = registry::evaluations("puddle").size();
  EXPECT_EQ(error_of([] { registry::add_evaluations("puddle", {}); }), "5 'puddle' has its evaluations already");
  EXPECT_EQ(registry::evaluations("puddle").size(), passes);
}

// A pack whose scene is gone, or a pass that a pack's manifest does not have, would be in no proof without a word.
TEST(Proofs, EveryPackIsFoundWithItsPasses) {
  std::size_t folders = 0;
  for (const auto& entry : std::filesystem::directory_iterator(rainref::test::packs_folder())) folders += entry.is_directory();
  EXPECT_EQ(shipped_packs().size(), folders);
  for (const PackPasses& p : shipped_packs()) {
    const capture::Pack pack(pack_folder(p.name));
    EXPECT_EQ(pack.effect, p.effect) << p.name;
    EXPECT_EQ(pack.variant, p.variant) << p.name;
    std::vector<std::string> passes;
    for (const capture::PackPass& pass : pack.passes) passes.push_back(pass.name);
    EXPECT_THAT(p.passes, testing::UnorderedElementsAreArray(passes)) << p.name;
  }
}

}  // namespace
}  // namespace rainref::judge
