// A kept file, with checks whether it can be trusted.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>

#include "base/hash.h"
#include "base/system.h"

namespace rainref::cache {

/// A file that is read from the front while its bytes are hashed. If another user owns it or may write it, its hash proves nothing, because
/// anyone can compute a hash. With this check the rights of the folder do not matter.
class OwnFile {
 public:
  explicit OwnFile(const std::filesystem::path& path)
      : descriptor_(system::open(path, system::reading | system::no_link | system::no_wait)) {
    if (descriptor_ < 0) return;
    const system::Found found = system::found(descriptor_);
    is_own_ = found.kind == system::Kind::file && found.is_mine && !found.others_may_write;
    left_ = found.bytes;
  }
  ~OwnFile() {
    if (descriptor_ >= 0) system::close(descriptor_);
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
      const std::ptrdiff_t count = system::read(descriptor_, to.data() + done, to.size() - done);
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
