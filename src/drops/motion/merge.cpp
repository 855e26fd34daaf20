#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>

#include "drops/motion/kernels.h"
#include "drops/motion/merge_grid.h"
#include "drops/motion/passes.h"
#include "drops/motion/scalar.h"

namespace rainref::drops {
namespace {

using F = scalar::Scalar<float>;

Drop drop_of(const scalar::DropState<F>& s, std::uint32_t id) {
  // + 0: stored zeros are positive.
  return {{s.u.v + 0.0f, s.v.v + 0.0f}, {s.velocity_u.v + 0.0f, s.velocity_v.v + 0.0f}, s.mass.v, s.life.v, id, 0};
}

/// A drop that ends: the end of its chain by its index in the grid, its own id and slot.
struct Member {
  std::uint32_t root, id, slot;
};

/// Prefetches a drop that is soon read and written.
void prefetch(DropArrays& drops, std::int64_t slot) {
  for (float* field :
       {drops.u().data(), drops.v().data(), drops.velocity_u().data(), drops.velocity_v().data(), drops.mass().data(), drops.life().data()})
    __builtin_prefetch(field + slot, 1);
  __builtin_prefetch(drops.id().data() + slot, 1);
}

/// Largest number of parts of work on these lists if each part scans all elements.
constexpr std::int64_t most_parts = 32;
template <class T>
std::size_t elements_of(const std::vector<std::vector<T>>& lists) {
  std::size_t count = 0;
  for (const std::vector<T>& list : lists) count += list.size();
  return count;
}
template <class T>
std::int64_t parts_of(const std::vector<std::vector<T>>& lists) {
  constexpr std::size_t least = 64;  // elements that are worth a task
  return std::clamp<std::int64_t>(static_cast<std::int64_t>(elements_of(lists) / least), 1, most_parts);
}

/// Indices [result[k], result[k + 1]) of the grid belong to part k. Each part has about the same number of chain ends, by counts of a
/// sample in blocks of indices, because drops crowd where a blade has pushed them.
std::vector<std::int64_t> places_of_parts(const std::vector<std::vector<Member>>& lists, std::int64_t places, std::int64_t parts) {
  constexpr std::size_t blocks = 1024, sampled = 8192;
  int shift = 0;
  while (static_cast<std::size_t>(places) >> shift > blocks) ++shift;
  const std::size_t step = elements_of(lists) / sampled + 1;
  std::array<std::int64_t, blocks + 1> in_block{};
  std::int64_t counted = 0;
  for (const std::vector<Member>& list : lists) {
    for (std::size_t i = 0; i < list.size(); i += step, ++counted) ++in_block[list[i].root >> shift];
  }
  std::vector<std::int64_t> first{0};
  std::int64_t before = 0;
  for (std::size_t block = 0; block < blocks && static_cast<std::int64_t>(first.size()) < parts; ++block) {
    before += in_block[block];
    const auto after_block = static_cast<std::int64_t>(block + 1) << shift;
    if (before * parts >= counted * static_cast<std::int64_t>(first.size())) first.push_back(std::min(after_block, places));
  }
  first.resize(static_cast<std::size_t>(parts), places);
  first.push_back(places);
  return first;
}

constexpr std::int64_t links_of_chunk = 256;

/// Merges ending drops into the drops in which their chains end. `members` holds all members of each of its chains. Returns the number of
/// merged drops.
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
      if (d.mass > most_mass - sum.mass.v) continue;  // exact, unlike the sum
      sum = scalar::absorb(sum, state_of<F>(d));
      drops.set(slot, {{d.position[0], d.position[1]}, {0, 0}, 0, 0, d.id, 0});
      ++ended;
    }
    drops.set(grid.slot[root], drop_of(sum, grid.id[root]));
  }
  return ended;
}

/// Changes the film: it dries, then receives the trails of drops that leave some.
MassBalance change_film(const parallel::Executor& executor, const MergeUniforms& uniforms, DropArrays* leaving, bool dries, Image& film) {
  const std::int64_t extent = leaving ? leaving->extent() : 0, chunk = chunk_of(extent);
  std::vector<std::vector<Deposit>> deposits(static_cast<std::size_t>((extent + chunk - 1) / chunk));
  executor.for_range(extent, chunk, [&](std::int64_t begin, std::int64_t end) {
    trail_range(uniforms, Slots(*leaving), begin, end, deposits[static_cast<std::size_t>(begin / chunk)]);
  });
  // A band of rows searches all deposits for its own.
  const bool is_drying = dries && uniforms.drying > 0;
  const std::int64_t bands = std::min<std::int64_t>(film.height(), is_drying ? most_parts : parts_of(deposits));
  std::vector<MassBalance> of_band(static_cast<std::size_t>(bands));
  executor.for_range(bands, 1, [&](std::int64_t band, std::int64_t) {
    MassBalance& balance = of_band[static_cast<std::size_t>(band)];
    const int first = static_cast<int>(film.height() * band / bands), last = static_cast<int>(film.height() * (band + 1) / bands);
    for (int y = first; y < last && is_drying; ++y) balance.evaporated += dry_row(uniforms, film.row<float>(y), film.width());
    balance.to_film = -balance.evaporated;
    for (const std::vector<Deposit>& some : deposits) {
      for (const Deposit& d : some) {
        if (d.row < first || d.row >= last) continue;
        float& texel = film.row<float>(d.row)[d.column];
        // Both are at most 2^24, so the room and the added water are exact: any order gives the same film.
        const float put = std::min(d.mass_units, most_mass - texel);
        texel += put;
        balance.to_film += static_cast<std::int64_t>(put);
        balance.removed += static_cast<std::int64_t>(d.mass_units - put);
      }
    }
  });
  MassBalance balance;
  for (const MassBalance& b : of_band) balance += b;
  return balance;
}

}  // namespace

