#include "faults/draw_faults.h"

#include <algorithm>
#include <cstring>
#include <cstdlib>

#include <fmt/format.h>

namespace rainref::faults {
namespace {

using random::Draws;

const char* const ordinals[] = {"first", "second", "third", "fourth"};

/// One word replaced by another, and two exchanged.
template <class Add>
void add_words(const Add& add) {
  for (std::uint8_t to = 0; to < 4; ++to)
    for (std::uint8_t from = 0; from < 4; ++from) {
      if (to == from) continue;
      Draws d;
      d.words[to] = from;
      add(d, fmt::format("random word {} for {}", from, to),
          fmt::format("of a block of random words the {} is taken where the {}, r[{}], is meant", ordinals[from], ordinals[to], to));
      if (from < to) continue;
      d.words[from] = to;
      add(d, fmt::format("random words {} and {} exchanged", to, from),
          fmt::format("of a block of random words r[{}] and r[{}] are taken for each other", to, from));
    }
}

/// Another constant, operator or operand in the hash itself: in pcg4d, or where key and counters are combined.
template <class Add>
void add_mixings(const Add& add) {
  using random::Join;
  using random::Mixing;
  const auto set = [&](const auto& change, std::string name, std::string sentence) {
    Draws d;
    d.mixing.emplace();
    change(*d.mixing);
    add(d, std::move(name), std::move(sentence));
  };
  const auto words = "xyzw";
  set([](Mixing& m) { m.keyed_by = Join::sum; }, "random key added",
      "the counters of a block of random words are added to the key, a + k0 and b + k1, where they should be combined by exclusive or");
  set([](Mixing& m) { m.keyed_by = Join::either; }, "random key by or",
      "the counters of a block of random words are combined with the key by or (|), where it should be exclusive or (^)");
  set([](Mixing& m) { m.keyed_by = Join::left_out; }, "random key left out of the counters",
      "the counters of a block of random words are not combined with the key's first two words: a and b in place of a ^ k0 and b ^ k1");
  for (const std::size_t k : {0u, 1u})
    set([k](Mixing& m) { m.is_keyed[k] = false; }, fmt::format("random key left out of the {} counter", ordinals[k]),
        fmt::format("the {} counter of a block of random words is not combined with the key: {} in place of {} ^ k{}", ordinals[k], "ab"[k],
                    "ab"[k], k));
  set([](Mixing& m) { m.is_key_hashed = false; }, "random key not hashed",
      "the key of a block of random words is (seed.x, seed.y, purpose, 0) itself, without the first pcg4d");
  for (std::uint8_t i = 0; i < 4; ++i)
    for (std::uint8_t j = 0; j < 4; ++j) {
      if (i == j) continue;
      set([i, j](Mixing& m) { m.key_words[i] = j; }, fmt::format("random key's word k{} for k{}", j, i),
          fmt::format("of the key of a block of random words k{} stands where k{} is meant", j, i));
      if (i > j) continue;
      set([i, j](Mixing& m) { std::swap(m.key_words[i], m.key_words[j]); }, fmt::format("random key's words k{} and k{} exchanged", i, j),
          fmt::format("of the key of a block of random words k{} and k{} stand in each other's place", i, j));
      if (j != 3 && i == 0 && j == 1) continue;  // the seed's words
      const char* const parts[] = {"the seed's low word", "the seed's high word", "the purpose", "0"};
      set([i, j](Mixing& m) { std::swap(m.seed_words[i], m.seed_words[j]); },
          fmt::format("random key made with {} and {} exchanged", parts[i], parts[j]),
          fmt::format("where the key of random words is made {} and {} stand in each other's place", parts[i], parts[j]));
    }
  set([](Mixing& m) { m.last = 1; }, "random key made with 1 for 0",
      "the last word that the key of random words is made of is 1, it should be 0");
  set([](Mixing& m) { m.increment = 0; }, "pcg4d without its increment",
      "in pcg4d the increment 1013904223 is left out of v 1664525 + 1013904223");
  set([](Mixing& m) { m.multiplier = 1; }, "pcg4d without its multiplier",
      "in pcg4d the factor 1664525 is left out of v 1664525 + 1013904223");
  set([](Mixing& m) { std::swap(m.multiplier, m.increment); }, "pcg4d with multiplier and increment exchanged",
      "in pcg4d the multiplier 1664525 and the increment 1013904223 are exchanged");
  for (const std::uint32_t other : {22695477u, 214013u, 1103515245u, 69069u, 747796405u})
    set([other](Mixing& m) { m.multiplier = other; }, fmt::format("pcg4d with the multiplier {}", other),
        fmt::format("the multiplier of pcg4d is {}, another generator's, it should be 1664525", other));
  for (const std::uint32_t other : {1u, 12345u, 2891336453u, 2531011u})
    set([other](Mixing& m) { m.increment = other; }, fmt::format("pcg4d with the increment {}", other),
        fmt::format("the increment of pcg4d is {}, another generator's, it should be 1013904223", other));
  for (int shift = 1; shift < 32; ++shift)
    if (shift != 16)
      set([shift](Mixing& m) { m.shift = shift; }, fmt::format("pcg4d with a shift of {}", shift),
          fmt::format("in pcg4d the shift of v ^= v >> 16 is {}", shift));
  set([](Mixing& m) { m.is_shift_left = true; }, "pcg4d with a shift to the left", "in pcg4d stands v ^= v << 16 in place of v ^= v >> 16");
  set([](Mixing& m) { m.fold = Join::left_out; }, "pcg4d without its shift", "in pcg4d v ^= v >> 16 is left out");
  set([](Mixing& m) { m.fold = Join::sum; }, "pcg4d with + for ^", "in pcg4d stands v += v >> 16 in place of v ^= v >> 16");
  set([](Mixing& m) { m.fold = Join::either; }, "pcg4d with | for ^", "in pcg4d stands v |= v >> 16 in place of v ^= v >> 16");
  set([](Mixing& m) { m.stir = Join::exclusive_or; }, "pcg4d with ^ for +",
      "in pcg4d's stir the products are combined by exclusive or, x ^= y w, where they should be added");
  for (const std::size_t k : {0u, 1u})
    set([k](Mixing& m) { m.stirs[k] = false; }, fmt::format("pcg4d without its {} stir", ordinals[k]),
        fmt::format("in pcg4d the {} of the two stirs, x += y w and what follows, is left out", ordinals[k]));
  set([](Mixing& m) { m.is_stirred_at_once = true; }, "pcg4d stirred at once",
      "in pcg4d the four lines of a stir, x += y w and what follows, are made at once from the old values, where each should take what the "
      "lines before it gave");
  const Mixing right;
  for (std::uint8_t k = 0; k < 4; ++k) {
    const auto line = [&](std::uint8_t a, std::uint8_t b) { return fmt::format("{} += {} {}", words[k], words[a], words[b]); };
    const std::string meant = line(right.factors[k][0], right.factors[k][1]);
    set([k](Mixing& m) { m.line_left_out = k; }, fmt::format("pcg4d without {}", meant),
        fmt::format("in pcg4d's stir {} is left out", meant));
    for (std::uint8_t a = 0; a < 4; ++a)
      for (std::uint8_t b = a; b < 4; ++b) {
        const auto& [first, second] = right.factors[k];
        if ((a == first && b == second) || (a == second && b == first)) continue;
        set(
            [k, a, b](Mixing& m) {
              m.factors[k] = {a, b};
            },
            fmt::format("pcg4d with {} for {}", line(a, b), meant),
            fmt::format("in pcg4d's stir stands {} in place of {}", line(a, b), meant));
      }
  }
}

/// Other bits of a word than its upper ones.
template <class Add>
void add_bits(const Add& add) {
  for (const int from : {1, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 21}) {
    Draws d;
    d.choice_shift = from;
    add(d, fmt::format("class from the bits from {} on", from),
        fmt::format(
            "what is chosen from a table is chosen by the bits of its random word from {0} on, (word >> {0}) & 1023, in place of the "
            "highest ones",
            from));
  }
  for (const std::uint8_t bits : {8, 10, 12, 16, 20, 22, 24})
    for (std::size_t k = 0; k < 4; ++k) {
      Draws d;
      d.turned[k] = bits;
      add(d, fmt::format("random word {} by its low {} bits", k, bits),
          fmt::format(
              "of the random word r[{0}] the low bits are taken, r[{0}] & (2^{1} - 1) or r[{0}] mod 2^{1}, in place of the high ones, "
              "r[{0}] >> {2}",
              k, bits, 32 - bits));
    }
}

}  // namespace

void add_draw_faults(std::vector<Fault>& out, const std::vector<random::Purpose>& drawn) {
  std::vector<random::Purpose> purposes{random::Purpose{}};
  if (drawn.size() > 1) purposes.insert(purposes.end(), drawn.begin(), drawn.end());

  const auto add = [&](const Draws& draws, std::string name, std::string sentence) {
    Fault d;
    d.name = std::move(name);
    d.sentence = std::move(sentence);
    d.draws = draws;
    d.for_diagnosis = true;
    out.push_back(std::move(d));
  };
  const auto set_in = [&](random::Purpose only, auto Draws::*member, auto value, const std::string& name, const std::string& sentence) {
    const std::string which = only == random::Purpose{} ? "" : fmt::format(" of purpose {}", static_cast<std::uint32_t>(only));
    Draws d;
    d.only = only;
    d.*member = value;
    add(d, name + which, sentence + (which.empty() ? "" : ", in the blocks" + which));
  };
  const auto set = [&](auto Draws::*member, auto value, const std::string& name, const std::string& sentence) {
    set_in(random::Purpose{}, member, value, name, sentence);
  };
  for (const random::Purpose only : purposes) {
    const auto set_counter = [&](auto Draws::*member, auto value, std::size_t k, std::string_view what, std::string_view is) {
      auto both = Draws().*member;
      both[k] = value;
      set_in(only, member, both, fmt::format("random {} counter {}", ordinals[k], what),
             fmt::format("the {} counter of a block of random words{}", ordinals[k], is));
    };
    set_in(only, &Draws::are_counters_swapped, true, "random counters exchanged",
           "the two counters of a block of random words, as the step and the number of a record, are exchanged");
    for (const int by : {1, -1})
      for (const std::size_t k : {0u, 1u}) {
        const char* const more = by > 0 ? "more" : "less";
        set_counter(&Draws::counters_off, by, k, fmt::format("one {}", more),
                    fmt::format("{} is one {} than it should be", k == 0 ? "" : ", as the number of a record,", more));
      }
    for (const std::uint32_t stride : {2u, 3u, 4u, 8u, 16u})
      for (const std::size_t k : {0u, 1u})
        set_counter(&Draws::strides, stride, k, fmt::format("without its factor {}", stride),
                    fmt::format(" is a sum whose first term lacks its factor {}", stride));
    for (const std::uint32_t stride : {2u, 3u, 4u, 8u, 16u})
      for (const std::size_t k : {0u, 1u})
        set_counter(&Draws::moved, stride, k, fmt::format("with its factor {} at the other term", stride),
                    fmt::format(" is a + {0} b where it should be {0} a + b", stride));
    for (const std::size_t k : {0u, 1u}) set_counter(&Draws::is_counter_0, true, k, "left out", " is 0");
    // The purpose of another block of the pass.
    for (const random::Purpose other : drawn)
      if (only != random::Purpose{} && other != only && std::abs(static_cast<int>(other) - static_cast<int>(only)) > 1)
        set_in(only, &Draws::purpose_off, static_cast<int>(other) - static_cast<int>(only),
               fmt::format("random purpose {}", static_cast<int>(other)),
               fmt::format("the number of what random words are for is {}, that of others", static_cast<int>(other)));
    set_in(only, &Draws::are_seeds_swapped, true, "random seed's words exchanged", "the low and the high word of the seed are exchanged");
    set_in(only, &Draws::purpose_off, 1, "random purpose one more", "the number of what random words are for is one too large");
    set_in(only, &Draws::purpose_off, -1, "random purpose one less", "the number of what random words are for is one too small");
  }
  for (const int bits : {8, 10, 12, 15, 16, 20, 23})
    set(&Draws::place_bits, bits, fmt::format("place of {} bits", bits),
        fmt::format("a place is made of the upper {0} bits of its random word alone, over 2^{0}, in place of more of them", bits));
  set(&Draws::is_place_of_low_bits, true, "place from low bits", "a place takes the low bits of its random word in place of the high ones");
  set(&Draws::is_row_of_buffer, true, "random counter of the buffer's row",
      "a counter of a block of random words is made of the row of the buffer, where it should be the row within the layer: its first row "
      "is not subtracted");
  set(&Draws::are_halves_swapped, true, "random counter's halves exchanged",
      "the two halves of the first counter of a block of random words, as a cell's column and row, stand in each other's place");
  using Axes = std::array<bool, 2>;
  set(&Draws::is_whole, Axes{true, true}, "place without its fraction", "a place is cut to whole texels");
  set(&Draws::is_whole, Axes{true, false}, "column without its fraction", "the column of a place is cut to whole texels");
  set(&Draws::is_whole, Axes{false, true}, "row without its fraction", "the row of a place is cut to whole texels");
  set(&Draws::is_choice_of_low_bits, true, "class from low bits",
      "what is chosen from a table is chosen by the low bits of its random word in place of the high ones");
  set(&Draws::counts_above, true, "thresholds counted the other way",
      "the thresholds above the random word are counted, in place of those that it is not below");
  set(&Draws::counts_one_draw, true, "one draw alone", "of several draws that add up the first alone counts");
  add_words(add);
  add_bits(add);
  add_mixings(add);
}

void add_counter_faults(std::vector<Fault>& out, const capture::PackPass& pass, const capture::PassCase& c) {
  for (const scene::Member& m : pass.block.members) {
    if (m.scalar == scene::Scalar::float32 || m.components != 1 || m.name.starts_with("padding")) continue;
    std::int32_t number;
    std::memcpy(&number, c.uniforms.data() + m.offset, 4);
    // +1 and -1 have plainer names.
    if (number == 0 || number == 1 || number == -1) continue;
    for (const std::size_t k : {0u, 1u})
      for (const bool is_added : {false, true}) {
        Fault d;
        d.name = fmt::format("random {} counter {} {}", ordinals[k], is_added ? "with" : "without", m.name);
        d.sentence = fmt::format("the {} counter of a block of random words {} {}", ordinals[k],
                                 is_added ? "has, added to it," : "lacks its term", m.name);
        d.draws.emplace().counters_off[k] = is_added ? number : static_cast<std::int32_t>(0u - static_cast<std::uint32_t>(number));
        d.for_diagnosis = true;
        out.push_back(std::move(d));
      }
  }
}

std::vector<random::Purpose> purposes_drawn(const std::function<void()>& run) {
  std::vector<random::Purpose> met;
  random::Draws watching;
  watching.met = &met;
  const random::DrawsScope scope(watching);
  run();
  std::sort(met.begin(), met.end());
  met.erase(std::unique(met.begin(), met.end()), met.end());
  return met;
}

}  // namespace rainref::faults
