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

/// Operations of the reference.
struct ReferenceValues {
  explicit ReferenceValues(const std::vector<Followed>& invocations);
  /// True if one operation has all of these values.
  bool has(const Values& v) const;

  std::vector<Values> right;    ///< values of the operations of each shape
  std::vector<Values> changed;  ///< values with the mistake of each operation that it changes, where it does; in order of execution
  ByValue by_right;
};

/// A part of an instruction of the port's program, in one call chain.
struct PortStep {
  perturbed::Op op;
  std::uint32_t instruction;
  std::vector<std::uint32_t> calls;  ///< call instructions, from the entry point on
  Values values;
  std::vector<int> of = {};  ///< steps whose values are operands

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
