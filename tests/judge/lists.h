// Cases of passes that give a list of records with ids, other drops for them, and random conforming devices on them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "drops/records.h"
#include "judge/keyed.h"
#include "judge/profiles.h"
#include "judge/support.h"
#include "pass/stored_record.h"

namespace rainref::judge::test {

inline capture::Array with_records(capture::Array like, const std::vector<std::byte>& bytes) {
  like.width = static_cast<int>(bytes.size() / like.element_bytes());
  like.levels = {bytes};
  return like;
}
inline std::vector<drops::Drop> drops_in(const capture::Array& list) {
  std::vector<drops::Drop> out(static_cast<std::size_t>(list.width));
  if (!out.empty()) std::memcpy(out.data(), list.levels[0].data(), list.levels[0].size());
  return out;
}

/// A case with its model; `list` is its keyed output, expected as the reference gives it.
struct ListCase {
  std::unique_ptr<capture::PassCase> c;
  std::unique_ptr<capture::PassModel> model;
  capture::CaseOutput list;
  const capture::KeyedModel* keyed = nullptr;

  explicit ListCase(capture::PassCase from) : c(std::make_unique<capture::PassCase>(std::move(from))) {
    model = bound(c->pass, binder(c->effect, c->pass), *c);
    for (const capture::CaseOutput& o : c->outputs)
      if (o.judge == capture::Judge::keyed) list = o;
    keyed = model->keyed(list.name);
    list.array = with_records(list.array, *keyed->reference());
  }
  KeyedJudgement judged(const std::vector<std::byte>& bytes, const std::string& under) const {
    return judge_keyed(list, with_records(list.array, bytes), keyed, profile(under));
  }
  /// What a device gives, the seed'th.
  std::vector<std::byte> conforming(const perturbed::Variations& variations, std::uint64_t seed) const {
    perturbed::Behaviour behaviour;
    behaviour.variations = &variations;
    behaviour.random = Words(seed)();
    behaviour.lean = static_cast<int>(seed % 3) - 1;
    const perturbed::Scope scope(behaviour);
    return *keyed->perturbed();
  }
};

inline float uniform(Words& words, float low, float high) { return low + (high - low) * static_cast<float>(words() >> 40) * 0x1p-24f; }

/// The same pass with other drops, `count` of them, every third with a neck, and other water on the glass, so that more borders are met.
inline capture::PassCase busy(capture::PassCase c, int count, std::uint64_t seed) {
  Words words(seed);
  for (capture::CaseInput& input : c.inputs) {
    if (input.name == "drops") {
      // The glass of screen_drops is a ninth as wide as the windshields of the packs. Of drops that merge most are two.
      const float heaviest = !c.corrected() ? 2.0f : c.effect == "screen_drops" ? 4e3f : 8e6f;
      std::vector<drops::Drop> all;
      for (int k = 0; k < count; ++k) {
        const float mass = uniform(words, 0.5f, heaviest);
        all.push_back({{uniform(words, 0, 1), uniform(words, 0, 1)},
                       {uniform(words, -0.5f, 0.5f), uniform(words, -0.5f, 0.5f)},
                       c.corrected() ? std::floor(mass * uniform(words, 0, 1)) + 1 : mass,
                       uniform(words, 0.001f, 3),
                       static_cast<std::uint32_t>(k * 3 + 1),
                       0});
      }
      input.array = with_records(input.array, pass::bytes_of(all));
    }
    if (input.name == "necks") {
      std::vector<drops::Neck> all;
      for (int k = 0; k < count; k += 3)
        all.push_back({{uniform(words, -1, 1), uniform(words, -1, 1)},
                       uniform(words, 0.05f, 0.5f),
                       uniform(words, 0, 1),
                       static_cast<std::uint32_t>(k * 3 + 1),
                       0,
                       0,
                       0});
      input.array = with_records(input.array, pass::bytes_of(all));
    }
    if (input.name == "film") {
      auto* texels = reinterpret_cast<float*>(input.array.levels[0].edit().data());
      for (int i = 0; i < input.array.width * input.array.height; ++i) texels[i] = std::floor(uniform(words, 0, 3e5f));
    }
  }
  return c;
}

}  // namespace rainref::judge::test
