// Places of a pass text whose operation is made of other values of the invocation: what a mistake in the order of steps does.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "math/places.h"

namespace rainref::perturbed {

enum class RewriteKind : std::uint8_t {
  none,
  part,        ///< an operand is a part of what it should be: the value of before
  over_all,    ///< a factor of one term multiplies the whole sum
  over_first,  ///< a factor of a sum multiplies its first term alone
  over_second,
  function_of_all,    ///< a function of one term is taken of the whole sum
  function_of_first,  ///< a function of a sum is taken of its first term alone
  function_of_second,
  commuted,          ///< an operation and the one of its operand are done in the other order: e clamp(x) for clamp(e x)
  commuted_outer_2,  ///< likewise two operations, both ends of a clamp, and the one below them
  commuted_inner_2,  ///< likewise an operation and the two below it
  first_wins,        ///< of choices that follow each other the first that holds stays: a loop runs the other way
  formula            ///< another formula of what the operation is made of
};

/// A step of a formula, in postfix order.
struct FormulaStep {
  enum class Kind : std::uint8_t {
    operation,  ///< `op` of what the last steps gave
    part,       ///< the operand at the end of `path` from the place: which operand, which of that, ...; -1 ends it
    number,
    itself,  ///< what the place gives as it is
    met      ///< what was met `back` times ago of a shape
  };
  Kind kind = Kind::operation;
  Op op = Op::sum;
  std::array<std::int8_t, 6> path{-1, -1, -1, -1, -1, -1};
  float number = 0;
  std::uint32_t shape = 0;
  std::int32_t back = 1;
};
using Formula = std::vector<FormulaStep>;

/// It needs Behaviour::trace, where the values of before stand.
struct Rewrite {
  RewriteKind kind = RewriteKind::none;
  std::uint32_t shape = 0;                  ///< of the place, as Place::shape
  std::int32_t occurrence = -1;             ///< of this shape in an invocation; -1: each
  std::int8_t operand = 0;                  ///< which one is other; of ..._all the term, of ..._first and ..._second the sum
  std::array<std::int8_t, 2> path{-1, -1};  ///< of part: which operand of the operand, and which of that; of over_all [0]: the factor;
                                            ///< of commuted [0]: the operand of the inner one that the outer one takes
  std::int32_t period = 0;                  ///< of occurrence: each one that is so many on; 0: that one alone
  const Formula* formula = nullptr;         ///< of formula: whoever makes the rewrite keeps it
  std::int8_t depth = whole_depth;          ///< as Place::depth
};

/// One rewrite, or those of the components of a vector: the first of kind none ends them.
using Rewrites = std::array<Rewrite, 7>;

/// Sets those of the calling thread for a scope.
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
