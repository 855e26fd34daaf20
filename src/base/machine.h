// The machine, the user and the terminal. CMake compiles one of machine_<system>.cpp.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>

namespace rainref::machine {

/// The value of an environment variable in UTF-8; none if it is not set.
std::optional<std::string> variable(const char* name);
/// The folder for files of this user that programs may make again; "" if unknown.
std::filesystem::path cache_folder();
/// This machine's name; "-" if unknown.
std::string host_name();
/// The largest memory [byte] that this process has had resident; 0 if unknown.
std::size_t most_memory();

/// True if a stream leads to a terminal that understands escape sequences.
bool is_terminal(std::FILE* stream);
/// True if a stream leads to a pipe whose reader has ended.
bool reader_is_gone(std::FILE* stream);

}  // namespace rainref::machine
