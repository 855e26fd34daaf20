// Lists of records with ids are judged honestly, not loosely, and whole, in every pass that gives one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include <fmt/format.h>

#include "judge/keyed_fields.h"
#include "judge/lists.h"
#include "math/path_enumeration.h"

namespace rainref::judge {
namespace {

using namespace test;
using capture::KeyedRecord;

/// The cases of a pass, and `busy_cases` like each of them with other drops, where it takes drops.
std::vector<ListCase> list_cases(const BoundPass& pass, int busy_cases) {
  std::vector<ListCase> out;
  for (const BoundCase& b : pass.cases) {
    for (int k = 0; k < busy_cases && b.c->input("drops"); ++k) out.emplace_back(busy(*b.c, 400, static_cast<std::uint64_t>(k + 1)));
    out.emplace_back(*b.c);
  }
  return out;
}

TEST(Lists, TheReferenceIsThePacksAndAPerturbedWithoutVariations) {
  for (const BoundPass& pass : list_passes()) {
    for (const BoundCase& b : pass.cases) {
      const ListCase l(*b.c);
      EXPECT_TRUE(same_records(l.list.array, b.list()->array)) << l.c->folder();
      EXPECT_EQ(*l.keyed->perturbed(), *l.keyed->reference()) << l.c->folder();
      EXPECT_EQ(l.judged(b.list()->array.levels[0], "ieee").failing, 0) << l.c->folder();
    }
  }
}
// Whole numbers: there is nothing that a device may do otherwise.
TEST(Lists, ThoseWithoutAModelAreThePacksBits) {
  int lists = 0;
  for (const BoundPass& pass : judged_passes()) {
    for (const BoundCase& b : pass.cases) {
      if (b.model) continue;
      const std::vector<capture::Array> again = evaluations_of(b.c->effect, pass.pass)->recompute(*b.c);
      ASSERT_EQ(again.size(), b.c->outputs.size());
      for (std::size_t o = 0; o < again.size(); ++o) {
        const capture::Array& expected = b.c->outputs[o].array;
        EXPECT_TRUE(has_key(expected.record) ? same_records(again[o], expected) : again[o].levels == expected.levels) << b.c->folder();
      }
      ++lists;
    }
  }
  EXPECT_GT(lists, 6);
}

// RAINREF_EVALUATIONS sets how many devices are drawn for each pass, as in honesty_test.cpp.
TEST(Lists, NoConformingDeviceIsOutside) {
  const std::int64_t each = std::max<std::int64_t>(1, count_from("RAINREF_EVALUATIONS", 12000) / 3000);
  for (const BoundPass& pass : list_passes()) {
    const std::vector<ListCase> cases = list_cases(pass, 2);
    for (const std::string& name : inexact_profiles()) {
      const perturbed::Variations variations = perturbed::variations_of(profile(name));
      std::int64_t lists = 0, differing = 0, groups = 0, ambiguous = 0, other = 0, gave_up = 0;
      for (const ListCase& l : cases) {
        for (std::int64_t k = 0; k < each; ++k, ++lists) {
          const KeyedJudgement j = l.judged(l.conforming(variations, static_cast<std::uint64_t>(k + 1)), name);
          ASSERT_EQ(j.failing, 0) << pass.name() << ' ' << l.c->folder() << ' ' << name << ' ' << k << ": " << j.events.text();
          differing += j.output.differing > 0;
          groups += j.groups;
          ambiguous += j.ambiguous;
          other += j.other_branch;
          gave_up += j.gave_up;
        }
      }
      fmt::print("{:<40} {:<8} {:5} lists, {:5} differ, {:7} groups, {:5} ambiguous, {:4} another branch, {:3} given up\n", pass.name(),
                 name, lists, differing, groups, ambiguous, other, gave_up);
      // The published frame is a dozen operations, of which few are inexact.
      EXPECT_GT(differing, pass.pass == "windshield_frame" ? lists / 50 : lists / 2) << pass.name() << ' ' << name;
      EXPECT_LE(gave_up * 1000, groups) << pass.name() << ' ' << name;
    }
  }
}

// The proof can fail: what vulkan allows lies outside of a profile that rounds to nearest.
TEST(Lists, DevicesOfALooserProfileAreOutside) {
  const perturbed::Variations variations = perturbed::variations_of(profile("vulkan"));
  for (const BoundPass& pass : list_passes()) {
    int outside = 0;
    for (const ListCase& l : list_cases(pass, 1))
      for (std::uint64_t k = 1; k < 5; ++k) outside += l.judged(l.conforming(variations, k), "cuda").failing > 0;
    EXPECT_GT(outside, 0) << pass.name();
  }
}

/// Whether some rearrangement of a group gives what the list has of it, or there are too many.
bool is_held_rearranged(const ListCase& l, int group, const RecordTable& have, const RecordLayout& layout) {
  enclosed::PathEnumeration paths;
  bool held = false;
  const bool whole = paths.for_each_alternative([&] {
    std::vector<KeyedRecord> records;
    l.keyed->rearrange(group, records);
    held |= std::all_of(records.begin(), records.end(), [&](const KeyedRecord& r) {
      const auto found = have.find(r.id);
      if ((found != have.end()) != r.lives) return false;
      for (std::size_t f = 0; r.lives && f < r.floats.size(); ++f) {
        float x;
        std::memcpy(&x, found->second + layout.floats[f], sizeof x);
        if (!r.floats[f].contains(x)) return false;
      }
      return true;
    });
  });
  return held || !whole;
}
// As of images in rearranged_test.cpp: the second tier holds the first. tiers_test.cpp says which passes have one.
TEST(Lists, TheSecondTierHoldsTheFirst) {
  int passes = 0;
  for (const BoundPass& pass : list_passes()) {
    if (!has_second_tier(pass)) continue;
    ++passes;
    for (const ListCase& l : list_cases(pass, 1)) {
      const RecordLayout layout = record_layout(l.list.array.record);
      for (const char* name : {"vulkan", "d3d"}) {
        const perturbed::Variations variations = perturbed::variations_of(profile(name));
        for (std::uint64_t k = 1; k < 4; ++k) {
          const capture::Array list = with_records(l.list.array, l.conforming(variations, k));
          std::vector<std::uint32_t> duplicate;
          const RecordTable have = table_of(list, layout, duplicate);
          const enclosed::ProfileScope scope(profile(name));
          for (int group = 0; group < l.keyed->groups(); ++group)
            EXPECT_TRUE(is_held_rearranged(l, group, have, layout)) << pass.name() << ' ' << l.c->folder() << ' ' << name << ' ' << group;
        }
      }
    }
  }
  EXPECT_GT(passes, 5);
}

/// Widths of a list's envelopes, of the floats that are not points: over the spread of 128 devices, over the largest
/// magnitude that the field has, and in ULP.
struct Widths {
  std::vector<double> over_spread, over_field, ulp;
};
Widths widths_of(const ListCase& l, const std::string& under) {
  const enclosed::Profile& p = profile(under);
  const perturbed::Variations variations = perturbed::variations_of(p);
  const std::size_t size = l.list.array.element_bytes();
  std::size_t id_at = 0;
  std::vector<std::size_t> floats_at;
  for (const scene::Member& m : l.list.array.record.members) {
    if (m.name == "id")
      id_at = m.offset;
    else if (m.scalar == scene::Scalar::float32 && !m.name.starts_with("padding"))
      for (int k = 0; k < m.components; ++k) floats_at.push_back(m.offset + 4 * static_cast<std::size_t>(k));
  }
  using Fields = std::map<std::uint32_t, std::vector<float>>;
  const auto fields_of = [&](const std::vector<std::byte>& bytes) {
    Fields out;
    for (std::size_t at = 0; at < bytes.size(); at += size) {
      std::uint32_t id;
      std::memcpy(&id, &bytes[at + id_at], 4);
      for (const std::size_t f : floats_at) {
        float x;
        std::memcpy(&x, &bytes[at + f], 4);
        out[id].push_back(x);
      }
    }
    return out;
  };
  const Fields reference = fields_of(*l.keyed->reference());
  std::vector<double> largest(floats_at.size());
  for (const auto& [id, fields] : reference)
    for (std::size_t f = 0; f < fields.size(); ++f) largest[f] = std::max(largest[f], std::abs(static_cast<double>(fields[f])));
  std::vector<Fields> devices;
  for (std::uint64_t k = 1; k <= 128; ++k) devices.push_back(fields_of(l.conforming(variations, k)));

  Widths out;
  const enclosed::ProfileScope scope(p);
  for (int group = 0; group < l.keyed->groups(); ++group) {
    std::vector<KeyedRecord> records;
    enclosed::PathEnumeration paths;
    // One alternative: where there are more, devices spread over all of them.
    if (!paths.for_each_alternative([&] { records.clear(), l.keyed->enclose(group, records); }) || paths.runs() > 1) continue;
    for (const KeyedRecord& r : records) {
      for (std::size_t f = 0; r.lives && f < r.floats.size(); ++f) {
        const double width = static_cast<double>(r.floats[f].hi) - r.floats[f].lo;
        if (width == 0) continue;
        float low = reference.at(r.id)[f], high = low;
        for (const Fields& d : devices) {
          low = std::min(low, d.at(r.id)[f]);
          high = std::max(high, d.at(r.id)[f]);
        }
        out.over_spread.push_back(high > low ? width / (static_cast<double>(high) - low) : 1e9);
        out.over_field.push_back(width / largest[f]);
        out.ulp.push_back(r.floats[f].width_in_ulp());
      }
    }
  }
  return out;
}

TEST(Lists, EnvelopesAreTight) {
  for (const BoundPass& pass : list_passes()) {
    // Few drops of the packs merge, or are two.
    const bool is_busy = pass.pass == "merge" || pass.pass == "necks";
    const capture::PassCase& last = *pass.cases.back().c;
    const ListCase l(is_busy ? busy(last, 300, 3) : last);
    for (const std::string& name : inexact_profiles()) {
      Widths w = widths_of(l, name);
      ASSERT_GT(w.over_spread.size(), 3u) << pass.name() << ' ' << name;
      std::sort(w.over_spread.begin(), w.over_spread.end());
      std::sort(w.ulp.begin(), w.ulp.end());
      const double median = w.over_spread[w.over_spread.size() / 2], widest = *std::max_element(w.over_field.begin(), w.over_field.end());
      const double ulp = w.ulp[w.ulp.size() / 2];
      fmt::print("{:<40} {:<8} {:5} floats, width over spread {:6.2f}, {:4} ULP, widest over field {:.1e}\n", pass.name(), name,
                 w.over_spread.size(), median, ulp, widest);
      // Devices that round to nearest differ by an ULP or none: of envelopes this narrow the spread says nothing.
      EXPECT_TRUE(median <= 4 || ulp <= 6) << pass.name() << ' ' << name << ": " << median << ", " << ulp << " ULP";
      // Not vacuous: a hundredth of a percent of what the field holds would not go unseen.
      EXPECT_LE(widest, 1e-4) << pass.name() << ' ' << name;
    }
  }
}

// Mistakes taken everywhere in a pass change some records, and these are found.
TEST(Lists, MistakesAreFound) {
  for (const BoundPass& pass : list_passes()) {
    const ListCase l(*pass.cases.back().c);
    int differing = 0, found = 0, by_bits = 0;
    std::string missed;
    for (const perturbed::Fault s : perturbed::faults()) {
      perturbed::Behaviour behaviour;
      behaviour.fault = s;
      const std::vector<std::byte> list = [&] {
        const perturbed::Scope scope(behaviour);
        return *l.keyed->perturbed();
      }();
      if (list == *l.keyed->reference()) continue;
      ++differing;
      by_bits += l.judged(list, "ieee").failing > 0;
      const bool is_found = l.judged(list, "vulkan").failing > 0;
      found += is_found;
      if (!is_found) missed += fmt::format(" {}", static_cast<int>(s));
    }
    fmt::print("{:<40} {:2} faults differ, vulkan finds {:2}; not{}\n", pass.name(), differing, found, missed);
    EXPECT_EQ(by_bits, differing) << pass.name();
    EXPECT_GE(found, 1) << pass.name();
  }
}

}  // namespace
}  // namespace rainref::judge
