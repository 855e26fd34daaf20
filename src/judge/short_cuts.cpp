#include "judge/short_cuts.h"

#include <algorithm>

namespace rainref::judge {

using capture::Array;
using capture::PassCase;
using capture::PassModel;

ShortCuts::ShortCuts(const PassCase& c, const PassModel& model, const std::vector<Array>& port, const JudgeOptions& options,
                     const std::vector<Slot>& slots, const std::vector<HalfMode>& modes)
    : case_(c),
      model_(model),
      port_(port),
      options_(options),
      slots_(slots),
      modes_(modes),
      bits_(c, model, port, slots, modes),
      device_(model, port, slots, modes) {}

void ShortCuts::count(const Sample& sample) {
  Work work(*this);
  Stored stored;
  sample.each(std::max<std::int64_t>(1, sample.size() / 1024), [&](int x, int y) {
    std::array<bool, 2> is_held = bits_.stores(x, y);
    if (!is_held[0] && !is_held[1] && has_parts()) {
      stored.read(slots_, case_, model_, *options_.profile, port_, x, y, options_.kept);
      for (int part = 0; part < model_.parts() && !is_held[0] && !is_held[1]; ++part) {
        find_in_part(part, x, y, stored, work);
        for (std::size_t m = 0; m < 2; ++m) is_held[m] = work.is_held[m] != 0;
      }
    }
    for (std::size_t m = 0; m < 2; ++m) counts_[m] += is_held[m];
  });
  leading_ = counts_[1] > counts_[0] ? 1 : 0;
  if (!bits_.has_reference(leading_)) leading_ = 1 - leading_;
}
void ShortCuts::find_rounding(const Sample& sample) {
  if (modes_.size() >= 2) count(sample);
}
void ShortCuts::prepare(const Sample& sample) {
  if (sample.is_whole()) return;
  bits_.prepare(*options_.executor, leading_, options_.every_rounding);
  std::vector<perturbed::Behaviour> devices = known_devices();
  std::erase_if(devices, [&](const perturbed::Behaviour& d) {
    return !allows(*options_.profile, d) || (options_.typical && !allows(*options_.typical, d));
  });
  device_.prepare(sample, devices, [&](int x, int y) { return !has_reference_bits(x, y); });
}

bool ShortCuts::is_enough(const std::vector<char>& is_held) const {
  return options_.every_rounding ? std::find(is_held.begin(), is_held.end(), 0) == is_held.end() : is_held[leading_] != 0;
}
bool ShortCuts::has_reference_bits(int x, int y) const {
  if (!options_.every_rounding) return bits_.has(leading_, x, y);
  for (std::size_t m = 0; m < modes_.size(); ++m)
    if (!bits_.has(m, x, y)) return false;
  return true;
}

bool ShortCuts::lies_inside(int x, int y, Stored& stored, Work& work) const {
  if (has_reference_bits(x, y)) {
    work.is_held.resize(modes_.size());
    for (std::size_t m = 0; m < modes_.size(); ++m) work.is_held[m] = m == leading_ || bits_.has(m, x, y);
    return true;
  }
  if (work.device) {
    device_.find(x, y, work.is_held);
    if (is_enough(work.is_held)) return true;
  }
  stored.read(slots_, case_, model_, *options_.profile, port_, x, y, options_.kept);
  if (stored.any_impossible) return false;
  for (int part = 0; has_parts() && part < model_.parts(); ++part) {
    find_in_part(part, x, y, stored, work);
    if (is_enough(work.is_held)) return true;
  }
  return false;
}

bool ShortCuts::lie_inside(int x, int y, int count, Work& work) const {
  work.is_held.resize(modes_.size());
  for (std::size_t m = 0; m < modes_.size(); ++m) work.is_held[m] = bits_.is_expected(m);
  // By another rounding, asked for too, the bits are those of another reference.
  return is_enough(work.is_held) && bits_.have_expected(x, y, count);
}

bool ShortCuts::has_parts() const { return !options_.profile->reference && !model_.rounds_inside(); }
void ShortCuts::find_in_part(int part, int x, int y, const Stored& stored, Work& work) const {
  work.is_held.assign(modes_.size(), 1);
  for (const enclosed::Profile* profile : {options_.profile, options_.typical}) {
    if (!profile || std::find(work.is_held.begin(), work.is_held.end(), 1) == work.is_held.end()) continue;
    work.parts.run_part(model_, part, x, y, stored, *profile);
    for (std::size_t m = 0; m < modes_.size(); ++m) {
      bool is_inside = false;
      for (int a = 0; a < work.parts.count && work.is_held[m] && !is_inside; ++a) {
        code_ranges(slots_, work.parts.values[static_cast<std::size_t>(a)], *profile, modes_[m], work.ranges);
        is_inside = inside(*profile, work.ranges, stored);
      }
      work.is_held[m] &= is_inside;
    }
  }
}

}  // namespace rainref::judge
