// The freedom of a conforming GPU in each operation, as rules by which an enclosure widens.
//
// The values used by rainref, each with its source, are in the data files src/judge/profiles/*.toml. Their
// keys are the members of Profile; an Accuracy is a table.
#pragma once

#include <cstdint>
#include <string>

namespace rainref::enclosed {

/// Largest distance of a result from the exact value y of a function at x:
///   ulp ULP(y) + ulp_per_x |x| ULP(y) + relative |y| + absolute,
/// where ULP(y) is the gap between the floats around y (the larger one at a power of two). Without an absolute part the error does not move
/// a result across zero, because no formula for x / y changes its sign. All zero: to nearest even.
struct Accuracy {
  double ulp = 0, ulp_per_x = 0, relative = 0, absolute = 0;
  bool is_zero() const { return ulp == 0 && ulp_per_x == 0 && relative == 0 && absolute == 0; }
};

enum class BasicRounding : std::uint8_t {
  nearest,  ///< + - * round to nearest even
  either    ///< + - * may give either neighbour of an inexact result
};
enum class Flush : std::uint8_t {
  never,
  may,  ///< any subnormal operand or result may be treated as zero
  must  ///< as may: a device that must flush need not flush when it moves data
};
/// How a compiler may change sums and products (rearranged.h). `expanded` is more than any compiler was seen to do: it is used to describe
/// a failure.
enum class Rearrangement : std::uint8_t {
  none,
  reassociated,  ///< sums in any order; a product of sums is unchanged
  distributed,   ///< a factor may move into a sum and out of it; products of two sums are not multiplied out
  expanded       ///< any change that is an equality in real arithmetic after multiplying out
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
/// How a store may round a value between two codes. `either` allows both neighbours.
enum class StoreRounding : std::uint8_t { rne, rtz, either };
/// Result of storing a value above the largest finite half. `either` allows both.
enum class StoreOverflow : std::uint8_t { inf, max, either };

struct Profile {
  std::string name = "ieee";
  /// Every operation gives the reference's bits: points stay points, and only the last five members apply.
  bool reference = true;

  BasicRounding basic = BasicRounding::nearest;
  /// A product may be added before it is rounded (FMA contraction).
  bool contraction = false;
  Flush flush = Flush::never;
  Rearrangement rearrangement = Rearrangement::none;
  std::string rearrangement_remedy;  ///< how a port prevents it, a clause; "": unknown

  Accuracy division, sqrt, inverse_sqrt;
  bool sqrt_is_inherited = false;  ///< sqrt is 1 / inverse_sqrt; `sqrt` is unused
  Accuracy exp, exp2;
  Accuracy log, log2;                    ///< for x outside [1/2, 2]
  Accuracy log_near_one, log2_near_one;  ///< for x in [1/2, 2]
  Accuracy pow;
  bool pow_is_inherited = false;  ///< pow is exp2(y log2 x); `pow` is unused
  Accuracy sin_cos;               ///< for |x| <= sin_cos_domain
  double sin_cos_domain = 0;      ///< 0: every float
  double sin_cos_beyond = 0;      ///< error per unit of |x| beyond the domain, by convention; 0: nothing is guaranteed
  Accuracy atan2;
  /// The accuracy of atan2(y, x) is guaranteed for |x| in [1 / this, this] and y finite and normal, and not elsewhere; 0: everywhere.
  double atan2_domain = 0;

  /// Fractional bits of the coordinate of a filtered lookup; 0: filters use ordinary arithmetic.
  int subtexel_bits = 0;
  /// Significant bits of a sampler's coordinate; 0: as a float.
  int coordinate_bits = 0;
  int lod_bits = 0;  ///< fractional bits of a level of detail; 0: exact

  Accuracy unorm_load;  ///< of code / 255
  StoreRounding half_store = StoreRounding::rne;
  StoreOverflow half_overflow = StoreOverflow::inf;
  bool half_store_flush = false;  ///< a store may write 0 for a subnormal half; loads keep it
  double unorm_store_ulp = 0;     ///< largest distance of a stored code from 255 x [codes]; 0: as the reference stores
  double srgb_store_ulp = 0;      ///< the same for 255 encode_srgb(x)
};

/// True if a profile guarantees anything about atan2(y, x).
inline bool is_promised(const Profile& p, double y, double x) {
  const double height = y < 0 ? -y : y, width = x < 0 ? -x : x;
  return p.atan2_domain == 0 || (height >= 0x1p-126 && height < 0x1p128 && width * p.atan2_domain >= 1 && width <= p.atan2_domain);
}

/// The profile `ieee`, also used outside every scope.
inline const Profile reference_profile;

}  // namespace rainref::enclosed
