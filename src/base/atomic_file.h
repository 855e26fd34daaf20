// Files that appear under their final name only when complete.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/hidden.h"

namespace rainref {

/// A file being written. Its bytes go to a hidden temporary in the same folder; commit() renames it. Without a commit, an existing file of
/// that name is unchanged and the temporary is removed (base/hidden.h).
///
/// A symbolic link is followed; if its target does not exist, the target is created. A path that exists and is no regular file
/// (/dev/stdout, a pipe) is written directly, because a rename would replace the device itself.
///
/// Every failure throws Error(io) with the file and the system's reason. After a failure the temporary is already removed and the object
/// refuses further use. One object belongs to one thread; two objects never share a temporary.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::span<const std::byte> bytes);
  void write(std::string_view text) { write(std::as_bytes(std::span(text))); }
  /// Flushes, syncs and renames. Call once, last.
  void commit();
  /// The path that commit() replaces: the given path with its links followed.
  const std::filesystem::path& target() const { return target_; }

 private:
  void create_temporary();
  void require_open() const;
  void flush();
  void write_through(std::span<const std::byte> bytes);
  void discard() noexcept;
  [[noreturn]] void fail(int error);

  std::filesystem::path path_;       // as the caller gave it, for messages
  std::filesystem::path target_;     // path that the rename replaces
  std::optional<Hidden> temporary_;  // none when writing directly to a device
  std::vector<std::byte> pending_;   // buffer for small writes
  int descriptor_ = -1;
};

/// Writes a whole file. Failures are those of AtomicFile.
void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace rainref
