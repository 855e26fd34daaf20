// Runs this program again as a child process. CMake compiles one of own_program_<system>.cpp.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rainref::cli {

/// Files for the output of a child; "": inherited from this process.
struct ChildOutput {
  std::filesystem::path standard_output, standard_error;
};

/// Runs this program with these arguments and one more environment variable ("NAME=value", if not ""), and waits. The child ends if this
/// process dies in any way. Returns the exit code, or the negative number of the signal or exception. Throws Error(io) if no process can be
/// started.
int run_own_program(const std::vector<std::string>& arguments, const std::string& variable = "", const ChildOutput& output = {});

/// "signal 11", from a negative result of run_own_program().
std::string death_text(int code);

/// The arguments of this process, without the program.
std::vector<std::string> own_arguments();
/// Path of this program.
std::filesystem::path own_program();

}  // namespace rainref::cli
