// New names, locks and errors of POSIX, also of emscripten.
#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <cstdio>

#include "base/file_lock.h"
#include "base/system.h"

namespace rainref::system {

namespace fs = std::filesystem;

int rename(const fs::path& from, const fs::path& to) { return std::rename(from.c_str(), to.c_str()); }
// EINVAL, ENOSYS, ENOTSUP: not on this file system or kernel.
bool exchange([[maybe_unused]] const fs::path& a, [[maybe_unused]] const fs::path& b) {
#ifdef RENAME_EXCHANGE
  if (::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0) return true;
  if (errno != EINVAL && errno != ENOSYS && errno != ENOTSUP) throw_system_error(errno);
#endif
  return false;
}

}  // namespace rainref::system

namespace rainref {

const std::error_category& system_failures() { return std::generic_category(); }

FileLock lock_file(int descriptor) {
  while (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) return FileLock::taken;
    if (errno != EINTR) return FileLock::impossible;
  }
  return FileLock::mine;
}

bool is_still(int descriptor, const std::filesystem::path& path) {
  const system::Found opened = system::found(descriptor), named = system::found(path, false);
  return opened.kind != system::Kind::nothing && named.kind != system::Kind::nothing && opened.device == named.device &&
         opened.file == named.file;
}

}  // namespace rainref
