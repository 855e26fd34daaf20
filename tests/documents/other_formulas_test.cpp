// What an engineer writes instead, where real arithmetic makes no difference: it passes, or the report names it, and says of no other
// mistake that it is likely.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/support.h"
#include "documents/judged_written.h"
#include "faults/diagnose.h"
#include "judge/rearranging.h"
#include "shipped_packs.h"

namespace rainref::documents {
namespace {

/// Fails where the pass fails without being told that it has another formula. Whether it fails.
bool is_named(const PortJudgement& j, const std::string& pass, const std::string& formula) {
  const PassJudgement p = pass_of(j, pass);
  EXPECT_TRUE(p.status == Status::pass || p.status == Status::warn || p.status == Status::fail) << name(p.status) << ' ' << p.reason;
  if (p.status != Status::fail) return false;
  if (p.causes.empty()) {
    ADD_FAILURE() << j.profile << ", " << pass << ": no cause, " << p.reason;
    return true;
  }
  EXPECT_EQ(p.causes.front().name, "another formula: " + formula) << j.profile << ", " << pass << ", likely " << p.causes.front().is_likely;
  return true;
}

/// How many ports of a pass with another formula of its angles fail, each with the formula's name, under vulkan and cuda.
int named(const Pack& pack, const std::string& pass, std::initializer_list<Arc> formulas) {
  int failing = 0;
  for (const Arc formula : formulas) {
    for (const char* profile : {"vulkan", "cuda"}) {
      arc_formula = formula;
      const PortJudgement j = judged(pack, without_mistake, profile, {pass}, faults::diagnose);
      arc_formula = Arc::tangent;
      failing += is_named(j, pass, "asin or acos for atan2");
    }
  }
  return failing;
}

// The small packs have panoramas of a few texels, on which no formula shows. One of 1024 columns shows the polynomial.
TEST(OtherFormulas, OfTheAngleOfADirection) {
  for (const auto& [folder, pass] : {std::pair{"puddle-corrected", "shade"}, {"rainy_glass-as-published", "rain_on_glass"}})
    named(Pack(small_packs / folder), pass, {Arc::sine, Arc::cosine});
  const TemporaryFolder folder;
  cli::Circumstances c;
  c.is_copy = true;
  const std::string scene = rainref::test::source_folder() + "/scenes/puddle/as_published.toml";
  const cli::Outcome packed =
      cli::run_rainref(folder.path(), {"pack", scene, "--size", "48x27", "--at", "11", "--passes", "shade", "-o", "pack"}, c);
  ASSERT_EQ(packed.code, 0) << packed.err;
  const Pack pack(folder / "pack");
  EXPECT_EQ(named(pack, "shade", {Arc::tangent}), 0);
  EXPECT_GT(named(pack, "shade", {Arc::sine, Arc::polynomial}), 0) << "nothing was to be named";
}

// The plane of a difference by a difference of planes: what compilers may make of it, and no more than that.
TEST(OtherFormulas, OfTheWayFromOneDropToAnother) {
  std::vector<std::string> packs, differing;  // of a pack of few outlines, all may round alike both ways
  for (const rainref::test::PackPasses& p : rainref::test::proven_packs()) {
    if (!p.has("necks")) continue;
    packs.push_back(p.name);
    const Pack pack(small_packs / p.name);
    const auto status = [&](const char* mistake, const char* profile) {
      const PortJudgement j = judged(pack, [&](const Written&) { return mistake; }, profile, {"necks"});
      return pass_of(j, "necks").status;
    };
    const bool is_seen = status("planes subtracted", "cuda") == Status::fail;  // CUDA lets no compiler do so
    if (is_seen) differing.push_back(p.name);
    for (const std::string& profile : judge::test::rearranging_profiles()) {
      EXPECT_EQ(status("planes subtracted", profile.c_str()), is_seen ? Status::warn : Status::pass) << p.name << ' ' << profile;
      EXPECT_EQ(status("a ten-thousandth too far", profile.c_str()), Status::fail) << p.name << ' ' << profile;
    }
  }
  EXPECT_THAT(packs, testing::ElementsAre("screen_drops-storm", "windshield-neck"));
  EXPECT_THAT(differing, testing::Contains("windshield-neck"));
}

/// A blade's ends in the plane from its other members.
struct Ends {
  Float2 a, b;
};
Ends from_places(const Run& r, Float2 inner, Float2 outer, int width, int height) {
  const auto place = [&](Float2 uv) { return plane(r, {uv.x * static_cast<float>(width), uv.y * static_cast<float>(height)}); };
  return {place(inner), place(outer)};
}
float other_coverage(const Run& r, int x, int y) {
  const capture::Array& height = r.input("height").array;
  const Float2 p = plane(r, {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
  float most = 0;
  for (const Wiper& w : wipers_of(r)) {
    float distance;
    if (!r.taken().corrected()) {
      distance = segment(p, w.pivot + w.outer_radius * w.axis, w.pivot + w.inner_radius * w.axis);
    } else {
      const Ends before = from_places(r, w.previous_inner, w.previous_outer, height.width, height.height),
                 now = from_places(r, w.inner, w.outer, height.width, height.height);
      const Float2 away = p - w.pivot;
      const float size = length(away), sigma = w.direction < 0 ? -1.0f : 1.0f;
      const float beside = std::max({sigma * cross(away, w.previous_axis), sigma * cross(w.axis, away), 0.0f});
      const float behind = std::max(-dot(away, w.previous_axis + w.axis), 0.0f);
      const float sector = std::max({w.inner_radius - size, size - w.outer_radius, 0.0f}) + 2 * (beside + behind);
      distance = std::min({segment(p, before.a, before.b), segment(p, now.a, now.b), sector});
    }
    most = std::max(most, saturate(0.5f + (w.half_width - distance) / r.u("edge_width")));
  }
  return most;
}
/// wipe_texture with these ends, in either variant.
bool wipe_texture_from_other_ends(const Run& r, int x, int y, float* out) {
  const float covered = other_coverage(r, x, y);
  if (!r.taken().corrected()) {
    out[0] = std::max(r.at("height", x, y) - r.u("strength") * covered, 0.0f);
    out[1] = std::max(r.at("mask", x, y) * r.u("keep"), covered);
    return true;
  }
  const float wiped = std::min(r.at("wiped", x, y) + r.u("dt"), r.u("wiped_limit")) * (1 - covered);
  out[0] = r.at("height", x, y) * (1 - covered);
  out[1] = exponential(-(wiped * r.u("inverse_tau")));
  out[2] = wiped;
  return true;
}

TEST(OtherFormulas, OfABladesEnds) {
  int failing = 0;
  for (const char* folder : {"windshield-as-published", "windshield-corrected"}) {
    const Pack pack{small_packs / folder};
    Written w = *written(folder, "wipe_texture");
    w.loop = wipe_texture_from_other_ends;
    for (const char* profile : {"vulkan", "cuda"}) {
      const TemporaryFolder port;
      for (const PackCase& entry : pack.cases) {
        if (entry.pass != "wipe_texture") continue;
        const PassCase c = pack.read(entry);
        const std::vector<capture::Array> arrays = given(w, pack, c, "");
        for (std::size_t o = 0; o < arrays.size(); ++o) put_array(port / c.folder(), "out." + c.outputs[o].name, arrays[o]);
      }
      ValidateOptions options;
      options.profile = profile;
      options.only = {"wipe_texture"};
      options.executor = &test_executor();
      options.explain = faults::diagnose;
      failing += is_named(validate(pack, port.path(), options), "wipe_texture", "the blades' ends from the other members of their records");
    }
  }
  EXPECT_GT(failing, 0) << "nothing was to be named";
}

}  // namespace
}  // namespace rainref::documents
