// The passes themselves, rewritten: what an invocation computes is recorded as a tree, the tree is rewritten as a compiler may
// (math/rewriter.h), and a random GPU computes it. What it stores lies inside the rearrangements of the pass, which share nothing with this
// but the profile; and where the tree is left as it is, inside the formula as written.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "devices/defined_passes.h"
#include "judge/rewritten_passes.h"
#include "judge/support.h"
#include "math/recorded.h"

namespace rainref::judge {
namespace {

using enclosed::Enclosure;
using enclosed::ProfileScope;
using rainref::test::Recorded;
using test::one_holds;

/// The values outside, to the last digit, and how they were computed.
std::string explained(const Alternatives& all, const std::vector<float>& got, const std::vector<rainref::test::Tree>& trees) {
  std::string out;
  for (std::size_t v = 0; v < got.size(); ++v) {
    const Enclosure& e = all.values[0][v];
    if (!e.contains(got[v]))
      out += fmt::format("value {}: {:.9g} outside [{:.9g}, {:.9g}]: {:.2000}\n", v, got[v], e.lo, e.hi, text_of(trees[v]));
  }
  for (const float x : rainref::test::recorded_values()) out += fmt::format(" {:.9g}", x);
  return out;
}

/// Counts of a pass under a profile.
struct Tally {
  int checked = 0, outside_as_written = 0;
};

}  // namespace

bool is_rewritten(const capture::PassCase& c) {
  return devices::with_defined_pass(c, [](const auto&) {});
}

namespace {

/// RAINREF_INVOCATIONS sets how many of each case; scripts/full/honesty takes more.
void rewrite(const test::BoundCase& b, const std::string& pass_name, const enclosed::Profile& p, Tally& tally) {
  const std::int64_t invocations = test::count_from("RAINREF_INVOCATIONS", 12);
  devices::with_defined_pass(*b.c, [&](const auto& pass) {
    const std::int64_t texels = static_cast<std::int64_t>(pass.width) * pass.height;
    for (std::int64_t k = 0; k < invocations; ++k) {
      const std::int64_t at = k * 7919 % texels;
      const int x = static_cast<int>(at % pass.width), y = static_cast<int>(at / pass.width);
      rainref::test::recorded_values().clear();
      std::vector<Recorded> values(static_cast<std::size_t>(pass.values));
      pass(x, y, values.data());
      std::vector<float> reference;
      for (const Recorded& r : values) reference.push_back(r.v);
      // What is recorded is what the pass computes, lookups included.
      std::vector<scalar::Scalar<float>> plain_values(values.size());
      b.model->evaluate(x, y, plain_values.data());
      for (std::size_t v = 0; v < values.size(); ++v) ASSERT_EQ(reference[v], plain_values[v].v) << pass_name << " at " << x << ',' << y;
      Alternatives written, rearranged;
      written.run(*b.model, x, y, reference.data(), p);
      rearranged.rearrange(*b.model, x, y, reference.data(), p);
      if (written.gave_up || rearranged.gave_up) continue;
      const ProfileScope scope(p);
      for (int trial = 0; trial < 4; ++trial) {
        rainref::test::Run run(rainref::test::recorded_values());
        run.once = true;
        run.rewrites = 30;
        std::vector<float> got;
        std::vector<rainref::test::Tree> trees;
        for (const Recorded& r : values) {
          trees.push_back(rainref::test::rewritten_often(r.tree, run.rewrites));
          run.kept.push_back(trees.back());
          got.push_back(computed(trees.back(), run).v);
        }
        ++tally.checked;
        tally.outside_as_written += !one_holds(written, *b.model, got);
        ASSERT_TRUE(one_holds(rearranged, *b.model, got))
            << pass_name << " under " << p.name << " at " << x << ',' << y << ": " << testing::PrintToString(got) << ", reference "
            << testing::PrintToString(reference) << "\n"
            << explained(rearranged, got, trees);
      }
    }
  });
}

TEST(RewrittenPasses, LieInsideTheirRearrangements) {
  int rewritten_passes = 0, outside_as_written = 0;
  for (const test::BoundPass& pass : test::enveloped_passes())
    for (const char* name : {"vulkan", "d3d"}) {
      Tally tally;
      for (const test::BoundCase& b : pass.cases) {
        // What a pass rounds on its way is recorded to nearest.
        if (b.model->rounds_inside() && profile(name).half_store == enclosed::StoreRounding::rtz) continue;
        rewrite(b, pass.name(), profile(name), tally);
      }
      if (HasFatalFailure()) return;
      rewritten_passes += tally.checked > 0;
      outside_as_written += tally.outside_as_written;
      fmt::print("{:<36} {:<7} {:6} evaluations, {:5} outside the formula as written\n", pass.name(), name, tally.checked,
                 tally.outside_as_written);
    }
  EXPECT_GT(rewritten_passes, 40);
  EXPECT_GT(outside_as_written, 100) << "nothing is tested where rewriting changes nothing";
}

}  // namespace
}  // namespace rainref::judge
