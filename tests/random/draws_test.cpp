// Perturbed words: without a mistake they are the reference's; with one, what is done with upper bits says which it concerns.
#include "random/draws.h"

#include <array>
#include <map>
#include <string>

#include <gtest/gtest.h>

namespace rainref::random {
namespace {

using Made = std::map<std::string, double>;
/// What passes make of words.
template <class W>
Made made(std::uint32_t part) {
  static constexpr std::array<std::uint32_t, 3> thresholds{1u << 30, 1u << 31, 3u << 30};
  const auto r = W::block(9, Purpose::puddle_drop, 7, part);
  const std::size_t index = [](std::size_t k) { return k; }(r[2] >> 22);
  const std::uint32_t texel = ((r[0] >> 16) * 40u) >> 16;
  return {{"class", static_cast<double>(index)},
          {"column", static_cast<float>(((r[0] >> 16) * 40u) >> 8)},
          {"row", static_cast<float>(((r[1] >> 16) * 30u) >> 8)},
          {"share", W::uniform(r[3])},
          {"texel", texel},
          {"closed", (r[3] >> 16) >= 40000u},
          {"held", (r[0] >> 16) < 30000u},
          {"count", W::count(r[1], 5, std::span<const std::uint32_t>(thresholds))},
          {"term", W::counted_from(3, 8)}};
}
Made made_with(const Draws& d, std::uint32_t part) {
  const DrawsScope scope(d);
  return made<PerturbedWords>(part);
}

TEST(PerturbedWords, WithoutAMistakeAreTheReferences) {
  for (const std::uint32_t part : {0u, 1u, 2u, 3u}) EXPECT_EQ(made_with({}, part), made<Words>(part));
  const Block r = block(9, Purpose::puddle_drop, 7, 0);
  const Made right = made<Words>(0);
  EXPECT_EQ(right.at("class"), r[2] / (1u << 22));
  EXPECT_EQ(right.at("column"), r[0] / 65536 * 40 / 256);
  EXPECT_EQ(right.at("count"), 5 + r[1] / (1u << 30));
}
TEST(PerturbedWords, AMistakeConcernsWhatItIsOf) {
  for (const std::uint32_t part : {0u, 1u}) {
    const Block r = block(9, Purpose::puddle_drop, 7, part);
    const auto low = [&](std::size_t k) { return r[k] % 65536; };
    const Made right = made<Words>(part);
    const auto expect = [&](auto Draws::*member, auto value, const Made& others) {
      Draws d;
      d.*member = value;
      Made wrong = right;
      for (const auto& other : others) wrong[other.first] = other.second;
      EXPECT_EQ(made_with(d, part), wrong);
    };
    using Axes = std::array<bool, 2>;
    expect(&Draws::is_choice_of_low_bits, true, {{"class", r[2] % 1024}});
    expect(&Draws::is_whole, Axes{true, false}, {{"column", r[0] / 65536 * 40 / 65536 * 256}});
    expect(&Draws::is_whole, Axes{false, true}, {{"row", r[1] / 65536 * 30 / 65536 * 256}});
    expect(&Draws::is_row_of_buffer, true, {{"term", 8}});
    expect(&Draws::counts_above, true, {{"held", 1 - right.at("held")}, {"count", 5 + 3 - (right.at("count") - 5)}});
    expect(&Draws::counts_one_draw, true, {{"count", part == 0 ? right.at("count") : 0}});
    expect(&Draws::is_place_of_low_bits, true,
           {{"column", low(0) * 40 / 256},
            {"row", low(1) * 30 / 256},
            {"texel", low(0) * 40 / 65536},
            {"closed", low(3) >= 40000},
            {"share", uniform(r[3] << 8)}});
  }
}

}  // namespace
}  // namespace rainref::random
