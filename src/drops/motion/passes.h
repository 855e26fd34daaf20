// The passes that move drops, as effects call them. Results depend neither on threads nor on the SIMD target. Each function that moves
// water between drops, film and outside returns the amounts in whole mass units (as-published: in drops).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "drops/drops.h"
#include "drops/motion/necks.h"
#include "drops/uniforms.h"
#include "rainref/executor.h"
#include "rainref/image.h"
#include "random/words.h"

namespace rainref::drops {

/// spawn, both variants: the step's arrivals, computed from integers and tables alone, without those beyond uniforms.room unless `all`.
/// Throws Error(port_files) if the uniforms and tables cannot belong together. executor: shares the work, or null. W: random::Words or
/// PerturbedWords.
template <class W = random::Words>
std::vector<Drop> arrivals_of(const SpawnUniforms& uniforms, std::span<const CountThreshold> thresholds, std::span<const SpawnMass> masses,
                              bool all = false, const parallel::Executor* executor = nullptr);
/// spawn: puts the arrivals into free slots, lowest first. corrected: MassBalance in mass units; as-published: in drops.
MassBalance spawn(const parallel::Executor& executor, DropArrays& drops, const SpawnUniforms& uniforms,
                  std::span<const CountThreshold> thresholds, std::span<const SpawnMass> masses, bool corrected);

/// integrate: live drops only. as-published, the MassBalance counts the drops whose life ends as removed.
MassBalance integrate(const parallel::Executor& executor, DropArrays& drops, const IntegrateUniforms& uniforms, const GlassFrame& glass,
                      bool corrected);

/// merge, corrected: touching drops merge, the film (r32f, whole mass units per texel) dries, and sliding drops leave trails on it. Keeps
/// its working memory between calls.
class Merger {
 public:
  Merger();
  ~Merger();
  /// The whole pass.
  MassBalance run(const parallel::Executor& executor, DropArrays& drops, const MergeUniforms& uniforms, Image& film);

  /// Its first part; water and momentum are kept. Returns how many drops merged into another one.
  /// Each drop points to the largest touching drop that is larger than itself (by mass; of equal ones the lower id is larger). The drop at
  /// the end of a chain takes all drops that lead to it, in ascending id, as long as it holds at most most_mass. The result depends on the
  /// ids alone, not on slots.
  std::int64_t merge(const parallel::Executor& executor, DropArrays& drops, const MergeUniforms& uniforms);

  /// necks, for the same drops and before merge. The next run() or merge() reuses its findings, so no drop may change in between. uniforms:
  /// of merge.
  void necks(const parallel::Executor& executor, DropArrays& drops, const MergeUniforms& uniforms, const NecksUniforms& necks_uniforms,
             Necks& necks);

 private:
  void find(const parallel::Executor& executor, DropArrays& drops, const MergeUniforms& uniforms);
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};
/// Its second part: every texel of the film loses uniforms.drying.
MassBalance dry_film(const parallel::Executor& executor, const MergeUniforms& uniforms, Image& film);
/// Its third part. Water of a texel above most_mass is removed.
MassBalance leave_trails(const parallel::Executor& executor, DropArrays& drops, const MergeUniforms& uniforms, Image& film);
/// Mass units in the film.
std::int64_t film_water(const Image& film);

}  // namespace rainref::drops
