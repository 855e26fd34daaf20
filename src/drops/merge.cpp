#include <algorithm>
#include <numeric>
#include <tuple>

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

/// A drop that ends, and the end of its chain: places in the grid, and its slot.
struct Member {
  std::uint32_t root, id, slot;
};

/// Asks for a drop that is soon read and written.
void prefetch(DropArrays& drops, std::int64_t slot) {
  for (float* field :
       {drops.u().data(), drops.v().data(), drops.velocity_u().data(), drops.velocity_v().data(), drops.mass().data(), drops.life().data()})
    __builtin_prefetch(field + slot, 1);
  __builtin_prefetch(drops.id().data() + slot, 1);
}

}  // namespace

struct Merger::Scratch {
  MergeGrid grid;
  std::vector<std::int32_t> larger;
  BucketSort by_root;
};

Merger::Merger() : scratch_(std::make_unique<Scratch>()) {}
Merger::~Merger() = default;

std::int64_t Merger::merge(const parallel::Executor& executor, DropArrays& drops, const MergeUniforms& uniforms) {
  MergeGrid& grid = scratch_->grid;
  grid.build(executor, drops, uniforms);
  std::vector<std::int32_t>& larger = scratch_->larger;
  larger.resize(std::max(larger.size(), static_cast<std::size_t>(grid.count)));
  const std::int64_t chunk = std::min<std::int64_t>(1024, chunk_of(grid.count));
  executor.for_range(grid.count, chunk, [&](std::int64_t begin, std::int64_t end) { find_larger_range(grid, begin, end, larger.data()); });

  // Ends of chains. What is known of a chain shortens it for the others: whatever of it a thread meets leads to the same end.
  // With the compilers' own atomics: libc++ before 19 has no std::atomic_ref.
  const auto next = [&](std::int64_t i) { return &larger[static_cast<std::size_t>(i)]; };
  executor.for_range(grid.count, chunk, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      std::int32_t root = __atomic_load_n(next(i), __ATOMIC_RELAXED);
      if (root < 0) continue;
      for (std::int32_t beyond; (beyond = __atomic_load_n(next(root), __ATOMIC_RELAXED)) >= 0;) root = beyond;
      for (std::int64_t k = i; k != root;) k = __atomic_exchange_n(next(k), root, __ATOMIC_RELAXED);
    }
  });
  BucketSort& by_root = scratch_->by_root;
  by_root.sort(executor, grid.count, chunk_of(grid.count), static_cast<std::uint32_t>(grid.count), [&](std::int64_t i) {
    return static_cast<std::uint32_t>(larger[static_cast<std::size_t>(i)]);  // -1: no key
  });

  std::vector<std::int64_t> ended_in(by_root.buckets(), 0);
  executor.for_range(static_cast<std::int64_t>(by_root.buckets()), 1, [&](std::int64_t bucket, std::int64_t) {
    std::vector<Member> members;
    for (const BucketSort::Entry& e : by_root[static_cast<std::size_t>(bucket)])
      members.push_back({e.key, grid.id[e.element], grid.slot[e.element]});
    std::sort(members.begin(), members.end(),
              [](const Member& a, const Member& b) { return std::tie(a.root, a.id) < std::tie(b.root, b.id); });
    constexpr std::size_t ahead = 8;
    for (std::size_t i = 0; i < members.size();) {
      const std::uint32_t root = members[i].root;
      scalar::DropState<F> sum = state_of<F>(drops.get(grid.slot[root]));
      for (; i < members.size() && members[i].root == root; ++i) {
        if (i + ahead < members.size()) {
          prefetch(drops, members[i + ahead].slot);
          prefetch(drops, grid.slot[members[i + ahead].root]);
        }
        const std::int64_t slot = members[i].slot;
        const Drop d = drops.get(slot);
        if (d.mass > most_mass - sum.mass.v) continue;  // exact, where the sum is not
        sum = scalar::absorb(sum, state_of<F>(d));
        drops.set(slot, {{d.position[0], d.position[1]}, {0, 0}, 0, 0, d.id, 0});
        ++ended_in[static_cast<std::size_t>(bucket)];
      }
      drops.set(grid.slot[root], drop_of(sum, grid.id[root]));
    }
  });
  return std::accumulate(ended_in.begin(), ended_in.end(), std::int64_t{0});
}

MassBalance leave_trails(const parallel::Executor& executor, DropArrays& drops, const MergeUniforms& uniforms, Image& film) {
  const Slots slots(drops);
  const std::int64_t chunk = chunk_of(drops.extent());
  std::vector<std::vector<Deposit>> of_chunk(static_cast<std::size_t>((drops.extent() + chunk - 1) / chunk));
  executor.for_range(drops.extent(), chunk, [&](std::int64_t begin, std::int64_t end) {
    trail_range(uniforms, slots, begin, end, of_chunk[static_cast<std::size_t>(begin / chunk)]);
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
