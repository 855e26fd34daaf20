// Writes the files that are installed beside the program: `rainref_manual man`, `bash` or `zsh`, to standard output. For the build.
#include <string_view>

#include "cli/manual.h"
#include "cli/terminal.h"

int main(int argc, char** argv) {
  const std::string_view what = argc == 2 ? argv[1] : "";
  if (what != "man" && what != "bash" && what != "zsh") {
    rainref::cli::complain("rainref_manual: expected man, bash or zsh");
    return 2;
  }
  rainref::cli::print_report(what == "man"    ? rainref::cli::man_page()
                             : what == "bash" ? rainref::cli::bash_completion()
                                              : rainref::cli::zsh_completion());
  return 0;
}
