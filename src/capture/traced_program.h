// A port's own program, followed through one invocation: what it computed, instruction by instruction, and where that stands in its source.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "capture/pass_model.h"
#include "math/places.h"

namespace rainref::capture {

/// A line of a program's source, without the blanks around it. The text is "" where the program does not carry it.
struct SourceLine {
  std::string file;
  std::uint32_t line = 0;  ///< 0: the program does not say
  std::string text = {};
};

/// What one invocation of a program did, in order.
struct ProgramTrace {
  /// By which instruction a node of `values` was made, and in which call of a function.
  static constexpr std::uint32_t given = 0xffffffff;  ///< no instruction: constants and numbers of the invocation, which are there before
  struct Step {
    std::uint32_t instruction;
    std::int32_t call;   ///< -1: the entry point
    std::uint32_t part;  ///< which of the nodes that the instruction makes at once
  };
  struct Call {
    std::uint32_t instruction;  ///< that calls
    std::int32_t caller;        ///< the call in which that stands; -1: the entry point
  };
  perturbed::Trace values;
  std::vector<Step> steps;            ///< one for each node
  std::vector<std::int32_t> outputs;  ///< nodes of what is stored, in the order of PassModel's values; -1: of nothing
  std::vector<Call> calls;
};

/// A program with one invocation for each texel of its outputs.
class TracedProgram : public PassModel {
 public:
  using PassModel::PassModel;
  /// Executes the invocation of a texel. A value that is stored, passed on or put into a vector is a node again (perturbed::Op::stored),
  /// for a mistake may stand there. Throws what an evaluation throws.
  virtual void trace(int x, int y, ProgramTrace& out) const = 0;
  virtual SourceLine line(std::uint32_t instruction) const = 0;
};

}  // namespace rainref::capture
