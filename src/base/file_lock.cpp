#include "base/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace rainref {

namespace fs = std::filesystem;

FileLock lock_file(int descriptor) {
  while (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    if (errno == EWOULDBLOCK) return FileLock::taken;
    if (errno != EINTR) return FileLock::impossible;
  }
  return FileLock::mine;
}

bool is_still(int descriptor, const fs::path& path) {
  struct stat opened {
  }, named{};
  return ::fstat(descriptor, &opened) == 0 && ::lstat(path.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino;
}

FolderLock::FolderLock(const fs::path& folder) : path_(folder / ".rainref-run.lock") {
  const Uninterrupted scope;
  int error = EWOULDBLOCK;
  // The previous owner may remove the file just when this process has opened it, but not every time.
  for (int tries = 0; tries < 100 && descriptor_ < 0; ++tries) {
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    // A file left by another user's killed process can be locked all the same.
    if (descriptor_ < 0 && errno == EACCES) descriptor_ = ::open(path_.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor_ < 0) {
      error = errno;
      break;
    }
    const FileLock got = lock_file(descriptor_);
    if (got != FileLock::taken && is_still(descriptor_, path_)) break;
    ::close(std::exchange(descriptor_, -1));
    if (got == FileLock::taken) break;
  }
  if (descriptor_ < 0) throw std::system_error(error, std::generic_category());
  undo_.emplace([this] { remove(); });
}

FolderLock::~FolderLock() {
  {
    const Uninterrupted scope;
    remove();
    undo_.reset();
  }
  ::close(descriptor_);
}

void FolderLock::remove() noexcept {
  if (!path_.empty()) ::unlink(path_.c_str());  // while it is locked, so that a process that has opened it sees that it is gone
  path_.clear();
}

}  // namespace rainref
