// Finds the files that a port's command runs, from its text.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rainref::sweep {

/// The files named by the words of a shell command, in order and without repetition: words, or parts after "=" of words, that are regular
/// files relative to the current folder, or programs in a folder of PATH. Programs of /bin, /sbin, /usr/bin and /usr/sbin belong to the
/// machine and are left out. Files named by a variable, and files opened by these files, are not found.
std::vector<std::filesystem::path> files_named_by(const std::string& command);

}  // namespace rainref::sweep
