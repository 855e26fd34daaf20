#include <algorithm>
#include <tuple>
#include <utility>

#include "drops/kernels.h"
#include "drops/merge_grid.h"
#include "drops/passes.h"
#include "drops/scalar.h"

namespace rainref::drops {
namespace {

using F = scalar::Scalar<float>;

Drop drop_of(const scalar::DropState<F>& s, std::uint32_t id) {
  // + 0: stored zeros are positive.
  return {{s.u.v + 0.0f, s.v.v + 0.0f}, {s.velocity_u.v + 0.0f, s.velocity_v.v + 0.0f}, s.mass.v, s.life.v, id, 0};
}

struct Member {
  std::uint32_t root_id, id, root_slot, slot;
};

}  // namespace

struct Merger::Scratch {
  MergeGrid grid;
  std::vector<std::int32_t> larger;
};

Merger::Merger() : scratch_(std::make_unique<Scratch>()) {}
Merger::~Merger() = default;

std::int64_t Merger::merge(const parallel::Executor& executor, DropArrays& drops, const MergeUniforms& uniforms) {
  MergeGrid& grid = scratch_->grid;
  grid.build(executor, drops, uniforms);
  std::vector<std::int32_t>& larger = scratch_->larger;
  larger.resize(std::max(larger.size(), static_cast<std::size_t>(grid.count)));
  constexpr std::int64_t chunk = 1024;
  executor.for_range(grid.count, chunk, [&](std::int64_t begin, std::int64_t end) { find_larger_range(grid, begin, end, larger.data()); });

  // Ends of chains. What is known of a chain shortens it for the others.
  std::vector<Member> members;
  for (std::size_t i = 0; i < static_cast<std::size_t>(grid.count); ++i) {
    if (larger[i] < 0) continue;
    auto root = static_cast<std::size_t>(larger[i]);
    while (larger[root] >= 0) root = static_cast<std::size_t>(larger[root]);
    for (std::size_t k = i; k != root;) k = static_cast<std::size_t>(std::exchange(larger[k], static_cast<std::int32_t>(root)));
    members.push_back({grid.id[root], grid.id[i], grid.slot[root], grid.slot[i]});
  }
  std::sort(members.begin(), members.end(),
            [](const Member& a, const Member& b) { return std::tie(a.root_id, a.id) < std::tie(b.root_id, b.id); });

  std::int64_t ended = 0;
  for (std::size_t i = 0; i < members.size();) {
    const Member first = members[i];
    scalar::DropState<F> sum = state_of<F>(drops.get(first.root_slot));
    for (; i < members.size() && members[i].root_id == first.root_id; ++i) {
      const std::int64_t slot = members[i].slot;
      const Drop d = drops.get(slot);
      if (d.mass > most_mass - sum.mass.v) continue;  // exact, where the sum is not
      sum = scalar::absorb(sum, state_of<F>(d));
      drops.set(slot, {{d.position[0], d.position[1]}, {0, 0}, 0, 0, d.id, 0});
      ++ended;
    }
    drops.set(first.root_slot, drop_of(sum, first.root_id));
  }
  return ended;
}

MassBalance leave_trails(const parallel::Executor& executor, DropArrays& drops, const MergeUniforms& uniforms, Image& film) {
  const Slots slots(drops);
  std::vector<std::vector<Deposit>> of_chunk(static_cast<std::size_t>((drops.extent() + chunk_slots - 1) / chunk_slots));
  executor.for_range(drops.extent(), chunk_slots, [&](std::int64_t begin, std::int64_t end) {
    trail_range(uniforms, slots, begin, end, of_chunk[static_cast<std::size_t>(begin / chunk_slots)]);
  });
  MassBalance balance;
  for (const auto& deposits : of_chunk) {
    for (const Deposit& d : deposits) {
      float& texel = film.row<float>(d.row)[d.column];
      // Both are at most 2^24, so room is exact, and so is what is put there: any order gives the same film.
      const float put = std::min(d.mass_units, most_mass - texel);
      texel += put;
      balance.to_film += static_cast<std::int64_t>(put);
      balance.removed += static_cast<std::int64_t>(d.mass_units - put);
    }
  }
  return balance;
}

MassBalance dry_film(const parallel::Executor& executor, const MergeUniforms& uniforms, Image& film) {
  MassBalance balance;
  if (!(uniforms.drying > 0)) return balance;
  std::vector<std::int64_t> of_row(static_cast<std::size_t>(film.height()));
  executor.for_range(film.height(), 16, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t y = begin; y < end; ++y)
      of_row[static_cast<std::size_t>(y)] = dry_row(uniforms, film.row<float>(static_cast<int>(y)), film.width());
  });
  for (const std::int64_t sum : of_row) balance.evaporated += sum;
  balance.to_film = -balance.evaporated;
  return balance;
}

MassBalance Merger::run(const parallel::Executor& executor, DropArrays& drops, const MergeUniforms& uniforms, Image& film) {
  merge(executor, drops, uniforms);
  MassBalance balance = dry_film(executor, uniforms, film);
  balance += leave_trails(executor, drops, uniforms, film);
  return balance;
}

std::int64_t film_water(const Image& film) {
  std::int64_t sum = 0;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) sum += static_cast<std::int64_t>(film.row<float>(y)[x]);
  }
  return sum;
}

}  // namespace rainref::drops
