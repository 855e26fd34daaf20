// A place of a pass text is one operation of its arithmetic, recognized in every invocation.
//
// A place is identified by its shape, a hash of the operation and of the origin of its operands, four operations deep. Operations of the
// same shape (the components of a vector, the rounds of a loop) are distinguished by their order in an invocation. So a place needs no
// names in the text, and is the same in every build.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace rainref::perturbed {

enum class Op : std::uint8_t {
  constant,  ///< a literal, a uniform or a member of a record
  load,      ///< a texel loaded by integer index
  fetch,     ///< a texel read by a lookup
  index,     ///< the element's own column
  sum,
  difference,
  negation,
  product,
  quotient,
  minimum,
  maximum,
  magnitude,
  root,
  square,
  floor,
  fract,
  exponential,
  exponential2,
  logarithm,
  power,
  sine,
  cosine,
  angle,
  mix,
  smoothstep,  ///< operands: x and the edges
  choice,      ///< operands: both sides of a select, and 1 or 0
  comparison,
  coordinate,  ///< of a lookup, in texels
  lookup,
  level,     ///< level of detail
  argument,  ///< a component of a vector argument of a named function
  bent,      ///< a refracted ray; operand: the ray before
  stored     ///< a channel of a result
};

/// How one mistake changes the operation at a place.
enum class PlaceFault : std::uint8_t {
  none,
  first,   ///< only the first operand; the other is left out
  second,  ///< only the second
  negated,
  second_negated,
  first_twice,
  second_twice,
  first_squared,
  second_squared,
  swapped,   ///< the operands exchanged
  inverted,  ///< multiplication for division and the reverse; the exponent of a power inverted
  other,     ///< a related function: cosine for sine, a linear ramp for smoothstep, rounding for floor, max for min
  doubled,
  halved,
  squared,
  rooted,
  linear,         ///< 1 + x instead of an exponential
  added,          ///< a + b t instead of a mix
  premultiplied,  ///< a (1 - t) + b instead of a mix
  in_gamma,       ///< a mix of numbers encoded by a power of 1/2.2, then decoded
  saturated,
  larger,  ///< the larger operand instead of a sum
  smaller,
  nearest,  ///< for a coordinate
  half_less,
  half_more,
  one_less,  ///< for a coordinate or a level
  one_more,
  zero,
  always,  ///< for a comparison
  never
};

/// Number of operations below a place that its shape covers. With fewer, the place matches wherever the text is equal to that depth, for
/// example if one function is called several times with different kinds of arguments.
constexpr std::int8_t whole_depth = 3;
/// A place identified by the operations just before it; in a loop it is the same in every round, whatever the origin of its values.
constexpr std::int8_t by_sequence = 4;

struct Place {
  std::uint32_t shape = 0;
  std::int32_t occurrence = -1;  ///< among operations of this shape in an invocation; -1: all
  PlaceFault fault = PlaceFault::none;
  std::int32_t seen = 0;  ///< number of this shape so far: 0 before each invocation
  std::int8_t depth = whole_depth;
};

/// How a value is changed before it replaces another.
enum class Change : std::uint8_t {
  none,
  negated,
  from_one,
  magnitude,
  squared,
  rooted,
  inverted,
  doubled,
  halved,
  floored,
  rounded,    ///< to the nearest integer
  truncated,  ///< truncated
  fraction,
  saturated,
  as_half,  ///< rounded to binary16
  cubed,
  smoothed  ///< x x (3 - 2 x)
};
/// How the value is used at the place.
enum class Put : std::uint8_t { instead, times, plus };

float changed(float value, Change change);
float put(float right, float value, Put how);

/// Replaces one operand at a place, or its result, by an earlier value of the invocation or by a number.
struct Substitution {
  std::uint32_t shape = 0;
  std::int32_t occurrence = -1;  ///< among operations of this shape in an invocation; -1: all
  std::int8_t operand = 0;       ///< result: the place itself
  std::uint32_t source = 0;      ///< shape of the source value
  std::int32_t back = 0;         ///< 1: the last source value, 2: the one before; 0: `number`
  float number = 0;
  Change change = Change::none;
  Put how = Put::instead;
  Change last = Change::none;  ///< change of the final result
  std::int32_t ahead = -1;     ///< index of `source` in the correct invocation, for a value that is computed later; -1: see `back`

  static constexpr std::int8_t result = -1;
};
/// The substitutions of one mistake, and their source values in an invocation.
struct Substitutions {
  std::vector<Substitution> all;
  std::vector<std::int32_t> seen = {};         ///< count of each place so far
  std::vector<std::vector<float>> met = {};    ///< values of each source, in order
  std::vector<std::vector<float>> right = {};  ///< values of each source in the correct invocation
  bool is_looking = false;                     ///< the correct invocation is being made, and nothing is changed

  /// True if a value is computed only later: then run() first makes the correct invocation.
  template <class Run>
  void look_ahead(const Run& run) {
    bool looks = false;
    for (const Substitution& s : all) looks |= s.ahead >= 0;
    right.assign(all.size(), {});
    if (!looks) return;
    is_looking = true;
    start();
    run();
    is_looking = false;
    start();
  }
  /// Call before each invocation.
  void start();
  void meet(std::uint32_t shape, float value);
  /// The value of substitution k, given the original value.
  float value_for(std::size_t k, float meant) const;
};

}  // namespace rainref::perturbed
