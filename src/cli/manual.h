// The manual page and shell completions, generated from the option declarations.
#pragma once

#include <string>

namespace rainref::cli {

/// In troff format, for section 1.
std::string man_page();
/// Completion of verbs, options, their words, files, and scenes, which the script asks the program for.
std::string bash_completion();
std::string zsh_completion();

}  // namespace rainref::cli
