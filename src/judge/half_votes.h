// Infers from the outputs of a port's passes how the port rounds its stores to binary16. The whole port rounds in one way.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "judge/verdict.h"

namespace rainref::judge {

/// Failing invocations of a pass under each rounding that it was judged by. Fewer than two roundings: it stores no halves, or their
/// rounding is known.
struct HalfVotes {
  std::string pass;
  std::vector<HalfMode> modes;  ///< the same two, or two and `either`, for every pass that votes
  std::vector<std::int64_t> failing;
  /// The pass also rounds to binary16 between its operations, in the shader or a blending unit, which need not round like stores. It is
  /// judged by the rounding that it fits and has no vote.
  bool rounds_inside = false;
  /// For each mode, invocations that may also fail: they were not tested under it, because another mode holds them. Empty: none.
  std::vector<std::int64_t> undecided = {};
  /// For each mode, how many of some hundreds of invocations are inside without computing an envelope; nearly all of these have the
  /// reference's bits. Empty: none.
  std::vector<std::int64_t> with_bits = {};

  std::int64_t most(std::size_t mode) const { return failing[mode] + (undecided.empty() ? 0 : undecided[mode]); }
  /// True if it is known whether any invocation fails.
  bool is_known(std::size_t mode) const { return failing[mode] > 0 || most(mode) == 0; }
  /// True if every invocation is known under every mode.
  bool is_whole() const;
};

/// Returns the rounding under which fewest passes fail. If equal, the one with clearly more HalfVotes::with_bits; else the first, unless
/// the second has a tenth fewer failing invocations. If nothing fails under either, the one with more with_bits.
HalfMode port_rounding(const std::vector<HalfVotes>& passes);

/// True if a pass fails under both roundings.
bool fails_by_each(const HalfVotes& pass);
/// True if a pass fails under every rounding and nothing tells which one the port uses: none of the passes fits only one of them, and
/// neither clearly has more HalfVotes::with_bits.
bool is_rounding_open(const std::vector<HalfVotes>& passes);

/// The rounding that a pass is judged by, and a doubt about it.
struct FoundRounding {
  std::size_t mode = 0;  ///< index in HalfVotes::modes
  std::string doubt;     ///< "": none
};
/// Returns the port's rounding if the pass fits it; else the other, or a mixture, if it fits that; else the port's, or for a pass that
/// rounds inside the one with fewest failures. `asked`: what the profile requires, or `either`.
FoundRounding pass_rounding(const HalfVotes& pass, const std::vector<HalfVotes>& passes, HalfMode asked, const std::string& profile);

/// Returns a pass whose undecided invocations could change a result of the functions above for any of these passes, or its number of
/// failures under the found rounding. Nothing: the results are final.
std::optional<std::size_t> first_undecided(const std::vector<HalfVotes>& passes, HalfMode asked);

}  // namespace rainref::judge
