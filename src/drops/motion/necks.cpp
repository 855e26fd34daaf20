#include "drops/motion/necks.h"

#include <algorithm>
#include <memory>

#include "drops/motion/scalar.h"

namespace rainref::drops {
namespace {

using F = scalar::Scalar<float>;

Neck record_of(const scalar::NeckState<F>& s, std::uint32_t id) {
  // + 0: stored zeros are positive.
  return {{s.offset_x.v + 0.0f, s.offset_y.v + 0.0f}, s.share.v, s.left.v, id, 0, 0, 0};
}

}  // namespace

void Necks::resize(std::size_t count) {
  for (std::vector<float>& numbers : numbers_) numbers.resize(count);
  id_.resize(count);
  slot_.resize(count);
}

void Necks::put(const Neck& n, std::uint32_t slot) {
  const float values[] = {n.offset[0], n.offset[1], n.share, n.left};
  for (std::size_t k = 0; k < 4; ++k) numbers_[k].push_back(values[k]);
  id_.push_back(n.id);
  slot_.push_back(slot);
}

const std::vector<Neck>& Necks::list() {
  listed_.clear();
  for (std::size_t i = 0; i < size(); ++i)
    listed_.push_back({{numbers_[0][i], numbers_[1][i]}, numbers_[2][i], numbers_[3][i], id_[i], 0, 0, 0});
  return listed_;
}

void Necks::step(const DropArrays& drops, const NecksUniforms& uniforms, std::span<const Joining> joining,
                 std::span<const std::uint32_t> ended) {
  struct Kept {
    std::uint32_t id, slot;
    scalar::NeckState<F> state;
  };
  std::vector<Kept> kept;
  // A slot may now hold another drop.
  list();
  for (std::size_t i = 0; i < size(); ++i) {
    const std::uint32_t slot = slot_[i];
    if (slot >= drops.extent() || drops.id()[slot] != id_[i] || !(drops.life()[slot] > 0)) continue;
    if (std::binary_search(ended.begin(), ended.end(), slot)) continue;
    kept.push_back({id_[i], slot, scalar::receded(uniforms, pass::loaded<scalar::NeckState<F>>(listed_[i]), state_of<F>(drops.get(slot)))});
  }
  const auto by_id = [](const Kept& a, const Kept& b) { return a.id < b.id; };
  const std::size_t old = kept.size();
  for (const Joining& j : joining) {
    const Drop a = drops.get(j.into), b = drops.get(j.slot);
    Kept fresh{a.id, j.into, scalar::joined(uniforms, state_of<F>(a), state_of<F>(b))};
    const auto end = kept.begin() + static_cast<std::ptrdiff_t>(old), own = std::lower_bound(kept.begin(), end, fresh, by_id);
    if (own != end && own->id == fresh.id)
      own->state = scalar::more_seen(own->state, fresh.state);
    else
      kept.push_back(fresh);
  }
  std::sort(kept.begin(), kept.end(), by_id);
  resize(0);
  for (const Kept& k : kept)
    if (scalar::stands_out(k.state)) put(record_of(k.state, k.id), k.slot);
}

void Necks::list_state(state::Items& items, std::int64_t most) {
  const auto length = std::make_shared<state::Length>(
      state::Length{size(), static_cast<std::uint64_t>(most), [this](std::uint64_t count) { resize(static_cast<std::size_t>(count)); }});
  constexpr const char* names[] = {"neck_x", "neck_y", "neck_share", "neck_left"};
  constexpr state::Range ranges[] = {{-1.6, 1.6}, {-1.6, 1.6}, {0, 0.5}, {0, 1}};
  for (std::size_t k = 0; k < 4; ++k)
    items.array(names[k], state::Type::f32, ranges[k], length, [this, k] { return static_cast<void*>(numbers_[k].data()); });
  items.array("neck_id", state::Type::u32, state::finite(), length, [this] { return static_cast<void*>(id_.data()); });
  items.array("neck_slot", state::Type::u32, state::finite(), length, [this] { return static_cast<void*>(slot_.data()); });
}

}  // namespace rainref::drops
