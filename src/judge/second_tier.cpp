#include "judge/second_tier.h"

#include "judge/widths.h"

namespace rainref::judge {

void SecondTier::run(enclosed::Rearrangement how, int x, int y, const Stored& stored, HalfMode mode, Alternatives& all) const {
  enclosed::Profile profile = model_.rounds_inside() ? narrowed(profile_, mode) : profile_;
  profile.rearrangement = how;
  all.rearrange(model_, x, y, stored, profile);
}

bool SecondTier::accepts(enclosed::Rearrangement how, int x, int y, const Stored& stored, const std::vector<enclosed::CodeRange>& nearest,
                         HalfMode mode) {
  run(how, x, y, stored, mode, all_);
  return accepts(all_, stored, nearest, mode);
}

bool SecondTier::accepts(const Alternatives& all, const Stored& stored, const std::vector<enclosed::CodeRange>& nearest, HalfMode mode) {
  for (int a = 0; a < all.count && !all.gave_up; ++a) {
    const std::vector<enclosed::Enclosure>& values = all.values[static_cast<std::size_t>(a)];
    code_ranges(slots_, values, profile_, mode, ranges_);
    bool is_accepted = inside(profile_, ranges_, stored);
    for (std::size_t v = 0; v < slots_.size() && is_accepted; ++v)
      is_accepted = holds(profile_, stored, v, nearest[v]) || !bound_of(slots_[v], values[v], ranges_[v]).vacuous;
    if (is_accepted) return true;
  }
  return false;
}

bool SecondTier::is_near(const Stored& stored, const std::vector<enclosed::CodeRange>& nearest, HalfMode mode) {
  constexpr std::uint64_t times = 4;
  const auto near = [&](const std::vector<enclosed::CodeRange>& ranges) {
    for (std::size_t v = 0; v < slots_.size(); ++v)
      if (!holds(profile_, stored, v, ranges[v]) && distance(stored.got[v], ranges[v]) > times * (width_of(ranges[v]) + std::uint64_t{1}))
        return false;
    return true;
  };
  if (all_.gave_up) return near(nearest);
  for (int a = 0; a < all_.count; ++a) {
    code_ranges(slots_, all_.values[static_cast<std::size_t>(a)], profile_, mode, ranges_);
    if (near(ranges_)) return true;
  }
  return false;
}

const std::vector<enclosed::CodeRange>* SecondTier::codes(int x, int y, const Stored& stored, HalfMode mode) {
  run(profile_.rearrangement, x, y, stored, mode, all_);
  if (all_.gave_up) return nullptr;
  code_ranges(slots_, all_.values[0], profile_, mode, ranges_);
  return &ranges_;
}

}  // namespace rainref::judge
