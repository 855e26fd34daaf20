// A trace of a port's own program for one invocation: the value of each instruction and its source line.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "capture/pass_model.h"
#include "math/trace.h"

namespace rainref::capture {

/// A line of a program's source, without surrounding blanks. The text is "" if the program does not contain it.
struct SourceLine {
  std::string file;
  std::uint32_t line = 0;  ///< 0: unknown
  std::string text = {};
};

/// The execution of one invocation of a program, in order.
struct ProgramTrace {
  /// The instruction that made a node of `values`, and its function call.
  static constexpr std::uint32_t given = 0xffffffff;  ///< no instruction: constants and numbers of the invocation
  struct Step {
    std::uint32_t instruction;
    std::int32_t call;   ///< -1: the entry point
    std::uint32_t part;  ///< index among the nodes that the instruction makes
  };
  struct Call {
    std::uint32_t instruction;  ///< the call instruction
    std::int32_t caller;        ///< the call that contains it; -1: the entry point
  };
  perturbed::Trace values;
  std::vector<Step> steps;            ///< one for each node
  std::vector<std::int32_t> outputs;  ///< nodes of the stored values, in the order of PassModel's values; -1: no node
  std::vector<Call> calls;
};

/// The source of a program.
class ProgramSource {
 public:
  virtual ~ProgramSource() = default;
  virtual SourceLine line(std::uint32_t instruction) const = 0;
};

/// A program with one invocation for each texel of its outputs.
class TracedProgram : public PassModel, public ProgramSource {
 public:
  using PassModel::PassModel;
  /// Executes the invocation of a texel. A value that is stored, passed on or put into a vector becomes a new node (perturbed::Op::stored),
  /// because a mistake may be there. Throws what an evaluation throws.
  virtual void trace(int x, int y, ProgramTrace& out) const = 0;
};

/// A program that writes lists.
class TracedListProgram : public ProgramSource {
 public:
  /// Executes the first invocation alone on a case of the program's pass, whose list has one record, and returns the pass's outputs. The
  /// nodes of all floats that it writes to lists become `out.outputs`. Throws what an execution throws.
  virtual std::vector<Array> trace(const PassCase& c, ProgramTrace& out) const = 0;
};

}  // namespace rainref::capture
