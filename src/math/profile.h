// What a conforming GPU may do with a number: the rules by which an enclosure widens.
//
// The values that rainref judges by, each with its source, are the data files src/judge/profiles/*.toml. Their
// keys are the members of Profile; an Accuracy is a table.
#pragma once

#include <cstdint>
#include <string>

namespace rainref::enclosed {

/// How far a result may lie from the exact value y of a function at x:
///   ulp ULP(y) + ulp_per_x |x| ULP(y) + relative |y| + absolute,
/// where ULP(y) is the gap between the floats around y (the larger one at a power of two). Without an absolute part the
/// error does not take a result over zero: no formula for x / y changes its sign. All zero: to nearest even.
struct Accuracy {
  double ulp = 0, ulp_per_x = 0, relative = 0, absolute = 0;
  bool is_zero() const { return ulp == 0 && ulp_per_x == 0 && relative == 0 && absolute == 0; }
};

enum class BasicRounding : std::uint8_t {
  nearest,  ///< + - * round to nearest even
  either    ///< + - * may give either float beside an inexact result
};
enum class Flush : std::uint8_t {
  never,
  may,  ///< any subnormal operand or result may count as zero
  must  ///< as may: where a device must flush, moving data must not
};
/// What a compiler may make of sums and products (rearranged.h). `expanded` is more than any was seen to do: it words a failure.
enum class Rearrangement : std::uint8_t {
  none,
  reassociated,  ///< sums in any order; a product of sums stays as it is
  distributed,   ///< a factor may move into a sum and out of it; products of two sums are not multiplied out
  expanded       ///< anything that real arithmetic makes equal by multiplying out
};
inline const char* name(Rearrangement r) {
  switch (r) {
    case Rearrangement::reassociated:
      return "reassociated";
    case Rearrangement::distributed:
      return "distributed";
    case Rearrangement::expanded:
      return "expanded";
    default:
      return "none";
  }
}
/// What a store may do with a value between two codes. `either` is the set of both neighbours.
enum class StoreRounding : std::uint8_t { rne, rtz, either };
/// What a store may make of a value beyond the largest finite half. `either` is the set of both.
enum class StoreOverflow : std::uint8_t { inf, max, either };

struct Profile {
  std::string name = "ieee";
  /// Every operation gives the reference's bits: points stay points, and no other member counts but the last five.
  bool reference = true;

  BasicRounding basic = BasicRounding::nearest;
  /// A product may reach the addition that takes it before it is rounded (FMA contraction).
  bool contraction = false;
  Flush flush = Flush::never;
  Rearrangement rearrangement = Rearrangement::none;
  std::string rearrangement_remedy;  ///< how a port forbids it, a clause; "": nothing is known

  Accuracy division, sqrt, inverse_sqrt;
  bool sqrt_is_inherited = false;  ///< sqrt is 1 / inverse_sqrt; `sqrt` does not count
  Accuracy exp, exp2;
  Accuracy log, log2;                    ///< for x outside [1/2, 2]
  Accuracy log_near_one, log2_near_one;  ///< for x in [1/2, 2]
  Accuracy pow;
  bool pow_is_inherited = false;  ///< pow is exp2(y log2 x); `pow` does not count
  Accuracy sin_cos;               ///< for |x| <= sin_cos_domain
  double sin_cos_domain = 0;      ///< 0: every float
  double sin_cos_beyond = 0;      ///< error for each unit of |x| beyond the domain, by convention; 0: nothing is promised
  Accuracy atan2;
  /// atan2(y, x) is promised for |x| in [1 / this, this] and y finite and normal, and nothing elsewhere; 0: it is everywhere.
  double atan2_domain = 0;

  /// Fractional bits of the coordinate of a filtered lookup; 0: filters are computed like any other arithmetic.
  int subtexel_bits = 0;
  /// Significant bits with which a sampler takes a coordinate; 0: as many as a float has.
  int coordinate_bits = 0;
  int lod_bits = 0;  ///< fractional bits of a level of detail; 0: exact

  Accuracy unorm_load;  ///< of code / 255
  StoreRounding half_store = StoreRounding::rne;
  StoreOverflow half_overflow = StoreOverflow::inf;
  bool half_store_flush = false;  ///< a store may leave 0 of a subnormal half; loads keep it
  double unorm_store_ulp = 0;     ///< distance from 255 x that a stored code may have [codes]; 0: as the reference stores
  double srgb_store_ulp = 0;      ///< the same for 255 encode_srgb(x)
};

/// Whether a profile promises anything of atan2(y, x).
inline bool is_promised(const Profile& p, double y, double x) {
  const double height = y < 0 ? -y : y, width = x < 0 ? -x : x;
  return p.atan2_domain == 0 || (height >= 0x1p-126 && height < 0x1p128 && width * p.atan2_domain >= 1 && width <= p.atan2_domain);
}

/// The profile `ieee`, also the one in force outside every scope.
inline const Profile reference_profile;

}  // namespace rainref::enclosed
