// Passes that take lists of drops, as conformance takes them.
#pragma once

#include <cstring>
#include <memory>
#include <vector>

#include "capture/pass_model.h"
#include "drops/ranges.h"
#include "drops/records.h"

namespace rainref::drops {

/// A drop as a pass gives it, and whether the list still has it.
template <class N>
struct ListedDrop {
  N u, v, velocity_u, velocity_v, mass, life;
  typename N::Mask lives;
};
/// The record of a number that has a value v. Stored zeros are positive.
template <class N>
Drop stored(const ListedDrop<N>& d, std::uint32_t id) {
  return {{d.u.v + 0.0f, d.v.v + 0.0f}, {d.velocity_u.v + 0.0f, d.velocity_v.v + 0.0f}, d.mass.v + 0.0f, d.life.v + 0.0f, id, 0};
}
inline capture::KeyedRecord enclosed_record(const ListedDrop<enclosed::Enclosure>& d, std::uint32_t id) {
  return {id, d.lives, {d.u, d.v, d.velocity_u, d.velocity_v, d.mass, d.life}, {}};
}
inline capture::KeyedRecord enclosed_record(const ListedDrop<enclosed::Rearranged>& d, std::uint32_t id) {
  return {
      id, d.lives, {d.u.settled(), d.v.settled(), d.velocity_u.settled(), d.velocity_v.settled(), d.mass.settled(), d.life.settled()}, {}};
}
std::vector<std::byte> bytes_of(const std::vector<Drop>& drops);

/// A pass that treats each drop by itself: Pass gives ListedDrop<N> operator()<N>(const Drop&). A group is one drop.
template <class Pass>
class DropByDrop : public capture::KeyedModel {
 public:
  DropByDrop(Pass pass, std::vector<Drop> drops, bool corrected)
      : pass_(std::move(pass)), drops_(std::move(drops)), corrected_(corrected) {}
  int groups() const override { return static_cast<int>(drops_.size()); }
  const std::vector<capture::FieldRange>& ranges() const override { return drop_ranges(corrected_); }
  void enclose(int group, std::vector<capture::KeyedRecord>& out) const override {
    const Drop& d = drops_[static_cast<std::size_t>(group)];
    out.push_back(enclosed_record(pass_.template operator()<enclosed::Enclosure>(d), d.id));
  }
  bool rearrange(int group, std::vector<capture::KeyedRecord>& out) const override {
    const Drop& d = drops_[static_cast<std::size_t>(group)];
    out.push_back(enclosed_record(pass_.template operator()<enclosed::Rearranged>(d), d.id));
    return true;
  }
  std::optional<std::vector<std::byte>> reference() const override { return list<scalar::Scalar<float>>(); }
  std::optional<std::vector<std::byte>> perturbed() const override { return list<perturbed::Perturbed>(); }

 private:
  template <class N>
  std::vector<std::byte> list() const {
    std::vector<Drop> out;
    for (const Drop& d : drops_) {
      const ListedDrop<N> given = pass_.template operator()<N>(d);
      if (given.lives) out.push_back(stored(given, d.id));
    }
    return bytes_of(out);
  }
  Pass pass_;
  std::vector<Drop> drops_;
  bool corrected_;
};

/// The input "drops". Throws Error(port_files) where an id is there twice.
std::vector<Drop> drops_input(const capture::PassCase& c);

/// Allows more than every profile: what is settled under it is settled under each of them. Groups of drops that share
/// decisions are found by it.
const enclosed::Profile& loosest_profile();

std::unique_ptr<capture::PassModel> bind_merge(const capture::PassCase& c);
std::unique_ptr<capture::PassModel> bind_integrate(const capture::PassCase& c);
std::unique_ptr<capture::PassModel> bind_splat(const capture::PassCase& c);
/// spawn: the drops of before and the arrivals.
std::vector<capture::Array> recompute_spawn(const capture::PassCase& c);

}  // namespace rainref::drops
