// The files of the page that `rainref view` serves.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "cli/view/server.h"

namespace rainref::cli {

/// The files of share/rainref/pages, by name. A name that was not there at the beginning is never opened, so no path leads out of the
/// folder.
class PageFiles {
 public:
  /// Throws Error(io) if the page is not beside this program.
  PageFiles();
  /// Status 404 for another name. Throws Error(io) if the file cannot be read.
  Reply get(std::string_view name) const;

 private:
  std::map<std::string, std::filesystem::path, std::less<>> files_;
};

}  // namespace rainref::cli
