#include "base/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "rainref/error.h"

namespace rainref {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 16;

}  // namespace

AtomicFile::AtomicFile(fs::path path) : path_(std::move(path)), target_(path_) {
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (fs::is_directory(status)) fail(EISDIR);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  if (fs::exists(status) && fs::is_symlink(fs::symlink_status(path_, error))) {
    target_ = fs::canonical(path_, error);
    if (error) fail(error.value());
  }
  create_temporary();
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::create_temporary() {
  if (!target_.has_filename()) fail(target_.empty() ? ENOENT : EISDIR);
  // The process and a counter make the name unique among the living. A leftover of a killed process that had the same
  // number (common in containers) is stepped over. The final name is not part of it: it may already be of full length.
  static std::atomic<unsigned> counter{0};
  do {
    temporary_ = target_.parent_path() / fmt::format(".rainref-{}-{}.tmp", ::getpid(), counter.fetch_add(1));
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  } while (descriptor_ < 0 && (errno == EEXIST || errno == EINTR));
  if (descriptor_ < 0) {
    const int error = errno;
    temporary_.clear();
    fail(error);
  }
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
  const bool renames = !temporary_.empty();
  if (renames && ::fsync(descriptor_) != 0) fail(errno);
  // On some file systems the disk turns out to be full only here. The descriptor is gone whatever close returns.
  if (::close(std::exchange(descriptor_, -1)) != 0 && errno != EINTR) fail(errno);
  if (renames && std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
}

void AtomicFile::require_open() const {
  if (descriptor_ < 0) throw Error(ExitCode::internal, fmt::format("'{}' is already closed", path_.string()));
}

void AtomicFile::flush() {
  write_through(pending_);
  pending_.clear();
}

void AtomicFile::write_through(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    // A short write is no error yet: the next one either goes on or says why not. Zero bytes would repeat for ever.
    if (written == 0) fail(EIO);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void AtomicFile::discard() noexcept {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  temporary_.clear();
}

void AtomicFile::fail(int error) {
  discard();
  throw Error(ExitCode::io,
              fmt::format("cannot write '{}': {}", path_.string(), std::generic_category().message(error)));
}

void write_file(const fs::path& path, std::span<const std::byte> bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

void write_file(const fs::path& path, std::string_view text) { write_file(path, std::as_bytes(std::span(text))); }

}  // namespace rainref
