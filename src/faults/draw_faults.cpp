#include "faults/draw_faults.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>

#include <fmt/format.h>

namespace rainref::faults {
namespace {

using random::Draws;

const char* const ordinals[] = {"first", "second", "third", "fourth"};

/// Another word in the place of one, and two exchanged.
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
  const auto set = [&](auto Draws::*member, auto value, const char* name, const char* sentence) {
    Draws d;
    d.*member = value;
    add(d, name, sentence);
  };
  for (const random::Purpose only : purposes) {
    const std::string which = only == random::Purpose{} ? "" : fmt::format(" of purpose {}", static_cast<std::uint32_t>(only));
    const auto set_in = [&](auto Draws::*member, auto value, const char* name, const char* sentence) {
      Draws d;
      d.only = only;
      d.*member = value;
      add(d, name + which, fmt::format("{}{}", sentence, which.empty() ? "" : fmt::format(", in the blocks{}", which)));
    };
    using Off = std::array<std::int32_t, 2>;
    set_in(&Draws::are_counters_swapped, true, "random counters exchanged",
           "the two counters of a block of random words, as the step and the number of a record, are exchanged");
    for (const int by : {1, -1}) {
      const char* const more = by > 0 ? "more" : "less";
      set_in(&Draws::counters_off, Off{by, 0}, by > 0 ? "random first counter one more" : "random first counter one less",
             fmt::format("the first counter of a block of random words is one {} than it should be", more).c_str());
      set_in(&Draws::counters_off, Off{0, by}, by > 0 ? "random second counter one more" : "random second counter one less",
             fmt::format("the second counter of a block of random words, as the number of a record, is one {} than it should be", more)
                 .c_str());
    }
    using Strides = std::array<std::uint32_t, 2>;
    for (const std::uint32_t stride : {2u, 3u, 4u, 8u, 16u})
      for (const bool is_first : {true, false}) {
        const char* const counter = is_first ? "first" : "second";
        set_in(&Draws::strides, is_first ? Strides{stride, 1} : Strides{1, stride},
               fmt::format("random {} counter without its factor {}", counter, stride).c_str(),
               fmt::format("the {} counter of a block of random words is a sum whose first term lacks its factor {}", counter, stride)
                   .c_str());
      }
    for (const std::uint32_t stride : {2u, 3u, 4u, 8u, 16u})
      for (const bool is_first : {true, false}) {
        const char* const counter = is_first ? "first" : "second";
        set_in(
            &Draws::moved, is_first ? Strides{stride, 1} : Strides{1, stride},
            fmt::format("random {} counter with its factor {} at the other term", counter, stride).c_str(),
            fmt::format("the {0} counter of a block of random words is a + {1} b where it should be {1} a + b", counter, stride).c_str());
      }
    using Zero = std::array<bool, 2>;
    set_in(&Draws::is_counter_0, Zero{true, false}, "random first counter left out", "the first counter of a block of random words is 0");
    set_in(&Draws::is_counter_0, Zero{false, true}, "random second counter left out", "the second counter of a block of random words is 0");
    // The purpose of another block of the pass.
    for (const random::Purpose other : drawn)
      if (only != random::Purpose{} && other != only && std::abs(static_cast<int>(other) - static_cast<int>(only)) > 1)
        set_in(&Draws::purpose_off, static_cast<int>(other) - static_cast<int>(only),
               fmt::format("random purpose {}", static_cast<int>(other)).c_str(),
               fmt::format("the number of what random words are for is {}, that of others", static_cast<int>(other)).c_str());
    set_in(&Draws::are_seeds_swapped, true, "random seed's words exchanged", "the low and the high word of the seed are exchanged");
    set_in(&Draws::purpose_off, 1, "random purpose one more", "the number of what random words are for is one too large");
    set_in(&Draws::purpose_off, -1, "random purpose one less", "the number of what random words are for is one too small");
  }
  for (const int bits : {8, 10, 12, 15, 16, 20, 23})
    set(&Draws::place_bits, bits, fmt::format("place of {} bits", bits).c_str(),
        fmt::format("a place is made of the upper {0} bits of its random word alone, over 2^{0}, in place of more of them", bits).c_str());
  set(&Draws::is_place_of_low_bits, true, "place from low bits", "a place takes the low bits of its random word in place of the high ones");
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
