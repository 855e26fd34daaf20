// A program that reads from this one. CMake compiles one of piped_program_<system>.cpp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cli/run_command.h"

namespace rainref::cli {

/// A running program with a pipe to its standard input. What it prints is kept. It and its children are killed by the destructor, if
/// rainref is interrupted, and if this process dies in any way.
class PipedProgram {
 public:
  /// Throws std::runtime_error with a sentence if it cannot be started.
  PipedProgram(const std::filesystem::path& program, const std::vector<std::string>& arguments);
  ~PipedProgram();
  PipedProgram(const PipedProgram&) = delete;
  PipedProgram& operator=(const PipedProgram&) = delete;

  /// Returns false if the program reads no more. Throws std::system_error for any other failure.
  bool write(std::span<const std::byte> bytes);
  /// Ends the input and waits for the program. `name` begins the sentence about a failure.
  CommandEnd end(const std::string& name);

 private:
  class Process;
  std::unique_ptr<Process> process_;
};

}  // namespace rainref::cli