struct Merger::Scratch {
  MergeGrid grid;
  std::vector<std::int32_t> larger;
  bool is_found = false;
};

Merger::Merger() : scratch_(std::make_unique<Scratch>()) {}
Merger::~Merger() = default;

/// The drop that each drop points to.
void Merger::find(const parallel::Executor& executor, DropArrays& drops, const MergeUniforms& uniforms) {
  MergeGrid& grid = scratch_->grid;
  grid.build(executor, drops, uniforms);
  std::vector<std::int32_t>& larger = scratch_->larger;
  larger.resize(std::max(larger.size(), static_cast<std::size_t>(grid.count)));
  executor.for_range(grid.count, links_of_chunk,
                     [&](std::int64_t begin, std::int64_t end) { find_larger_range(grid, begin, end, larger.data()); });
  scratch_->is_found = true;
}

void Merger::necks(const parallel::Executor& executor, DropArrays& drops, const MergeUniforms& uniforms,
                   const NecksUniforms& necks_uniforms, Necks& necks) {
  find(executor, drops, uniforms);
  const MergeGrid& grid = scratch_->grid;
  const std::vector<std::int32_t>& larger = scratch_->larger;
  const auto index = [](std::int64_t i) { return static_cast<std::size_t>(i); };
  std::vector<std::uint32_t> ended;
  struct Pair {
    std::uint32_t into;
    float mass;
    std::uint32_t id, slot;
  };
  std::vector<Pair> pairs;
  for (std::int64_t i = 0; i < grid.count; ++i) {
    const std::int32_t to = larger[index(i)];
    if (to < 0) continue;
    ended.push_back(grid.slot[index(i)]);
    if (larger[index(to)] < 0) pairs.push_back({grid.slot[index(to)], grid.mass[index(i)], grid.id[index(i)], grid.slot[index(i)]});
  }
  std::sort(ended.begin(), ended.end());
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& a, const Pair& b) { return std::tuple(a.into, -a.mass, a.id) < std::tuple(b.into, -b.mass, b.id); });
  std::vector<Joining> joining;
  for (const Pair& p : pairs)
    if (joining.empty() || joining.back().into != p.into) joining.push_back({p.into, p.slot});
  necks.step(drops, necks_uniforms, joining, ended);
}

std::int64_t Merger::merge(const parallel::Executor& executor, DropArrays& drops, const MergeUniforms& uniforms) {
  if (!scratch_->is_found) find(executor, drops, uniforms);
  scratch_->is_found = false;
  const MergeGrid& grid = scratch_->grid;
  std::vector<std::int32_t>& larger = scratch_->larger;

  // Ends of chains. Known parts of a chain shorten it for other threads, because every part leads to the same end. Uses compiler atomics,
  // because libc++ before 19 has no std::atomic_ref.
  const auto next = [&](std::int64_t i) { return &larger[static_cast<std::size_t>(i)]; };
  std::vector<std::vector<Member>> of_chunk(static_cast<std::size_t>((grid.count + links_of_chunk - 1) / links_of_chunk));
  executor.for_range(grid.count, links_of_chunk, [&](std::int64_t begin, std::int64_t end) {
    std::vector<Member>& ended = of_chunk[static_cast<std::size_t>(begin / links_of_chunk)];
    for (std::int64_t i = begin; i < end; ++i) {
      std::int32_t root = __atomic_load_n(next(i), __ATOMIC_RELAXED);
      if (root < 0) continue;
      for (std::int32_t beyond; (beyond = __atomic_load_n(next(root), __ATOMIC_RELAXED)) >= 0;) root = beyond;
      for (std::int64_t k = i; k != root;) k = __atomic_exchange_n(next(k), root, __ATOMIC_RELAXED);
      ended.push_back({static_cast<std::uint32_t>(root), grid.id[static_cast<std::size_t>(i)], grid.slot[static_cast<std::size_t>(i)]});
    }
  });
  // Each part takes the drops whose chains end in its share of the grid; scanning all of them is faster than sorting.
  const std::int64_t parts = parts_of(of_chunk);
  const std::vector<std::int64_t> places = places_of_parts(of_chunk, grid.count, parts);
  std::vector<std::int64_t> ended_in(static_cast<std::size_t>(parts), 0);
  executor.for_range(parts, 1, [&](std::int64_t part, std::int64_t) {
    const std::int64_t first = places[static_cast<std::size_t>(part)], last = places[static_cast<std::size_t>(part) + 1];
    std::vector<Member> members;
    for (const std::vector<Member>& some : of_chunk) {
      for (const Member& m : some)
        if (m.root >= first && m.root < last) members.push_back(m);
    }
    ended_in[static_cast<std::size_t>(part)] = take_in(grid, members, drops);
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
