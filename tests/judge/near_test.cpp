// Only the records that a pass names near a block of texels count there: the others change no bit and no bound.
#include <bit>
#include <map>
#include <random>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "drops/info.h"
#include "drops/splat/scalar.h"
#include "judge/support.h"
#include "pass/model.h"
#include "rainy_glass/scalar.h"
#include "windshield/scalar.h"

namespace rainref::judge {
namespace {

using enclosed::Enclosure;

/// The bits of an evaluation; for an enclosure both bounds of each alternative, until there are too many.
template <class N, class Bound>
std::vector<std::uint64_t> bits_of(const Bound& pass, int x, int y) {
  std::vector<std::uint64_t> bits;
  std::vector<N> out(static_cast<std::size_t>(pass.values));
  const auto evaluate = [&] {
    pass(x, y, out.data());
    for (const N& n : out) {
      if constexpr (std::is_same_v<N, Enclosure>) {
        bits.push_back(std::bit_cast<std::uint32_t>(n.lo));
        bits.push_back(std::bit_cast<std::uint32_t>(n.hi));
      } else if constexpr (sizeof n.v == 8) {
        bits.push_back(std::bit_cast<std::uint64_t>(n.v));
      } else {
        bits.push_back(std::bit_cast<std::uint32_t>(n.v));
      }
    }
  };
  if constexpr (std::is_same_v<N, Enclosure>) {
    enclosed::PathEnumeration paths;
    bits.push_back(paths.for_each_alternative(evaluate));
  } else {
    evaluate();
  }
  return bits;
}

/// Returns the number of records that the blocks of this case leave out.
template <class P, class Text>
std::size_t expect_no_change(const capture::PassCase& c) {
  const pass::Bound<P, Text> chosen = pass::bound<P, Text>(c);
  pass::Bound<P, Text> all = chosen;
  std::size_t left_out = 0;
  pass::each<P>(all.captured, [&](auto& member) {
    if constexpr (requires { member.near; }) {
      for (const auto& some : member.near) left_out += member.records.size() - some.size();
      member.near.clear();
    }
  });
  if (left_out == 0) return 0;
  for (int y = 0; y < chosen.height; ++y)
    for (int x = y % 3; x < chosen.width; x += 3) {
      EXPECT_EQ((bits_of<scalar::Scalar<float>>(chosen, x, y)), (bits_of<scalar::Scalar<float>>(all, x, y))) << x << ' ' << y;
      EXPECT_EQ((bits_of<scalar::Scalar<double>>(chosen, x, y)), (bits_of<scalar::Scalar<double>>(all, x, y))) << x << ' ' << y;
      const std::vector<std::string> profiles = test::inexact_profiles();
      const std::string& name = profiles[static_cast<std::size_t>(x / 3 + y) % profiles.size()];
      const enclosed::ProfileScope scope(profile(name));
      EXPECT_EQ(bits_of<Enclosure>(chosen, x, y), bits_of<Enclosure>(all, x, y)) << name << ' ' << x << ' ' << y;
      if (testing::Test::HasFailure()) return left_out;
    }
  return left_out;
}

TEST(Near, WhatIsLeftOutChangesNoBitAndNoBound) {
  std::map<std::string, std::size_t> left_out;
  for (const test::PackPasses& p : test::shipped_packs()) {
    const capture::Pack pack(test::pack_folder(p.name));
    std::map<std::string, const capture::PackCase*> last;  // of each pass: it has the most records
    for (const capture::PackCase& entry : pack.cases) last[entry.pass] = &entry;
    for (const auto& [pass, entry] : last) {
      SCOPED_TRACE(p.name + " " + pass);
      const auto in = [&, name = pass, at = entry](auto expect) { left_out[name] += expect(pack.read(*at)); };
      if (pass == "splat") in(expect_no_change<drops::SplatPass, drops::scalar::SplatPassText>);
      if (pass == "falling_rain") in(expect_no_change<windshield::FallingRainPass, windshield::scalar::FallingRainPassText>);
      if (pass == "smear") in(expect_no_change<windshield::SmearPass, windshield::scalar::SmearPassText>);
      if (pass == "bake_raindrops") in(expect_no_change<rainy_glass::BakeRaindropsPass, rainy_glass::scalar::BakeRaindropsPassText>);
      if (pass == "bake_rivulets") in(expect_no_change<rainy_glass::BakeRivuletsPass, rainy_glass::scalar::BakeRivuletsPassText>);
    }
  }
  EXPECT_EQ(left_out.size(), 5u);
  for (const auto& [pass, count] : left_out) EXPECT_GT(count, 0u) << pass;
}

// ---- drops that may touch ------------------------------------------------------------------------------------------
TEST(Near, DropsThatMeetAreFoundWhateverTheirSizes) {
  constexpr float frame[3] = {1.4f, 0.2f, 0.9f};
  std::mt19937 words(5);
  const auto unit = [&] { return words() * 0x1p-32; };
  for (const int count : {0, 1, 2, 40, 400}) {
    for (const double largest : {0.0, 1e-3, 0.05, 3.0}) {
      std::vector<drops::Surroundings> all;
      for (int i = 0; i < count; ++i) {
        drops::Drop d{};
        // On the glass and beside it; some in one place.
        for (float& at : d.position) at = static_cast<float>(i % 7 == 0 ? 0.25 : 1.5 * unit() - 0.25);
        all.emplace_back(frame, d, largest * unit() * unit());
      }
      std::vector<std::pair<std::size_t, std::size_t>> expected;
      for (std::size_t a = 0; a < all.size(); ++a)
        for (std::size_t b = a + 1; b < all.size(); ++b)
          if (all[a].meets(all[b])) expected.emplace_back(a, b);
      EXPECT_EQ(drops::meeting_ones(all), expected) << count << ' ' << largest;
    }
  }
}
// A port's numbers are any finite ones.
TEST(Near, DropsFarAwayAreFoundToo) {
  constexpr float frame[3] = {1e4f, -1e4f, 1e4f};
  std::vector<drops::Surroundings> all;
  for (const float at : {3e38f, -3e38f, 3e38f, 0.0f, 1e-38f, 0.0f}) {
    drops::Drop d{};
    d.position[0] = at;
    all.emplace_back(frame, d, 0.0);
  }
  EXPECT_EQ(drops::meeting_ones(all), (std::vector<std::pair<std::size_t, std::size_t>>{{0, 2}}));
  EXPECT_TRUE(drops::meeting_ones({all[3], all[5]}).empty());
}

}  // namespace
}  // namespace rainref::judge
