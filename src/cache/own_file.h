// A kept file, with checks whether it can be trusted.
#pragma once

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "base/hash.h"

namespace rainref::cache {

/// A file that is read from the front while its bytes are hashed. If another user owns it or may write it, its hash proves nothing, because
/// anyone can compute a hash. With this check the rights of the folder do not matter.
class OwnFile {
 public:
  explicit OwnFile(const std::filesystem::path& path) : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK)) {
    struct stat status {};
    if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0) return;
    is_own_ = S_ISREG(status.st_mode) && status.st_uid == ::geteuid() && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
    left_ = static_cast<std::uintmax_t>(status.st_size);
  }
  ~OwnFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  OwnFile(const OwnFile&) = delete;
  OwnFile& operator=(const OwnFile&) = delete;
  /// True for a regular file of this user that nobody else may write. Do not read from any other.
  bool is_own() const { return is_own_; }
  /// Number of bytes not read yet.
  std::uintmax_t left() const { return left_; }
  /// Returns false if the file has fewer bytes left.
  bool read(std::span<std::byte> to) {
    if (to.size() > left_) return false;
    for (std::size_t done = 0; done < to.size();) {
      const ssize_t count = ::read(descriptor_, to.data() + done, to.size() - done);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return false;
      done += static_cast<std::size_t>(count);
    }
    hasher_->add(to);
    left_ -= to.size();
    return true;
  }
  template <class T>
  bool read(T& x) {
    return read(std::as_writable_bytes(std::span(&x, 1)));
  }
  void hash_from_here() { hasher_.emplace(0); }
  Hash128 hash() const { return hasher_->finish(); }

 private:
  int descriptor_;
  bool is_own_ = false;
  std::uintmax_t left_ = 0;
  std::optional<Hasher> hasher_{std::in_place, 0};
};

}  // namespace rainref::cache
