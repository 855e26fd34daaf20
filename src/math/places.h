// Places of a pass text: one operation of its arithmetic, found again at every invocation.
//
// A place is known by its shape, a hash of the operation and what its operands are made of, four operations deep; operations
// of one shape (the components of a vector, the rounds of a loop) are told apart by their order in an invocation. So a place
// needs no names in the text, and is the same in every build.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace rainref::perturbed {

enum class Op : std::uint8_t {
  constant,  ///< a literal, a uniform or a member of a record
  load,      ///< a texel loaded by integers
  fetch,     ///< a texel of a lookup
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
  smoothstep,  ///< of x and the edges
  choice,      ///< of both sides of a select, and 1 or 0
  comparison,
  coordinate,  ///< of a lookup, in texels
  lookup,
  level,     ///< of detail
  argument,  ///< a component of a vector that a named function of several is given
  bent,      ///< of a refracted ray, and the same of the ray before
  stored     ///< what a channel of a result is given
};

/// What one mistake makes of the operation at a place.
enum class PlaceFault : std::uint8_t {
  none,
  first,   ///< the first operand alone: the other is left out
  second,  ///< the second alone
  negated,
  second_negated,
  first_twice,
  second_twice,
  first_squared,
  second_squared,
  swapped,   ///< the operands exchanged
  inverted,  ///< multiplied for divided and the reverse; a power's exponent inverted
  other,     ///< the function beside it: cosine for sine, a linear ramp for smoothstep, rounding for floor, max for min
  doubled,
  halved,
  squared,
  rooted,
  linear,         ///< 1 + x for an exponential
  added,          ///< a + b t for a mix
  premultiplied,  ///< a (1 - t) + b for a mix
  in_gamma,       ///< a mix of numbers encoded by a power of 1/2.2, decoded again
  saturated,
  larger,  ///< the larger operand for a sum
  smaller,
  nearest,  ///< of a coordinate
  half_less,
  half_more,
  one_less,  ///< of a coordinate, a level
  one_more,
  zero,
  always,  ///< of a comparison
  never
};

/// How many operations below it the shape of a place sees; with fewer it is found wherever a text looks alike so far down, as where
/// a function of it is called several times with arguments of other kinds.
constexpr std::int8_t whole_depth = 3;
/// A place known by the operations that were done just before it: of a loop the same in every round, whatever its values came from.
constexpr std::int8_t by_sequence = 4;

struct Place {
  std::uint32_t shape = 0;
  std::int32_t occurrence = -1;  ///< of this shape in an invocation; -1: each
  PlaceFault fault = PlaceFault::none;
  std::int32_t seen = 0;  ///< of this shape so far: 0 before each invocation
  std::int8_t depth = whole_depth;
};

/// What becomes of a value before it stands in place of another.
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
  rounded,    ///< to the nearest whole number
  truncated,  ///< toward zero
  fraction,
  saturated,
  as_half,  ///< rounded to binary16
  cubed,
  smoothed  ///< x x (3 - 2 x)
};
/// How it is put there.
enum class Put : std::uint8_t { instead, times, plus };

float changed(float value, Change change);
float put(float right, float value, Put how);

/// Another value for one operand at a place, or for its result: one that was met before in the invocation, or a number.
struct Substitution {
  std::uint32_t shape = 0;
  std::int32_t occurrence = -1;  ///< of this shape in an invocation; -1: each
  std::int8_t operand = 0;       ///< result: of the place itself
  std::uint32_t source = 0;      ///< shape of what was met
  std::int32_t back = 0;         ///< the last one of it is 1, the one before 2; 0: `number`
  float number = 0;
  Change change = Change::none;
  Put how = Put::instead;
  Change last = Change::none;  ///< of all of it
  std::int32_t ahead = -1;     ///< which one of `source` in the invocation as it should be, of what is met only later; -1: see `back`

  static constexpr std::int8_t result = -1;
};
/// Those of one mistake, and what is met for them in an invocation.
struct Substitutions {
  std::vector<Substitution> all;
  std::vector<std::int32_t> seen = {};         ///< of each place so far
  std::vector<std::vector<float>> met = {};    ///< of each source, in order
  std::vector<std::vector<float>> right = {};  ///< of each source, in the invocation as it should be
  bool is_looking = false;                     ///< that invocation is made: nothing is changed in it

  /// Whether a value is met only later: then the invocation is made as it should be first, by run().
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
  /// Before each invocation.
  void start();
  void meet(std::uint32_t shape, float value);
  /// The value for number k, given what should stand there.
  float value_for(std::size_t k, float meant) const;
};

/// What an invocation did, in order.
struct Trace {
  struct Node {
    Op op;
    float value;
    std::uint32_t shape;
    std::int32_t occurrence;
    std::array<std::int32_t, 4> of{-1, -1, -1, -1};  ///< nodes; -1: none, or a number of unknown origin
    std::array<float, 4> with{};                     ///< the operands themselves
    std::array<std::uint32_t, 2> shallow{};          ///< shapes one and two operations deep
    std::uint32_t sequence = 0;                      ///< of the last operations up to it
  };
  std::vector<Node> nodes;
  std::map<std::uint32_t, std::int32_t> met;  ///< of each shape so far
};

}  // namespace rainref::perturbed
