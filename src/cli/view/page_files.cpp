#include "cli/view/page_files.h"

#include <system_error>

#include "base/path_text.h"
#include "base/read_file.h"
#include "rainref/error.h"
#include "simulation/own_scenes.h"

namespace rainref::cli {
namespace {

std::string type_of(std::string_view name) {
  if (name.ends_with(".html")) return "text/html; charset=utf-8";
  if (name.ends_with(".css")) return "text/css; charset=utf-8";
  if (name.ends_with(".js")) return "text/javascript; charset=utf-8";
  return "application/octet-stream";
}

}  // namespace

PageFiles::PageFiles() {
  const std::filesystem::path folder = simulation::own_data("pages");
  if (!folder.empty()) {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
      if (entry.is_regular_file(error)) files_.emplace(path_text(entry.path().filename()), entry.path());
  }
  if (!files_.contains("live.html")) throw Error(ExitCode::io, "view: its page is not beside this program, in share/rainref/pages");
}

Reply PageFiles::get(std::string_view name) const {
  const auto found = files_.find(name);
  if (found == files_.end()) return {404, "text/plain", "no such file\n"};
  const std::vector<std::byte> bytes = read_file(found->second);
  return {200, type_of(name), {reinterpret_cast<const char*>(bytes.data()), bytes.size()}};
}

}  // namespace rainref::cli
