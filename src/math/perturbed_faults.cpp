// What each fault is called, and what to look for in a port that has it.
#include "math/perturbed.h"

namespace rainref::perturbed {

const std::vector<FaultInfo>& faults() {
  static const std::vector<FaultInfo> all{
      {Fault::fused, "fused multiply-add", "products are fused with the addition that follows"},
      {Fault::reciprocal_division, "division by reciprocal", "a / b is computed as a * (1 / b)"},
      {Fault::root_by_inverse, "root by inverse root", "sqrt(x) is computed as 1 / inversesqrt(x)"},
      {Fault::flushed, "subnormals flushed", "subnormal results become zero"},
      {Fault::mix_by_difference, "mix as a + (b - a) t", "mix is computed by the difference, not as a (1 - t) + b t"},
      {Fault::sum_backwards, "sum backwards", "sums are added from the last term to the first"},
      {Fault::sum_otherwise_paired, "sum paired otherwise", "sums are added in other pairs"},
      {Fault::division_by_estimate, "division by estimate", "1 / b is an estimate, one ULP off"},
      {Fault::half_intermediates, "half intermediates", "intermediate results have half precision (min16float, mediump, half)"},
      {Fault::half_constants, "half constants", "literals and uniforms have half precision"},
      {Fault::strict_for_weak, "> for >=", "a comparison with equality is strict (or < for <=)"},
      {Fault::weak_for_strict, ">= for >", "a strict comparison includes equality (or <= for <)"},
      {Fault::truncated_floor, "truncation for floor", "floor of a negative number is cut toward zero, as int() does"},
      {Fault::rounded_floor, "rounding for floor", "an index is rounded to nearest instead of down"},
      {Fault::fract_by_truncation, "fract by truncation", "fract of a negative number is negative, as fmod's is"},
      {Fault::minimum_missing, "upper clamp missing", "a min() or the upper end of a clamp is missing"},
      {Fault::maximum_missing, "lower clamp missing", "a max() or the lower end of a clamp is missing"},
      {Fault::abs_missing, "abs missing", "an abs() is missing"},
      {Fault::normalize_missing, "normalize missing", "a vector is not normalized"},
      {Fault::smoothstep_linear, "linear for smoothstep", "smoothstep is a linear ramp"},
      {Fault::root_missing, "root missing", "a squared length is taken for the length"},
      {Fault::square_missing, "square missing", "a number is taken for its square"},
      {Fault::refract_ratio_inverted, "refraction ratio inverted", "refract() gets n2 / n1 instead of n1 / n2"},
      {Fault::reflect_doubled_missing, "factor 2 of reflect missing", "reflect is v - (n.v) n"},
      {Fault::exp_base_two, "exp2 for exp", "an exponential has base 2 instead of e"},
      {Fault::exp2_base_e, "exp for exp2", "an exponential has base e instead of 2"},
      {Fault::pow_squared, "square for pow", "a power is approximated by a square"},
      {Fault::mix_swapped, "mix ends swapped", "mix has its ends swapped"},
      {Fault::atan2_swapped, "atan2 arguments swapped", "atan2 gets (x, y)"},
      {Fault::degrees, "degrees for radians", "an angle in radians is taken for degrees"},
      {Fault::address_clamped, "clamp address mode", "a texture that repeats is clamped"},
      {Fault::address_repeated, "repeat address mode", "a texture that is clamped repeats"},
      {Fault::address_mirrored, "mirror address mode", "a texture is mirrored at its edges"},
      {Fault::nearest_filter, "nearest for linear", "a texture is filtered by the nearest texel"},
      {Fault::weights_of_8_bits, "8-bit filter weights", "a texture unit filters with weights of 8 bits"},
      {Fault::half_texel_missing, "half texel missing", "texel centres are taken at k instead of k + 1/2"},
      {Fault::half_texel_twice, "half texel twice", "the half texel is taken off twice"},
      {Fault::texel_after, "one texel off", "a lookup is one texel off"},
      {Fault::level_above, "mip level above", "the mip level is one too coarse"},
      {Fault::level_below, "mip level below", "the mip level is one too fine"},
  };
  return all;
}

}  // namespace rainref::perturbed
