// Values of followed invocations, operation by operation: what the reference gives, what a mistake makes of it, what a port computes.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "faults/shader_line.h"

namespace rainref::faults {

/// Of each invocation the values that one operation gave there, sorted. In a loop they are many, and two texts may loop over other rounds.
using Values = std::vector<std::vector<float>>;

/// Whether two values are one, computed by two hands.
bool agree(float a, float b);
/// In every invocation where the first has some, the second has them too.
bool is_within(const Values& some, const Values& all);
/// The same, where both have some; in most of those of the first both must.
bool is_met_by(const Values& some, const Values& all);
/// Whether they say anything: a number that is the same in every invocation is met by chance.
bool varies(const Values& v);
/// Whether they are no chance among many others: two of them at least that are no whole numbers.
bool tells(const Values& v);

/// Finds operations by what they gave.
class ByValue {
 public:
  explicit ByValue(std::size_t invocations) : sorted_(invocations) {}
  void add(const Values& v, int number);
  void sort();
  /// Those that gave about this value in an invocation, in order of their numbers.
  std::vector<int> near(std::size_t invocation, float v) const;

 private:
  std::vector<std::vector<std::pair<float, int>>> sorted_;
};

/// The reference's operations.
struct ReferenceValues {
  explicit ReferenceValues(const std::vector<Followed>& invocations);
  /// Whether one operation gives all of these.
  bool has(const Values& v) const;

  std::vector<Values> right;    ///< of operations of one shape
  std::vector<Values> changed;  ///< what the mistake makes of each that it changes, in the invocations where it does; in order of time
  ByValue by_right;
};

/// A part of an instruction of the port's program, in one chain of calls.
struct PortStep {
  perturbed::Op op;
  std::uint32_t instruction;
  std::vector<std::uint32_t> calls;  ///< instructions that call, from the entry point on
  Values values;
  std::vector<int> of = {};  ///< steps whose values it takes

  bool is_position = false;  ///< the invocation's own number, as it is
  /// Whether it is there before the program begins: a constant, which stands in no line.
  bool is_given() const { return instruction == capture::ProgramTrace::given; }
};
/// The port's operations.
struct PortValues {
  explicit PortValues(const std::vector<Followed>& invocations);
  const PortStep& operator[](int k) const { return steps[static_cast<std::size_t>(k)]; }

  std::vector<PortStep> steps;  ///< in order of time
  std::vector<int> outputs;     ///< those that store what the mistake changes
  ByValue by_value;
};

}  // namespace rainref::faults
