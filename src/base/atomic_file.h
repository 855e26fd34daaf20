// Files that appear under their final name only when whole.
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

/// A file being written. Its bytes go to a hidden temporary in the same folder; commit() gives it its name. Without a
/// commit, whatever stood under that name stays untouched and the temporary is removed (base/hidden.h).
///
/// A symbolic link is written through; one that leads nowhere has the file made that it names. A path that exists and is
/// no regular file (/dev/stdout, a pipe) is written straight away, because a rename would replace the device itself.
///
/// Every failure is Error(io), naming the file and the system's reason. After a failure the temporary is already gone
/// and the object refuses further use. One object belongs to one thread; two objects never share a temporary.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::span<const std::byte> bytes);
  void write(std::string_view text) { write(std::as_bytes(std::span(text))); }
  /// Flush, fsync, rename. Call once, last.
  void commit();
  /// What commit() replaces: the path with its own links followed.
  const std::filesystem::path& target() const { return target_; }

 private:
  void create_temporary();
  void require_open() const;
  void flush();
  void write_through(std::span<const std::byte> bytes);
  void discard() noexcept;
  [[noreturn]] void fail(int error);

  std::filesystem::path path_;       // as the caller named it, for messages
  std::filesystem::path target_;     // what the rename replaces
  std::optional<Hidden> temporary_;  // none when writing straight to a device
  std::vector<std::byte> pending_;   // small writes are gathered
  int descriptor_ = -1;
};

/// Writes a whole file; failures as AtomicFile.
void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);
void write_file(const std::filesystem::path& path, std::string_view text);

}  // namespace rainref
