// Perturbed words: without a mistake they are the reference's; with one, what is done with upper bits says which it concerns.
#include "random/draws.h"

#include <array>

#include <gtest/gtest.h>

namespace rainref::random {
namespace {

constexpr std::array<std::uint32_t, 3> thresholds{1u << 30, 1u << 31, 3u << 30};
constexpr std::span<const std::uint32_t> all_thresholds(thresholds);

/// A class, a place with its fraction, a comparison with what is open, a share that holds, a count, and a counter's term.
struct Made {
  std::size_t index;
  float column, row, uniform;
  std::uint32_t whole;
  bool is_open, is_held;
  std::int32_t count;
  std::uint32_t term;
  bool operator==(const Made&) const = default;
};
template <class W>
Made made(std::uint32_t part = 0) {
  const auto r = W::block(9, Purpose::puddle_drop, 7, part);
  const std::uint32_t whole = ((r[0] >> 16) * 40u) >> 16;
  return {r[2] >> 22,
          static_cast<float>(((r[0] >> 16) * 40u) >> 8),
          static_cast<float>(((r[1] >> 16) * 30u) >> 8),
          W::uniform(r[3]),
          whole,
          !((r[3] >> 16) >= 40000u),
          (r[0] >> 16) < 30000u,
          W::count(r[1], 5, all_thresholds),
          W::counted_from(3, 8)};
}
Made made_with(const Draws& d, std::uint32_t part = 0) {
  const DrawsScope scope(d);
  return made<PerturbedWords>(part);
}

TEST(PerturbedWords, WithoutAMistakeAreTheReferences) {
  for (const std::uint32_t part : {0u, 1u, 2u, 3u}) EXPECT_EQ(made_with({}, part), made<Words>(part));
  const Block r = block(9, Purpose::puddle_drop, 7, 0);
  const Made right = made<Words>();
  EXPECT_EQ(right.index, r[2] / (1u << 22));
  EXPECT_EQ(right.column, static_cast<float>((r[0] / 65536 * 40) / 256));
  EXPECT_EQ(right.count, 5 + static_cast<std::int32_t>(r[1] / (1u << 30)));
  EXPECT_EQ(right.term, 5u);
}
TEST(PerturbedWords, AMistakeConcernsWhatItIsOf) {
  const Block r = block(9, Purpose::puddle_drop, 7, 0);
  const auto expect = [&](const auto& mistake, const auto& change) {
    Draws d;
    mistake(d);
    Made wrong = made<Words>();
    change(wrong);
    EXPECT_EQ(made_with(d), wrong);
  };
  expect([](Draws& d) { d.is_choice_of_low_bits = true; }, [&](Made& m) { m.index = r[2] % 1024; });
  expect([](Draws& d) { d.is_whole = {true, false}; }, [&](Made& m) { m.column = static_cast<float>(r[0] / 65536 * 40 / 65536 * 256); });
  expect([](Draws& d) { d.is_whole = {false, true}; }, [&](Made& m) { m.row = static_cast<float>(r[1] / 65536 * 30 / 65536 * 256); });
  expect([](Draws& d) { d.is_row_of_buffer = true; }, [](Made& m) { m.term = 8; });
  expect([](Draws& d) { d.counts_above = true; },
         [](Made& m) {
           m.is_held = !m.is_held;
           m.count = 5 + 3 - (m.count - 5);
         });
  expect([](Draws& d) { d.is_place_of_low_bits = true; },
         [&](Made& m) {
           const auto low = [&](std::size_t k) { return r[k] % 65536; };
           m.column = static_cast<float>(low(0) * 40 / 256);
           m.row = static_cast<float>(low(1) * 30 / 256);
           m.whole = low(0) * 40 / 65536;
           m.is_open = low(3) < 40000;
           m.uniform = uniform(r[3] << 8);
         });
}
TEST(PerturbedWords, OneDrawAloneCounts) {
  Draws d;
  d.counts_one_draw = true;
  EXPECT_EQ(made_with(d, 0), made<Words>(0));
  EXPECT_EQ(made_with(d, 1).count, 0);
}

}  // namespace
}  // namespace rainref::random
