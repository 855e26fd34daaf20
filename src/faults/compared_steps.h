// A port's steps beside the values of the reference, with and without a mistake: which of them are right, and what is to blame.
#pragma once

#include <cstdint>
#include <set>
#include <vector>

#include "faults/followed_values.h"

namespace rainref::faults {

struct ComparedSteps {
  ComparedSteps(const std::vector<Followed>& invocations, bool is_in_function);
  /// True if the reference computes it, too: the values of one contain all of the other's, because either may omit rounds of a loop, or do
  /// in one place what the other does in several.
  bool is_vouched(const PortStep& p) const { return is_of_reference(p.values); }
  /// The first operation before `changed` to which the mistake gives these values; -1 if there is none.
  int sooner(int changed, const Values& v) const;
  /// Finds the source in the port of a number that is equal in every invocation and that the reference lacks.
  int first_constant(int from) const;
  /// The instruction of a step. If a function is right in most of its calls, the call is wrong.
  std::uint32_t blamed(int node) const;
  /// True if a step is in a function that is called in one place.
  bool has_one_call(const PortStep& p) const;
  /// True if a step of a function has values of the mistake in most calls, so that the function is wrong and not a call.
  bool is_old_in_most_calls(const PortStep& p) const;
  /// Goes back from a value through copies, and through clamps that do not change it. `whatever_use`: also if they have other uses.
  int first_copy(int node, bool whatever_use) const;
  /// True if its first value is wrong although all that it is made of is right. In a loop that takes its own results, later operands are
  /// wrong too.
  bool is_first_wrong(const PortStep& p) const { return begins_wrong(p, &PortStep::first, &PortStep::first_of); }
  /// The operand that the port takes where the operation of the reference has another one, if that is the one difference; else -1.
  int other_operand(int node, const ChangedValues& meant) const;

  ReferenceValues reference;
  PortValues port;
  bool in_function;  ///< the mistake is in a function, whatever its caller

 private:
  bool is_of_reference(const Values& of_port) const;
  bool begins_wrong(const PortStep& p, Values PortStep::*values, std::vector<int> PortStep::*operands) const;

  std::set<std::vector<std::uint32_t>> origins_;  ///< calls in which something goes wrong
};

}  // namespace rainref::faults
