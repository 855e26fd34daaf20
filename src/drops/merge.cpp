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

/// A drop that ends: the end of its chain by its place in the grid, its own id and slot.
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

/// Drops that end, all of theirs that end in the same one among them, into those in which they end. How many did.
std::int64_t take_in(const MergeGrid& grid, std::vector<Member>& members, DropArrays& drops) {
  std::sort(members.begin(), members.end(),
            [](const Member& a, const Member& b) { return std::tie(a.root, a.id) < std::tie(b.root, b.id); });
  constexpr std::size_t ahead = 8;
  std::int64_t ended = 0;
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
      ++ended;
    }
    drops.set(grid.slot[root], drop_of(sum, grid.id[root]));
  }
  return ended;
}

/// What happens to the film: it dries, and takes trails. In one go, as rows and drops do not concern each other.
MassBalance change_film(const parallel::Executor& executor, const MergeUniforms& uniforms, DropArrays* leaving, bool dries, Image& film) {
  constexpr std::int64_t rows = 16;
  const std::int64_t row_pieces = dries && uniforms.drying > 0 ? (film.height() + rows - 1) / rows : 0;
  const std::int64_t extent = leaving ? leaving->extent() : 0, chunk = chunk_of(extent), drop_pieces = (extent + chunk - 1) / chunk;
  std::vector<std::int64_t> dried(static_cast<std::size_t>(row_pieces), 0);
  std::vector<std::vector<Deposit>> deposited(static_cast<std::size_t>(drop_pieces));
  executor.for_range(row_pieces + drop_pieces, 1, [&](std::int64_t piece, std::int64_t) {
    if (piece >= row_pieces) {
      const std::int64_t begin = (piece - row_pieces) * chunk;
      trail_range(uniforms, Slots(*leaving), begin, std::min(extent, begin + chunk),
                  deposited[static_cast<std::size_t>(piece - row_pieces)]);
      return;
    }
    for (std::int64_t y = piece * rows; y < std::min<std::int64_t>(film.height(), (piece + 1) * rows); ++y)
      dried[static_cast<std::size_t>(piece)] += dry_row(uniforms, film.row<float>(static_cast<int>(y)), film.width());
  });
  MassBalance balance;
  for (const std::int64_t sum : dried) balance.evaporated += sum;
  balance.to_film = -balance.evaporated;
  for (const auto& deposits : deposited) {
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

}  // namespace

struct Merger::Scratch {
  MergeGrid grid;
  std::vector<std::int32_t> larger;
  std::vector<Member> ended;
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
  std::vector<std::vector<Member>> of_chunk(static_cast<std::size_t>((grid.count + chunk - 1) / chunk));
  executor.for_range(grid.count, chunk, [&](std::int64_t begin, std::int64_t end) {
    std::vector<Member>& ended = of_chunk[static_cast<std::size_t>(begin / chunk)];
    for (std::int64_t i = begin; i < end; ++i) {
      std::int32_t root = __atomic_load_n(next(i), __ATOMIC_RELAXED);
      if (root < 0) continue;
      for (std::int32_t beyond; (beyond = __atomic_load_n(next(root), __ATOMIC_RELAXED)) >= 0;) root = beyond;
      for (std::int64_t k = i; k != root;) k = __atomic_exchange_n(next(k), root, __ATOMIC_RELAXED);
      ended.push_back({static_cast<std::uint32_t>(root), grid.id[static_cast<std::size_t>(i)], grid.slot[static_cast<std::size_t>(i)]});
    }
  });
  std::vector<Member>& ended = scratch_->ended;
  ended.clear();
  for (const std::vector<Member>& members : of_chunk) ended.insert(ended.end(), members.begin(), members.end());

  constexpr std::size_t few = 2048;  // sooner taken in than handed out
  if (ended.size() <= few) return take_in(grid, ended, drops);
  BucketSort& by_root = scratch_->by_root;
  const auto count = static_cast<std::int64_t>(ended.size());
  const auto root_of = [&](std::int64_t i) { return ended[static_cast<std::size_t>(i)].root; };
  by_root.sort(executor, count, chunk_of(count), static_cast<std::uint32_t>(grid.count), root_of, root_of);
  std::vector<std::int64_t> ended_in(by_root.buckets(), 0);
  executor.for_range(static_cast<std::int64_t>(by_root.buckets()), 1, [&](std::int64_t bucket, std::int64_t) {
    std::vector<Member> members;
    for (const BucketSort::Entry& e : by_root[static_cast<std::size_t>(bucket)]) members.push_back(ended[e.element]);
    ended_in[static_cast<std::size_t>(bucket)] = take_in(grid, members, drops);
  });
  return std::accumulate(ended_in.begin(), ended_in.end(), std::int64_t{0});
}

MassBalance leave_trails(const parallel::Executor& executor, DropArrays& drops, const MergeUniforms& uniforms, Image& film) {
  return change_film(executor, uniforms, &drops, false, film);
}
MassBalance dry_film(const parallel::Executor& executor, const MergeUniforms& uniforms, Image& film) {
  return change_film(executor, uniforms, nullptr, true, film);
}

MassBalance Merger::run(const parallel::Executor& executor, DropArrays& drops, const MergeUniforms& uniforms, Image& film) {
  merge(executor, drops, uniforms);
  return change_film(executor, uniforms, &drops, true, film);
}

std::int64_t film_water(const Image& film) {
  std::int64_t sum = 0;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) sum += static_cast<std::int64_t>(film.row<float>(y)[x]);
  }
  return sum;
}

}  // namespace rainref::drops
