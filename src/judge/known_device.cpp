#include "judge/known_device.h"

#include <algorithm>
#include <array>

namespace rainref::judge {

std::vector<perturbed::Behaviour> known_devices() {
  std::vector<perturbed::Behaviour> all(3);
  all[0].filter = all[1].filter = perturbed::Filter::fixed_point;
  all[1].fault = all[2].fault = perturbed::Fault::fused;
  return all;
}
bool allows(const enclosed::Profile& p, const perturbed::Behaviour& device) {
  const auto is_coarser = [](int bits) { return 0 < bits && bits <= fixed_point::bits; };
  if (device.filter == perturbed::Filter::fixed_point && !(is_coarser(p.subtexel_bits) && is_coarser(p.lod_bits))) return false;
  return !p.reference && (device.fault == perturbed::Fault::none || p.contraction);
}

KnownDevice::KnownDevice(const capture::PassModel& model, const std::vector<capture::Array>& port, const std::vector<Slot>& slots,
                         const std::vector<HalfMode>& modes)
    : model_(model), port_(port), slots_(slots), modes_(modes) {}

void KnownDevice::prepare(const Sample& sample, const std::vector<perturbed::Behaviour>& devices,
                          const std::function<bool(int, int)>& is_wanted) {
  if (model_.rounds_inside()) return;
  std::vector<std::array<int, 2>> wanted;
  sample.each(16, [&](int x, int y) {
    if (is_wanted(x, y)) wanted.push_back({x, y});
  });
  // An envelope takes about ten times as long as an evaluation.
  std::int64_t most = static_cast<std::int64_t>(wanted.size()) / 8;
  std::vector<char> is_held;
  for (const perturbed::Behaviour& device : devices) {
    const perturbed::Scope scope(device);
    const std::int64_t count = std::count_if(wanted.begin(), wanted.end(), [&](const std::array<int, 2>& at) {
      find(at[0], at[1], is_held);
      return std::find(is_held.begin(), is_held.end(), 1) != is_held.end();
    });
    if (count <= most) continue;
    most = count + static_cast<std::int64_t>(wanted.size()) / 16;  // arithmetic that differs from the reference's takes longer
    device_ = device;
  }
}

void KnownDevice::find(int x, int y, std::vector<char>& is_held) const {
  thread_local std::vector<perturbed::Perturbed> values;
  values.resize(slots_.size());
  perturbed::behaviour().begin_invocation();
  model_.evaluate(x, y, values.data());
  is_held.assign(modes_.size(), 1);
  for (std::size_t v = 0; v < slots_.size(); ++v) {
    const Slot& slot = slots_[v];
    const std::byte* have = slot.at(port_[static_cast<std::size_t>(slot.output)], x, y);
    for (std::size_t m = 0; m < std::min<std::size_t>(2, modes_.size()); ++m) {
      std::array<std::byte, 4> stored{};
      store_value(slot, values[v].v, rounding_of(slot, modes_[m]), stored.data());
      is_held[m] &= slot.is_same(stored.data(), have);
    }
  }
  if (modes_.size() == 3) is_held[2] = is_held[0] | is_held[1];
}

}  // namespace rainref::judge
