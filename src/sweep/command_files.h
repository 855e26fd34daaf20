// What a port's command runs, as far as its text says it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rainref::sweep {

/// The files that the words of a shell's command name, in their order, each once: a word, or what follows "=" in it, that leads to a
/// regular file from the current folder, or to a program in a folder of PATH. Programs of /bin, /sbin, /usr/bin and /usr/sbin are the
/// machine's and left out. What stands behind a variable, and what these files open themselves, is not seen.
std::vector<std::filesystem::path> files_named_by(const std::string& command);

}  // namespace rainref::sweep
