#include "cli/port_command.h"

#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "base/path_text.h"
#include "rainref/error.h"

namespace rainref::cli {

namespace fs = std::filesystem;

TemporaryRun::TemporaryRun() {
  const fs::path parent = temporary_folder();
  remove_leftovers(parent);
  try {
    folder_.emplace(parent, Hidden::Kind::private_folder);
  } catch (const std::system_error& e) {
    throw Error(ExitCode::io, fmt::format("--exec: no temporary folder in {}: {}", path_text(parent), e.code().message()));
  }
}

PortFolders::PortFolders(const fs::path& pack, const fs::path& out) : pack_(fs::absolute(pack)), out_(fs::absolute(out)) {
  told_pack_ = told(pack_, "pack");
  told_out_ = told(out_, "out");
}

std::string PortFolders::told(const fs::path& real, const char* link) {
  if (std::string plain = plain_path(real); !plain.empty()) return plain;
  if (!links_) links_.emplace();
  return link_to(real, links_->path() / link);
}

std::string PortFolders::filled_in(const std::string& command) const {
  std::string result;
  for (std::size_t i = 0; i < command.size();) {
    const std::string_view rest = std::string_view(command).substr(i);
    const bool is_pack = rest.starts_with("{pack}"), is_out = rest.starts_with("{out}");
    result += is_pack ? in_command(result, told_pack_) : is_out ? in_command(result, told_out_) : std::string(1, command[i]);
    i += is_pack ? 6 : is_out ? 5 : 1;
  }
  return result;
}

std::vector<std::string> PortFolders::environment() const {
  return {"RAINREF_PACK=" + system_path_text(pack_), "RAINREF_OUT=" + system_path_text(out_)};
}

void PortFolders::check() const {
  std::error_code error;
  const fs::path link = links_ ? links_->path() / "out" : fs::path();
  if (link.empty() || told_out_ != path_text(link) || fs::is_symlink(fs::symlink_status(link, error))) return;
  throw Error(ExitCode::port_files, fmt::format("--exec: the command removed {{out}}, which was a link to '{}'; expected it to write into "
                                                "that folder, or a --port whose path has letters, digits and ._-/ alone",
                                                path_text(out_)));
}

}  // namespace rainref::cli
