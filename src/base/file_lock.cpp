#include "base/file_lock.h"

#include <cerrno>
#include <utility>

#include "base/system.h"

namespace rainref {

namespace fs = std::filesystem;

FolderLock::FolderLock(const fs::path& folder) : path_(folder / ".rainref-run.lock") {
  const Uninterrupted scope;
  int error = EWOULDBLOCK;
  // The previous owner may remove the file just when this process has opened it, but not every time.
  for (int tries = 0; tries < 100 && descriptor_ < 0; ++tries) {
    descriptor_ = system::open(path_, system::reading | system::writing | system::creating | system::no_link);
    // A file left by another user's killed process can be locked all the same.
    if (descriptor_ < 0 && errno == EACCES) descriptor_ = system::open(path_, system::reading | system::no_link);
    if (descriptor_ < 0) {
      error = errno;
      break;
    }
    const FileLock got = lock_file(descriptor_);
    if (got != FileLock::taken && is_still(descriptor_, path_)) break;
    system::close(std::exchange(descriptor_, -1));
    if (got == FileLock::taken) break;
  }
  if (descriptor_ < 0) throw_system_error(error);
  undo_.emplace([this] { remove(); });
}

FolderLock::~FolderLock() {
  {
    const Uninterrupted scope;
    remove();
    undo_.reset();
  }
  if (descriptor_ >= 0) system::close(descriptor_);
}

void FolderLock::remove() noexcept {
  if (path_.empty()) return;
  system::remove_file(path_);  // while it is locked, so that a process that has opened it sees that it is gone
  system::release(descriptor_);
  path_.clear();
}

}  // namespace rainref
