#include "base/atomic_file.h"

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/folders.h"
#include "base/path_text.h"
#include "base/system.h"
#include "rainref/error.h"

namespace rainref {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 16;

}  // namespace

AtomicFile::AtomicFile(fs::path path) : path_(std::move(path)), target_(path_) {
  const system::Kind kind = system::found(path_, true).kind;
  if (kind == system::Kind::folder) fail(EISDIR);
  if (kind == system::Kind::other) {
    descriptor_ = system::open(path_, system::writing);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  create_temporary();
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::create_temporary() {
  try {
    target_ = followed(path_);
    if (!path_.has_filename()) fail(path_.empty() ? ENOENT : EISDIR);
    // The temporary's name does not contain the final name, which may already have the maximum length.
    temporary_.emplace(target_.parent_path(), Hidden::Kind::file);
  } catch (const std::system_error& e) {
    fail(e.code().value());
  }
  // The temporary's own descriptor holds its lock until it has its final name.
  descriptor_ = system::duplicate(temporary_->descriptor());
  if (descriptor_ < 0) fail(errno);
}

void AtomicFile::write(std::span<const std::byte> bytes) {
  require_open();
  if (pending_.size() + bytes.size() > buffer_bytes) flush();
  if (bytes.size() > buffer_bytes) {
    write_through(bytes);
  } else {
    pending_.insert(pending_.end(), bytes.begin(), bytes.end());
  }
}

void AtomicFile::commit() {
  require_open();
  flush();
  if (temporary_ && system::sync(descriptor_) != 0) fail(errno);
  // Some file systems report a full disk only here. The descriptor is closed whatever close returns.
  if (system::close(std::exchange(descriptor_, -1)) != 0) fail(errno);
  if (!temporary_) return;
  try {
    temporary_->become(target_);
  } catch (const std::system_error& e) {
    fail(e.code().value());
  }
  temporary_.reset();
}

void AtomicFile::require_open() const {
  if (descriptor_ < 0) throw Error(ExitCode::internal, fmt::format("'{}' is already closed", path_text(path_)));
}

void AtomicFile::flush() {
  write_through(pending_);
  pending_.clear();
}

void AtomicFile::write_through(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const std::ptrdiff_t written = system::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    // A short write is no error yet: the next one either continues or fails with the reason. Zero bytes would repeat forever.
    if (written == 0) fail(EIO);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void AtomicFile::discard() noexcept {
  if (descriptor_ >= 0) system::close(std::exchange(descriptor_, -1));
  temporary_.reset();
}

void AtomicFile::fail(int error) {
  discard();
  throw Error(ExitCode::io, fmt::format("cannot write '{}': {}", path_text(path_), reason_of(error)));
}

void write_file(const fs::path& path, std::span<const std::byte> bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

void write_file(const fs::path& path, std::string_view text) { write_file(path, std::as_bytes(std::span(text))); }

}  // namespace rainref
