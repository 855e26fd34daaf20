// How a port rounds its stores to binary16: one way for the whole port, found by what its passes stored.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "judge/verdict.h"

namespace rainref::judge {

/// Failing invocations of a pass under each rounding that it was judged by. Fewer than two: it stores no halves, or
/// their rounding is settled.
struct HalfVotes {
  std::string pass;
  std::vector<HalfMode> modes;  ///< the same two, or two and `either`, of every pass that votes
  std::vector<std::int64_t> failing;
  /// The pass rounds to binary16 between its operations, too, in the shader or a blending unit, which need not round as stores do:
  /// it is judged by the way that it fits and has no vote.
  bool rounds_inside = false;
  /// Of each mode the invocations that may fail besides: they were not asked about under it, because another mode holds them. Empty: none.
  std::vector<std::int64_t> undecided = {};
  /// How many of some hundreds of invocations are found inside without an envelope, by each mode: nearly all of these store what the
  /// reference does. Empty: none.
  std::vector<std::int64_t> with_bits = {};

  std::int64_t most(std::size_t mode) const { return failing[mode] + (undecided.empty() ? 0 : undecided[mode]); }
  /// Whether it is known if any fails.
  bool is_known(std::size_t mode) const { return failing[mode] > 0 || most(mode) == 0; }
  /// Whether every invocation is known under every mode.
  bool is_whole() const;
};

/// The rounding under which fewest passes fail. Of equals the one that clearly has more HalfVotes::with_bits; else the first, unless the
/// second has a tenth fewer failing invocations. Where nothing fails under either, the one with more of these bits.
HalfMode port_rounding(const std::vector<HalfVotes>& passes);

/// Whether a pass fails under both roundings.
bool fails_by_each(const HalfVotes& pass);
/// Whether a pass fails under every rounding and nothing tells which one is the port's: none of these passes can be stored by one of them
/// alone, and neither clearly has more HalfVotes::with_bits.
bool is_rounding_open(const std::vector<HalfVotes>& passes);

/// The rounding that a pass is judged by, and what is to be said of it.
struct FoundRounding {
  std::size_t mode = 0;  ///< of HalfVotes::modes
  std::string doubt;     ///< "": none
};
/// The port's where the pass fits it; else the other, or a mixture, where it fits that; else the port's. A pass that rounds inside: else
/// that with fewest failures.
/// `asked`: what the profile asks for, or `either`.
FoundRounding pass_rounding(const HalfVotes& pass, const std::vector<HalfVotes>& passes, HalfMode asked, const std::string& profile);

/// A pass whose undecided invocations could change what the functions above give for any of these passes, or the number of its failures by
/// the rounding that is found. Nothing: what they give holds.
std::optional<std::size_t> first_undecided(const std::vector<HalfVotes>& passes, HalfMode asked);

}  // namespace rainref::judge
