#include "judge/beyond.h"

#include <algorithm>

#include "judge/profiles.h"

namespace rainref::judge {

using enclosed::Enclosure;
using enclosed::Rearrangement;

Beyond::Beyond(const std::vector<Slot>& slots, const capture::PassModel& model, const enclosed::Profile& profile)
    : slots_(slots), model_(model), profile_(profile), coarsest_(judge::profile("coarsest")), tried_(slots.size()) {}

bool Beyond::finds(int x, int y, const Stored& stored, const std::vector<char>& vacuous, HalfMode mode) {
  enclosed::Profile rules = model_.rounds_inside() ? narrowed(coarsest_, mode) : coarsest_;
  fewest_ = slots_.size() + 1;
  all_.run(model_, x, y, stored.got_values.data(), rules);
  if (!none_holds(stored, vacuous, mode)) return false;
  if (profile_.rearrangement == Rearrangement::none) return true;
  rules.rearrangement = profile_.rearrangement;
  all_.rearrange(model_, x, y, stored.got_values.data(), rules);
  return none_holds(stored, vacuous, mode);
}

bool Beyond::none_holds(const Stored& stored, const std::vector<char>& vacuous, HalfMode mode) {
  for (int a = 0; a < all_.count && !all_.gave_up; ++a) {
    const std::vector<Enclosure>& values = all_.values[static_cast<std::size_t>(a)];
    code_ranges(slots_, values, coarsest_, mode, tried_codes_);
    for (std::size_t v = 0; v < slots_.size(); ++v)
      tried_[v] = vacuous[v] && !stored.free[v] && !tried_codes_[v].contains(stored.got[v]) &&
                  !bound_of(slots_[v], values[v], tried_codes_[v]).vacuous;
    const auto count = static_cast<std::size_t>(std::count(tried_.begin(), tried_.end(), 1));
    if (count >= fewest_) continue;
    fewest_ = count;
    outside_ = tried_;
    codes_ = tried_codes_;
  }
  return !all_.gave_up && fewest_ > 0;
}

}  // namespace rainref::judge
