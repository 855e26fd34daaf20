// Pass spawn: the drops that arrive in a step. Its arithmetic uses integers, hashed counters and table lookups (spawn.cpp). It is not
// written per record, because it determines the number of records. Other number types do not apply.
#pragma once

#include "drops/drops.h"
#include "drops/records.h"
#include "drops/uniforms.h"
#include "pass/definition.h"
#include "scene/uniform_block.h"

namespace rainref::drops {

constexpr std::size_t arrival_classes = 1024;  // the upper ten bits of a word

struct SpawnPass : pass::Takes<SpawnUniforms> {
  static constexpr pass::About about{"spawn", "New drops in free slots.", {1, capture::Judge::keyed}, {1, capture::Judge::keyed}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::seed>("1", scene::any_word, "Low and high word of the seed."),
                  member<&U::step>("1", scene::any_word, "Steps made before this one, modulo 2^32."),
                  member<&U::parts>("1", {0, 4096}, "Draws that add up to the count."),
                  member<&U::first_count>("1", {0, 1 << 26}, "Drops of a draw whose word is below every threshold."),
                  member<&U::threshold_count>("1", {0, 16000}, "Thresholds in the list; 0: each draw gives first_count."),
                  member<&U::first_id>("1", scene::any_word, "Id of the first arrival; the others follow."),
                  member<&U::room>("1", {0, DropArrays::most_slots}, "Free slots: arrivals beyond are lost."),
                  member<&U::life>("s", {0, 4096}, "Life of a new drop.")});
  }
  template <class B>
  struct Io {
    static constexpr std::string_view listed = "The live drops, in slot order.";
    typename B::template Changed<Drop> drops = {pass::In{.name = "drops", .previous = true},
                                                pass::Out{.name = "drops", .sentence = listed, .range = {-100, 100}, .record = "Drop"},
                                                pass::Out{.name = "drops", .sentence = listed, .range = {0, most_mass}, .record = "Drop"}};
    typename B::template Records<CountThreshold> count_thresholds =
        pass::In{.name = "count_thresholds", .variant = "corrected", .count = "threshold_count"};
    typename B::template Records<SpawnMass> spawn_masses = pass::In{.name = "spawn_masses", .records = arrival_classes};
  };
};

}  // namespace rainref::drops
