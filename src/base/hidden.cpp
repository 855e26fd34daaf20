#include "base/hidden.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/file_lock.h"
#include "base/system_failure.h"

namespace rainref {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view prefix = ".rainref-", making = ".tmp", replaced = ".old";
constexpr std::size_t digits = 16;

// Opens and locks this user's own unfinished file or folder; -1 if that is impossible.
int lock_leftover(const fs::path& path) {
  struct stat found {};
  if (::lstat(path.c_str(), &found) != 0 || found.st_uid != ::geteuid()) return -1;
  const bool is_folder = S_ISDIR(found.st_mode);
  if (!is_folder && !S_ISREG(found.st_mode)) return -1;
  // NFS locks only files that are open for writing.
  const int descriptor = ::open(path.c_str(), (is_folder ? O_RDONLY | O_DIRECTORY : O_RDWR | O_NONBLOCK) | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0) return -1;
  if (lock_file(descriptor) == FileLock::mine && is_still(descriptor, path)) return descriptor;
  ::close(descriptor);
  return -1;
}

bool has_hidden_form(std::string_view name, std::string_view end) {
  if (name.size() != prefix.size() + digits + end.size() || !name.starts_with(prefix) || !name.ends_with(end)) return false;
  return name.substr(prefix.size(), digits).find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

// EINVAL, ENOSYS, ENOTSUP: not on this file system or kernel.
bool exchange([[maybe_unused]] const fs::path& a, [[maybe_unused]] const fs::path& b) {
#ifdef RENAME_EXCHANGE
  if (::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0) return true;
  if (errno != EINVAL && errno != ENOSYS && errno != ENOTSUP) throw_system_error(errno);
#endif
  return false;
}

// Restores a folder that was being replaced; it lies under its own name in a folder with a hidden name. Returns false if its place is free
// but it cannot be moved there.
bool put_back(const fs::path& holder) {
  for (const auto& entry : fs::directory_iterator(holder)) {
    const fs::path place = holder.parent_path() / entry.path().filename();
    struct stat found {};
    if (::lstat(place.c_str(), &found) == 0) continue;  // the new folder is already in place
    if (errno != ENOENT || std::rename(entry.path().c_str(), place.c_str()) != 0) return false;
  }
  return true;
}

}  // namespace

std::string Hidden::random_name(std::string_view end) {
  std::uint64_t number = 0;
  if (::getentropy(&number, sizeof number) != 0) throw_system_error(errno);
  return fmt::format("{}{:016x}{}", prefix, number, end);
}

Hidden::Hidden(const fs::path& parent, Kind kind, const std::function<std::string()>& name) {
  const Uninterrupted scope;
  do {
    path_ = parent / name();
  } while (!make(kind));
  undo_.emplace([this] { remove(); });
}

// Returns false if the name is taken, or if another process treated this as a leftover before it was locked.
bool Hidden::make(Kind kind) {
  if (kind == Kind::file) {
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && errno != EEXIST && errno != EINTR) throw_system_error(errno);
  } else {
    if (::mkdir(path_.c_str(), kind == Kind::folder ? 0777 : 0700) != 0) {
      if (errno != EEXIST) throw_system_error(errno);
      return false;
    }
    descriptor_ = ::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor_ < 0 && errno != ENOENT) {
      const int error = errno;
      ::rmdir(path_.c_str());
      throw_system_error(error);
    }
  }
  if (descriptor_ < 0) return false;
  struct stat found {};
  if (lock_file(descriptor_) != FileLock::taken && ::lstat(path_.c_str(), &found) == 0) return true;
  ::close(std::exchange(descriptor_, -1));
  return false;
}

Hidden::~Hidden() {
  {
    const Uninterrupted scope;
    remove();
    undo_.reset();
  }
  ::close(descriptor_);  // and with it the lock
}

void Hidden::remove() noexcept {
  std::error_code ignored;
  if (!is_gone_) fs::remove_all(path_, ignored);
  is_gone_ = true;
}

void Hidden::become(const fs::path& target) {
  const Uninterrupted scope;
  if (std::rename(path_.c_str(), target.c_str()) != 0) throw_system_error(errno);
  is_gone_ = true;
}

void Hidden::replace(const fs::path& target) {
  const Uninterrupted scope;
  if (exchange(path_, target)) return;  // the old folder now has the hidden name
  Hidden holder(path_.parent_path(), Kind::folder, [] { return random_name(replaced); });
  const fs::path old = holder.path_ / target.filename();
  if (std::rename(target.c_str(), old.c_str()) != 0) throw_system_error(errno);
  if (std::rename(path_.c_str(), target.c_str()) != 0) {
    const int error = errno;
    if (std::rename(old.c_str(), target.c_str()) != 0) holder.is_gone_ = true;  // it stays, with the old folder in it
    throw_system_error(error);
  }
  is_gone_ = true;
}

bool is_hidden_name(std::string_view name) { return has_hidden_form(name, making); }

void remove_leftovers(const fs::path& folder) noexcept {
  try {
    std::vector<fs::path> found;
    std::error_code error;
    for (fs::directory_iterator i(folder.empty() ? fs::path(".") : folder, error), end; !error && i != end; i.increment(error)) {
      const std::string name = i->path().filename().string();
      if (has_hidden_form(name, making) || has_hidden_form(name, replaced)) found.push_back(i->path());
    }
    for (const fs::path& path : found) {
      const int descriptor = lock_leftover(path);
      if (descriptor < 0) continue;
      if (path.extension() != replaced || put_back(path)) fs::remove_all(path, error);
      ::close(descriptor);
    }
  } catch (...) {
    // A failure here must not disturb the caller's work.
  }
}

}  // namespace rainref
