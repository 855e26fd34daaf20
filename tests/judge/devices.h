// Random conforming devices on a case, and whether its envelopes hold what they store.
#pragma once

#include <atomic>
#include <bit>
#include <mutex>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "judge/invocation_judge.h"
#include "judge/support.h"
#include "math/path_enumeration.h"
#include "rainref/executor.h"

namespace rainref::judge::test {

using capture::Array;

struct Tally {
  std::atomic<std::int64_t> judged = 0, differing = 0, gave_up = 0, outside = 0;
  std::mutex mutex;
  std::string first;  // of what lay outside
};

inline std::string described(const BoundCase& b, int x, int y, const std::vector<Array>& stored, const std::vector<float>& values,
                             const enclosed::Profile& p) {
  std::string text = fmt::format("{} ({}, {}) under {}:", b.c->folder(), x, y, p.name);
  std::vector<float> port;
  for (const Slot& s : b.slots) port.push_back(stored_value(s, s.at(stored[static_cast<std::size_t>(s.output)], x, y)));
  const enclosed::ProfileScope scope(p);
  enclosed::PathEnumeration paths;
  paths.for_each_alternative([&] {
    std::vector<enclosed::Enclosure> e(values.size());
    b.model->enclose(x, y, port.data(), e.data());
    text += "\n alternative";
    for (std::size_t v = 0; v < e.size(); ++v)
      text += fmt::format("\n  {}: {:a} stored {:a} in [{:a}, {:a}]{}", v, values[v], port[v], e[v].lo, e[v].hi,
                          e[v].contains(values[v]) ? "" : " NO");
  });
  return text;
}

inline bool is_reference(const BoundCase& b, int x, int y, const std::vector<float>& values) {
  std::vector<scalar::Scalar<float>> reference(values.size());
  b.model->evaluate(x, y, reference.data());
  for (std::size_t v = 0; v < values.size(); ++v)
    if (reference[v].v != values[v]) return false;
  return true;
}
/// Whether one alternative holds every value before it is stored, or there are too many.
inline bool holds_values(const BoundCase& b, int x, int y, const std::vector<Array>& stored, const std::vector<float>& values,
                         const enclosed::Profile& p, Tally& tally) {
  std::vector<float> port;
  for (const Slot& s : b.slots) port.push_back(stored_value(s, s.at(stored[static_cast<std::size_t>(s.output)], x, y)));
  const enclosed::ProfileScope scope(p);
  enclosed::PathEnumeration paths;
  bool held = false;
  std::vector<enclosed::Enclosure> e(values.size());
  const bool whole = paths.for_each_alternative([&] {
    b.model->enclose(x, y, port.data(), e.data());
    bool all = true;
    for (std::size_t v = 0; v < e.size(); ++v) all &= b.model->is_free(static_cast<int>(v)) || e[v].contains(values[v]);
    held |= all;
  });
  tally.gave_up += !whole;
  return held || !whole;
}

/// Devices begin ... end - 1 on one case: what `of` allows, judged by `p`.
inline void judge_devices(const BoundCase& b, const enclosed::Profile& of, const enclosed::Profile& p, std::int64_t begin, std::int64_t end,
                          Tally& tally) {
  perturbed::Variations variations = perturbed::variations_of(of);
  std::vector<Array> stored = b.expected();
  const std::int64_t texels = static_cast<std::int64_t>(b.model->width()) * b.model->height();
  for (std::int64_t i = begin; i < end; ++i) {
    Words words(static_cast<std::uint64_t>(i) * 7 + 3);
    const std::int64_t texel = i * 37 % texels;
    const int x = static_cast<int>(texel % b.model->width()), y = static_cast<int>(texel / b.model->width());
    const HalfMode mode = drawn_mode(p, words);
    // A pass that rounds on its way does so as its device stores.
    if (of.half_store == p.half_store) {
      variations.rules.half_store = mode == HalfMode::rne   ? enclosed::StoreRounding::rne
                                    : mode == HalfMode::rtz ? enclosed::StoreRounding::rtz
                                                            : enclosed::StoreRounding::either;
    }
    const std::vector<float> values = conforming_values(*b.model, x, y, variations, words());
    for (std::size_t v = 0; v < values.size(); ++v) {
      const Slot& s = b.slots[v];
      Array& to = stored[static_cast<std::size_t>(s.output)];
      store_conforming(s, values[v], p, mode, words, to.levels[0].edit().data() + s.offset(x, y));
    }
    ++tally.judged;
    tally.differing += !is_reference(b, x, y, values);
    if (holds_values(b, x, y, stored, values, p, tally) &&
        InvocationJudge(*b.c, *b.model, p, mode).accepts(x, y, stored) == Accepted::as_written)
      continue;
    if (tally.outside++ == 0) {
      const std::lock_guard lock(tally.mutex);
      tally.first = described(b, x, y, stored, values, p);
    }
  }
}

/// Without variations a perturbed is the reference.
inline void expect_reference(const std::vector<BoundPass>& passes) {
  for (const BoundPass& pass : passes) {
    for (const BoundCase& b : pass.cases) {
      std::vector<scalar::Scalar<float>> reference(b.slots.size());
      std::vector<perturbed::Perturbed> perturbed(b.slots.size());
      int differing = 0;
      for (int y = 0; y < b.model->height(); ++y) {
        for (int x = 0; x < b.model->width(); ++x) {
          b.model->evaluate(x, y, reference.data());
          b.model->evaluate(x, y, perturbed.data());
          for (std::size_t v = 0; v < reference.size(); ++v)
            differing += std::bit_cast<std::uint32_t>(reference[v].v + 0.0f) != std::bit_cast<std::uint32_t>(perturbed[v].v + 0.0f);
        }
      }
      EXPECT_EQ(differing, 0) << b.c->folder();
    }
  }
}

/// RAINREF_EVALUATIONS devices of every profile for each pass: none outside.
inline void expect_honest(const std::vector<BoundPass>& passes) {
  const std::int64_t each = count_from("RAINREF_EVALUATIONS", 20000);
  const parallel::Executor executor;
  const std::vector<std::string> profiles = inexact_profiles();
  const char* only = std::getenv("RAINREF_ONLY");
  for (const BoundPass& pass : passes) {
    if (only && pass.name() != only) continue;
    for (const std::string& name : profiles) {
      Tally tally;
      const std::int64_t parts = static_cast<std::int64_t>(profiles.size() * pass.cases.size()), share = (each + parts - 1) / parts;
      for (const BoundCase& b : pass.cases)
        executor.for_range(
            share, 256, [&](std::int64_t begin, std::int64_t end) { judge_devices(b, profile(name), profile(name), begin, end, tally); });
      const auto percent = [&](std::int64_t part) { return 100.0 * static_cast<double>(part) / static_cast<double>(tally.judged); };
      fmt::print(
          "{:<26} {:<8} {:8} devices, {:5.1f} % differ from the reference, {:.3f} % have too many alternatives, {} "
          "outside\n",
          pass.name(), name, tally.judged.load(), percent(tally.differing), percent(tally.gave_up), tally.outside.load());
      EXPECT_EQ(tally.outside, 0) << pass.name() << ' ' << name << '\n' << tally.first;
      // Devices that differ nowhere prove nothing. Rounding on the way hides most of what floats differ by, masks even more.
      const bool hides = pass.cases.front().model->rounds_inside();
      if (pass.is_one_number(profile(name))) continue;
      EXPECT_GT(tally.differing, hides ? 0 : tally.judged / (pass.is_of_masks() ? 2000 : 200)) << pass.name() << ' ' << name;
    }
  }
}

/// What vulkan allows lies outside of cuda without a sampler, in every pass.
inline void expect_looser_outside(const std::vector<BoundPass>& passes) {
  enclosed::Profile narrow = profile("cuda");
  narrow.subtexel_bits = narrow.coordinate_bits = narrow.lod_bits = 0;
  for (const BoundPass& pass : passes) {
    Tally tally;
    if (pass.is_one_number(profile("vulkan"))) continue;
    // Halves that are stored on the way hide most: one device in thousands is seen there.
    const int batch = 500, most = 24'000;
    for (int begin = 0; begin < most && tally.outside <= 20; begin += batch)
      for (const BoundCase& b : pass.cases) judge_devices(b, profile("vulkan"), narrow, begin, begin + batch, tally);
    EXPECT_GT(tally.outside, 20) << pass.name();
  }
}

}  // namespace rainref::judge::test
