// Rewrites: operations of a pass text built from other values of the invocation, as a mistake in the order of steps does.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "math/places.h"

namespace rainref::perturbed {

enum class RewriteKind : std::uint8_t {
  none,
  part,        ///< an operand is an earlier part of the correct one
  over_all,    ///< a factor of one term multiplies the whole sum
  over_first,  ///< a factor of a sum multiplies only its first term
  over_second,
  function_of_all,    ///< a function of one term is applied to the whole sum
  function_of_first,  ///< a function of a sum is applied only to its first term
  function_of_second,
  commuted,          ///< an operation and that of its operand are exchanged: e clamp(x) for clamp(e x)
  commuted_outer_2,  ///< the same for two operations, both ends of a clamp, and the one below them
  commuted_inner_2,  ///< the same for an operation and the two below it
  first_wins,        ///< in a sequence of choices the first true one is kept, as if a loop ran backwards
  formula            ///< another formula of the operation's inputs
};

/// A step of a formula, in postfix order.
struct FormulaStep {
  enum class Kind : std::uint8_t {
    operation,  ///< applies `op` to the results of the last steps
    part,       ///< the operand at the end of `path` from the place: an operand, an operand of that, ...; -1 ends it
    number,
    itself,  ///< the original result of the place
    met      ///< the value of a shape met `back` times ago
  };
  Kind kind = Kind::operation;
  Op op = Op::sum;
  std::array<std::int8_t, 6> path{-1, -1, -1, -1, -1, -1};
  float number = 0;
  std::uint32_t shape = 0;
  std::int32_t back = 1;
};
using Formula = std::vector<FormulaStep>;

/// Requires Behaviour::trace, which holds the earlier values.
struct Rewrite {
  RewriteKind kind = RewriteKind::none;
  std::uint32_t shape = 0;                  ///< of the place, see Place::shape
  std::int32_t occurrence = -1;             ///< among operations of this shape in an invocation; -1: all
  std::int8_t operand = 0;                  ///< the operand that is changed; for ..._all the term, for ..._first and ..._second the sum
  std::array<std::int8_t, 2> path{-1, -1};  ///< for part: an operand of the operand, and an operand of that; for over_all [0]: the factor;
                                            ///< for commuted [0]: the operand of the inner operation that the outer one takes
  std::int32_t period = 0;                  ///< for occurrence: all that follow at multiples of this distance; 0: only that one
  const Formula* formula = nullptr;         ///< for formula; owned by the maker of the rewrite
  std::int8_t depth = whole_depth;          ///< see Place::depth
};

/// One rewrite, or those of the components of a vector; the first of kind none ends the list.
using Rewrites = std::array<Rewrite, 7>;

/// Sets the rewrites of the calling thread for a scope.
class RewriteScope {
 public:
  explicit RewriteScope(const Rewrites& r);
  ~RewriteScope();
  RewriteScope(const RewriteScope&) = delete;
  RewriteScope& operator=(const RewriteScope&) = delete;

 private:
  Rewrites saved_;
};

}  // namespace rainref::perturbed
