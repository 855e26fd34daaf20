// This program, started again as a process of its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rainref::cli {

/// Where the output of a child goes; "": where that of this process goes.
struct ChildOutput {
  std::filesystem::path standard_output, standard_error;
};

/// Runs this program with these arguments, with one variable ("NAME=value") more where it is not "", and waits. It gets SIGTERM when this
/// process dies, however it dies. Gives the exit code, or the signal that it died of, below zero. Throws Error(io) when there is no
/// process.
int run_own_program(const std::vector<std::string>& arguments, const std::string& variable = "", const ChildOutput& output = {});

/// What this process was started with, without the program.
std::vector<std::string> own_arguments();
/// Where this program lies.
std::filesystem::path own_program();

}  // namespace rainref::cli
