// The small packs' cases with their models, and random conforming devices to judge by them.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "base/words.h"
#include "capture/pack_read.h"
#include "judge/alternatives.h"
#include "judge/evaluations.h"
#include "judge/profiles.h"
#include "judge/slots.h"
#include "judge/validate.h"
#include "math/path_enumeration.h"
#include "math/perturbed.h"
#include "shipped_packs.h"

namespace rainref::judge::test {

using rainref::test::pack_folder, rainref::test::PackPasses, rainref::test::Words, rainref::test::proven_packs, rainref::test::shipped_pack,
    rainref::test::shipped_packs, rainref::test::name_of_pack_test;

/// Every profile under which results may differ.
inline std::vector<std::string> inexact_profiles() {
  std::vector<std::string> names = profile_names();
  std::erase(names, "ieee");
  names.push_back("typical");
  return names;
}

/// A case that is judged.
struct BoundCase {
  std::unique_ptr<capture::PassCase> c;
  std::unique_ptr<capture::PassModel> model;  ///< null: by its bits alone
  std::vector<Slot> slots;                    ///< that envelopes judge
  /// The list of records with ids that the model judges, or null.
  const capture::CaseOutput* list() const {
    const auto found = std::find_if(c->outputs.begin(), c->outputs.end(), [&](const auto& o) { return model && model->keyed(o.name); });
    return found == c->outputs.end() ? nullptr : &*found;
  }
  std::vector<capture::Array> expected() const {
    std::vector<capture::Array> out;
    for (const capture::CaseOutput& o : c->outputs) out.push_back(o.array);
    return out;
  }
};
/// A pass of a small pack with all its cases.
struct BoundPass {
  std::string pack, pass;
  std::string pass_and_variant;  ///< "windshield-corrected merge": whatever the pack
  std::vector<BoundCase> cases;
  std::string name() const { return pack + " " + pass; }
  /// Of masks of 0 and 1, which hide most of what devices do: nearly every value is one number.
  bool is_of_masks() const { return pass_and_variant == "edge_splash-as-published splash"; }
  /// Of whole mass units, and the packs have no place where a device could tip one: nothing spreads. windshield_motion_test.cpp has
  /// places where one can.
  bool is_of_mass_units() const { return pass == "merge" || pass == "wipe_drops"; }
  /// Whether no device of a profile can differ from the reference on the packs. Of two pictures a device takes one (honesty_test.cpp has
  /// a case on the edge); a product alone is one number where the profile rounds to nearest.
  bool is_one_number(const enclosed::Profile& p) const {
    return is_of_mass_units() || pass == "join_panes" || (pass == "persist" && p.basic == enclosed::BasicRounding::nearest);
  }
};
/// The passes that a port is judged by; those that the host makes are data.
inline std::vector<BoundPass> judged_passes(const std::vector<PackPasses>& of = proven_packs()) {
  std::vector<BoundPass> all;
  for (const PackPasses& some : of) {
    const capture::Pack pack(pack_folder(some.name));
    for (const std::string& pass : some.passes) {
      BoundPass found{some.name, pass, some.effect_and_variant() + " " + pass, {}};
      for (const capture::PackCase& entry : pack.cases) {
        if (entry.pass != pass) continue;
        auto c = std::make_unique<capture::PassCase>(pack.read(entry));
        const auto is_data = [](const capture::CaseOutput& o) { return o.judge == capture::Judge::input_only; };
        if (std::all_of(c->outputs.begin(), c->outputs.end(), is_data)) continue;
        auto model = bound(pass, binder(pack.effect, pass), *c);
        std::vector<Slot> slots = slots_of(*c);
        found.cases.push_back({std::move(c), std::move(model), std::move(slots)});
      }
      if (!found.cases.empty()) all.push_back(std::move(found));
    }
  }
  return all;
}
/// Those of them that some envelope judges.
inline std::vector<BoundPass> enveloped_passes(const std::vector<PackPasses>& of = proven_packs()) {
  std::vector<BoundPass> all = judged_passes(of);
  for (BoundPass& pass : all) std::erase_if(pass.cases, [](const BoundCase& b) { return b.slots.empty(); });
  std::erase_if(all, [](const BoundPass& pass) { return pass.cases.empty(); });
  return all;
}
/// Those that give a list of records with ids, which a model judges.
inline std::vector<BoundPass> list_passes(const std::vector<PackPasses>& of = proven_packs()) {
  std::vector<BoundPass> all = judged_passes(of);
  std::erase_if(all, [](const BoundPass& pass) { return !pass.cases.front().list(); });
  return all;
}

/// Whether rearrangements of all that the pass gives are evaluated, and do not have too many alternatives nearly everywhere.
inline bool has_second_tier(const BoundPass& pass) {
  const enclosed::ProfileScope scope(profile("vulkan"));
  const auto is_known = [](const auto& rearrange) {
    bool known = true;
    enclosed::PathEnumeration paths;
    return paths.for_each_alternative([&] { known &= rearrange(); }) && known;
  };
  return std::all_of(pass.cases.begin(), pass.cases.end(), [&](const BoundCase& b) {
    if (!b.model) return false;
    int tried = 0, known = 0;
    if (const capture::KeyedModel* list = b.list() ? b.model->keyed(b.list()->name) : nullptr) {
      for (int group = 0; group < list->groups(); ++group, ++tried)
        known += is_known([&] {
          std::vector<capture::KeyedRecord> records;
          return list->rearrange(group, records);
        });
      if (3 * known < tried) return false;
    }
    const std::int64_t texels = b.slots.empty() ? 0 : static_cast<std::int64_t>(b.model->width()) * b.model->height();
    tried = known = 0;
    for (std::int64_t k = 0; k < std::min<std::int64_t>(60, texels); ++k, ++tried) {
      const auto at = static_cast<int>(k * 7919 % texels);
      const std::vector<float> port(b.slots.size());
      std::vector<enclosed::Enclosure> values(b.slots.size());
      known += is_known([&] { return b.model->rearrange(at % b.model->width(), at / b.model->width(), port.data(), values.data()); });
    }
    return 3 * known >= tried;
  });
}

/// Whether one alternative holds every value.
inline bool one_holds(const Alternatives& all, const capture::PassModel& model, const std::vector<float>& got) {
  for (int a = 0; a < all.count; ++a) {
    bool is_held = true;
    for (std::size_t v = 0; v < got.size(); ++v) {
      const enclosed::Enclosure& e = all.values[static_cast<std::size_t>(a)][v];
      is_held &= e.is_vacuous() || e.contains(got[v]) || model.is_free(static_cast<int>(v));
    }
    if (is_held) return true;
  }
  return false;
}

/// The values of one invocation on a conforming device, the seed'th: three kinds take turns, whose errors lie anywhere,
/// or lean to one end throughout.
inline std::vector<float> conforming_values(const capture::PassModel& model, int x, int y, const perturbed::Variations& variations,
                                            std::uint64_t seed) {
  perturbed::Behaviour behaviour;
  behaviour.variations = &variations;
  behaviour.random = Words(seed)();
  behaviour.lean = static_cast<int>(seed % 3) - 1;
  const perturbed::Scope scope(behaviour);
  std::vector<perturbed::Perturbed> values(static_cast<std::size_t>(model.values()));
  model.evaluate(x, y, values.data());
  std::vector<float> out;
  for (const perturbed::Perturbed& v : values) out.push_back(v.v);
  return out;
}

/// What the profile leaves open about a device's stores to binary16, one of it.
inline HalfMode drawn_mode(const enclosed::Profile& p, Words& words) {
  if (p.half_store == enclosed::StoreRounding::rne) return HalfMode::rne;
  if (p.half_store == enclosed::StoreRounding::rtz) return HalfMode::rtz;
  constexpr HalfMode modes[] = {HalfMode::rne, HalfMode::rtz, HalfMode::either};
  return modes[words() % 3];
}
inline void store_conforming(const Slot& slot, float value, const enclosed::Profile& p, HalfMode mode, Words& words, std::byte* at) {
  if (slot.kind == FormatInfo::float16) {
    const float rounded = to_float(to_half(value, mode == HalfMode::rne ? Rounding::rne : Rounding::rtz));
    if (p.half_store_flush && rounded > -0x1p-14f && rounded < 0x1p-14f && words.coin()) return store_value(slot, 0.0f, Rounding::rne, at);
    const float cut = to_float(to_half(value, Rounding::rtz));
    const bool beyond = value >= 65520.0f || value <= -65520.0f;
    if (mode == HalfMode::either && cut != value && !beyond) {
      // The half below or above, by the bits of the one toward zero; a negative one that reaches 0 is stored as +0.
      const Half low = to_half(value, Rounding::rtz);
      const Half any{static_cast<std::uint16_t>(words.coin() ? low.bits : low.bits + 1)};
      return store_value(slot, to_float(any), Rounding::rne, at);
    }
    return store_value(slot, value, mode == HalfMode::rtz ? Rounding::rtz : Rounding::rne, at);
  }
  if (slot.kind == FormatInfo::unorm8 && p.unorm_store_ulp > 0 && slot.store_rounding == Rounding::rne) {
    const double scaled = 255.0 * std::min(std::max(value, 0.0f), 1.0f), below = static_cast<double>(static_cast<int>(scaled));
    const double other = words.coin() ? below : std::min(below + 1, 255.0);
    const bool is_code = to_float(Unorm8{to_unorm8(value).code}) == value;
    if (!is_code && std::abs(other - scaled) <= p.unorm_store_ulp) {
      *at = static_cast<std::byte>(static_cast<int>(other));
      return;
    }
  }
  store_value(slot, value, slot.store_rounding, at);
}

/// A count from the environment, for the long proofs of scripts/full.
inline std::int64_t count_from(const char* variable, std::int64_t otherwise) {
  const char* text = std::getenv(variable);
  return text ? std::atoll(text) : otherwise;
}

}  // namespace rainref::judge::test
