#include "judge/beyond.h"

#include <algorithm>

#include "judge/profiles.h"

namespace rainref::judge {

using enclosed::Rearrangement;

Beyond::Beyond(const std::vector<Slot>& slots, const capture::PassModel& model, const enclosed::Profile& profile)
    : slots_(slots), model_(model), profile_(profile), coarsest_(judge::profile("coarsest")) {}

bool Beyond::finds(int x, int y, const Stored& stored, HalfMode mode) {
  enclosed::Profile rules = model_.rounds_inside() ? narrowed(coarsest_, mode) : coarsest_;
  all_.run(model_, x, y, stored, rules);
  if (all_.gave_up || is_held(stored, mode)) return false;
  if (profile_.rearrangement == Rearrangement::none) return true;
  rules.rearrangement = profile_.rearrangement;
  all_.rearrange(model_, x, y, stored, rules);
  return all_.gave_up || !is_held_rearranged(stored, mode);
}

bool Beyond::is_held(const Stored& stored, HalfMode mode) {
  std::size_t fewest = slots_.size() + 1;
  std::vector<char> outside(slots_.size());
  for (int a = 0; a < all_.count; ++a) {
    code_ranges(slots_, all_.values[static_cast<std::size_t>(a)], coarsest_, mode, ranges_);
    for (std::size_t v = 0; v < slots_.size(); ++v) outside[v] = !stored.free[v] && !ranges_[v].contains(stored.got[v]);
    const auto count = static_cast<std::size_t>(std::count(outside.begin(), outside.end(), 1));
    if (count >= fewest) continue;
    fewest = count;
    outside_ = outside;
    codes_ = ranges_;
  }
  return fewest == 0;
}

bool Beyond::is_held_rearranged(const Stored& stored, HalfMode mode) {
  for (int a = 0; a < all_.count; ++a) {
    const std::vector<enclosed::Enclosure>& values = all_.values[static_cast<std::size_t>(a)];
    code_ranges(slots_, values, coarsest_, mode, ranges_);
    bool is_held = true;
    for (std::size_t v = 0; v < slots_.size() && is_held; ++v)
      is_held =
          stored.free[v] || (ranges_[v].contains(stored.got[v]) && (!outside_[v] || !bound_of(slots_[v], values[v], ranges_[v]).vacuous));
    if (is_held) return true;
  }
  return false;
}

}  // namespace rainref::judge
