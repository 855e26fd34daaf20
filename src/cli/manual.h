// The manual page and what shells complete, written from the options themselves.
#pragma once

#include <string>

namespace rainref::cli {

/// In troff, for section 1.
std::string man_page();
/// Completion of verbs, options, their words, files, and scenes, which the program is asked for.
std::string bash_completion();
std::string zsh_completion();

}  // namespace rainref::cli
