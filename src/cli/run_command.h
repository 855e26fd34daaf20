// Runs a command by the system's shell, and writes paths for it. CMake compiles one of run_command_<system>.cpp.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/command_end.h"

namespace rainref::cli {

/// Runs a command with /bin/sh or cmd.exe, without input, with these environment variables added, and waits. All its descendants are
/// killed, also those that started a session or changed their parent: when the shell ends, when the time is over, and when rainref is
/// interrupted. Throws Error(io) if no process can be started.
CommandEnd run_command(const std::string& command, std::chrono::duration<double> timeout, const std::vector<std::string>& environment = {});

/// A text for a path that no shell splits or interprets, however nested or quoted: letters, digits and `/._-`, on Windows also `\:~`. ""
/// if the path has none. Windows has short names for many.
std::string plain_path(const std::filesystem::path& path);
/// A folder for temporary files, with a plain path if there is one.
std::filesystem::path temporary_folder();
/// The text that a command is told for a folder without a plain path: of a link that this makes; on Windows, where only some users may make
/// links, of the folder itself. Throws Error(io).
std::string link_to(const std::filesystem::path& folder, const std::filesystem::path& link);
/// The path as it is written into a command whose beginning is `before`: in quotes on Windows if it has characters that split it there.
std::string in_command(std::string_view before, const std::string& path);
/// A word as a user types it in that shell: in quotes if it needs them.
std::string shell_word(std::string_view word);

}  // namespace rainref::cli
