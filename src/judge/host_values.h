// What a host gives a pass, against what the scene says: uniforms, pictures and records that no pass computed.
//
// rainref computes them in double and rounds once; a host may compute in float. A value of k operations is then off by k 2^-24 of its
// largest term, to first order. Sixteen operations, and terms four times as large as what is left of them, are 2^-18: no uniform here
// takes more. A buffer of fewer bits stores such a value as either neighbour.
#pragma once

#include <cstddef>
#include <cstdint>

#include "capture/array.h"
#include "scene/uniform_block.h"

namespace rainref::judge {

enum class Likeness : std::uint8_t {
  same,
  rounded,  ///< as near as a host that computes in float comes
  other
};

/// Of the largest component of a vector, which rotations and differences mix.
inline constexpr double host_share = 0x1p-18;
/// Where a member may be negative its zero is a place as any other: cos(pi / 2) in float is -2^-24.5. Of 1, or of a smaller declared range.
inline constexpr double host_floor = 0x1p-22;

/// One member of a block or record, at its offset in both. Integers are the same or other.
Likeness compare_member(const scene::Member& member, const std::byte* expected, const std::byte* given);
/// The worst of all values. Records that have ids may come in any order. For an empty list an API may have to bind a record: of zeros.
Likeness compare_arrays(const capture::Array& expected, const capture::Array& given);

}  // namespace rainref::judge
