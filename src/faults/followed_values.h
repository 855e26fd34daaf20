// Values of traced invocations, operation by operation: of the reference, of the reference with a mistake, and of a port.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "faults/shader_line.h"

namespace rainref::faults {

/// The sorted values of one operation in each invocation. A loop gives many, and two programs may loop over different rounds.
using Values = std::vector<std::vector<float>>;

/// True if two values are equal up to the rounding of different implementations.
bool agree(float a, float b);
/// True if `all` contains the values of `some` in every invocation where `some` has any.
bool is_within(const Values& some, const Values& all);
/// The same in the invocations where both have values; both must have some in most of those of the first.
bool is_met_by(const Values& some, const Values& all);
/// True if the values are informative: a number that is equal in every invocation can match by chance.
bool varies(const Values& v);
/// True if a match among many others is unlikely to be chance: at least two values are not integers.
bool tells(const Values& v);

/// Finds operations by their values.
class ByValue {
 public:
  explicit ByValue(std::size_t invocations) : sorted_(invocations) {}
  void add(const Values& v, int number);
  void sort();
  /// Returns the operations with about this value in an invocation, in order of their numbers.
  std::vector<int> near(std::size_t invocation, float v) const;

 private:
  std::vector<std::vector<std::pair<float, int>>> sorted_;
};

/// The values of an operation's operands.
using Operands = std::vector<Values>;
/// True if two comparisons have the same operands, in either order.
bool is_same_comparison(const Operands& a, const Operands& b);

/// An operation of the reference that a mistake changes, or an operand that it replaces.
struct ChangedValues {
  Values values;      ///< with the mistake, where it changes them
  Operands operands;  ///< of the operation then; empty for an operand
  /// If it is a decision that differs although what it decides between does not: its comparison's operands.
  Operands decision = {};
  /// True if the mistake leaves the operation out: one of its operands remains.
  bool is_left_out() const;
};
/// Operations of the reference.
struct ReferenceValues {
  explicit ReferenceValues(const std::vector<Followed>& invocations);
  /// True if one operation has all of these values.
  bool has(const Values& v) const;
  /// True if one operation has all of these values, and operands with those.
  bool has(const Values& v, const Operands& operands) const;

  std::vector<Values> right;           ///< values of the operations of each shape
  std::vector<Operands> operands;      ///< and of their operands
  std::vector<ChangedValues> changed;  ///< in order of execution
  bool moves_position = false;         ///< the mistake changes the invocation's own index
  ByValue by_right;
};

/// A part of an instruction of the port's program, in one call chain.
struct PortStep {
  perturbed::Op op;
  std::uint32_t instruction, part;
  std::vector<std::uint32_t> calls;  ///< call instructions, from the entry point on
  Values values;
  Values first;                    ///< the first of them, as executed
  std::vector<int> of = {};        ///< steps whose values are operands
  std::vector<int> first_of = {};  ///< and those of the first values
  Operands compared = {};          ///< of a comparison

  int users = 0;             ///< number of steps that it is an operand of
  bool is_position = false;  ///< it is the invocation's own index, unchanged
  /// True if it exists before the program begins: a constant, which has no line.
  bool is_given() const { return instruction == capture::ProgramTrace::given; }
};
/// Operations of the port.
struct PortValues {
  explicit PortValues(const std::vector<Followed>& invocations);
  const PortStep& operator[](int k) const { return steps[static_cast<std::size_t>(k)]; }

  std::vector<PortStep> steps;  ///< in order of execution
  std::vector<int> outputs;     ///< steps that store values that the mistake changes
  ByValue by_value;
};

}  // namespace rainref::faults
