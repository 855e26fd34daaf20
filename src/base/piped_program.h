// A program that reads from this one, or this one from it. CMake compiles one of piped_program_<system>.cpp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/command_end.h"

namespace rainref {

/// A running program with a pipe to its standard input, or from its standard output. What else it prints is kept. It and its children are
/// killed by the destructor, and if rainref is interrupted; a program that reads also if this process dies in any way.
class PipedProgram {
 public:
  enum class Pipe { to_input, from_output };

  /// Throws std::runtime_error with a sentence if it cannot be started.
  PipedProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments, Pipe pipe = Pipe::to_input);
  ~PipedProgram();
  PipedProgram(const PipedProgram&) = delete;
  PipedProgram& operator=(const PipedProgram&) = delete;

  /// Returns false if the program reads no more. Throws std::system_error for any other failure.
  bool write(std::span<const std::byte> bytes);
  /// Waits until all these bytes are read, or the output has ended. Returns their number. Throws std::system_error for any other failure.
  std::size_t read(std::span<std::byte> bytes);
  /// Closes the pipe and waits for the program. `name` begins the sentence about a failure.
  CommandEnd end(const std::string& name);

 private:
  class Process;
  std::unique_ptr<Process> process_;
};

}  // namespace rainref
