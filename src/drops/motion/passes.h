// The passes that move drops, as an effect calls them. Results depend on neither threads nor SIMD target. Each function
// that moves water between drops, film and outside says so in whole mass units (as-published: in drops).
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

/// spawn, both variants: the step's arrivals, from integers and tables alone, without those beyond uniforms.room unless
/// `all`. Throws Error(port_files) when the uniforms and tables cannot belong together. executor: shares the work, or null.
/// W: random::Words or PerturbedWords.
template <class W = random::Words>
std::vector<Drop> arrivals_of(const SpawnUniforms& uniforms, std::span<const CountThreshold> thresholds, std::span<const SpawnMass> masses,
                              bool all = false, const parallel::Executor* executor = nullptr);
/// spawn: puts the arrivals into free slots, lowest first. corrected: MassBalance in mass units; as-published: in drops.
MassBalance spawn(const parallel::Executor& executor, DropArrays& drops, const SpawnUniforms& uniforms,
                  std::span<const CountThreshold> thresholds, std::span<const SpawnMass> masses, bool corrected);

/// integrate: live drops only. as-published the MassBalance counts the drops whose life ends, as removed.
MassBalance integrate(const parallel::Executor& executor, DropArrays& drops, const IntegrateUniforms& uniforms, const GlassFrame& glass,
                      bool corrected);

/// merge, corrected: drops that touch become one, the film (r32f, whole mass units in a texel) dries, and sliding drops leave
/// trails on it. Keeps its working memory between calls.
class Merger {
 public:
  Merger();
  ~Merger();
  /// The whole pass.
  MassBalance run(const parallel::Executor& executor, DropArrays& drops, const MergeUniforms& uniforms, Image& film);

  /// Its first part; water and momentum are kept. Returns how many drops ended in another one.
  /// Each drop points to the touching drop that is the largest of those larger than itself (by mass; of equal ones the
  /// lower id is the larger), and the drop at the end of the chain takes all that lead to it, in ascending id, as long as
  /// it holds no more than most_mass. The result depends on the ids alone, not on slots.
  std::int64_t merge(const parallel::Executor& executor, DropArrays& drops, const MergeUniforms& uniforms);

  /// necks, of the same drops and before it: what is found out of them serves the next run() or merge() too, before which no drop may
  /// change. uniforms: of merge.
  void necks(const parallel::Executor& executor, DropArrays& drops, const MergeUniforms& uniforms, const NecksUniforms& necks_uniforms,
             Necks& necks);

 private:
  void find(const parallel::Executor& executor, DropArrays& drops, const MergeUniforms& uniforms);
  struct Scratch;
  std::unique_ptr<Scratch> scratch_;
};
/// Its second part: every texel of the film loses uniforms.drying.
MassBalance dry_film(const parallel::Executor& executor, const MergeUniforms& uniforms, Image& film);
/// Its third part. What a texel cannot hold beyond most_mass is removed.
MassBalance leave_trails(const parallel::Executor& executor, DropArrays& drops, const MergeUniforms& uniforms, Image& film);
/// Mass units that the film holds.
std::int64_t film_water(const Image& film);

}  // namespace rainref::drops
