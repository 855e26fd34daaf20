#include "base/read_file.h"

#include <cerrno>
#include <span>
#include <string>

#include <fmt/format.h>

#include "base/hash_of_file.h"
#include "base/memory.h"
#include "base/path_text.h"
#include "base/system.h"
#include "rainref/error.h"

namespace rainref {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why) {
  throw Error(ExitCode::io, fmt::format("cannot read '{}': {}", path_text(path), why));
}
[[noreturn]] void fail(const std::filesystem::path& path, int error) { fail(path, reason_of(error)); }

/// A regular file.
class Opened {
 public:
  Opened(const std::filesystem::path& path, const MostBytes& most)
      : path_(path), number_(system::open(path, system::reading | system::no_wait)) {  // opening a pipe must not wait for its writer
    if (number_ < 0) fail(path, errno);
    const system::Found found = system::found(number_);
    try {
      if (found.kind == system::Kind::nothing) fail(path, errno);
      if (found.kind == system::Kind::folder) fail(path, EISDIR);
      if (found.kind != system::Kind::file) fail(path, "not a regular file");
      size_ = found.bytes;
      if (size_ > most.bytes)
        throw Error(most.code, fmt::format("'{}': {} bytes; expected at most {}", path_text(path), size_, most.bytes));
    } catch (...) {
      system::close(number_);
      throw;
    }
  }
  ~Opened() { system::close(number_); }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;

  std::uint64_t size() const { return size_; }
  /// Returns fewer than asked for at the end of the file.
  std::size_t read(std::span<std::byte> bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
      const std::ptrdiff_t count = system::read(number_, bytes.data() + done, bytes.size() - done);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) fail(path_, errno);
      if (count == 0) break;
      done += static_cast<std::size_t>(count);
    }
    return done;
  }

 private:
  const std::filesystem::path& path_;
  int number_;
  std::uint64_t size_ = 0;
};

}  // namespace

std::vector<std::byte> read_file(const std::filesystem::path& path) { return read_file(path, {UINT64_MAX, ExitCode::io}); }

std::vector<std::byte> read_file(const std::filesystem::path& path, const MostBytes& most) {
  Opened file(path, most);
  if (const MemoryLimit limit = memory_limit(); file.size() > limit.bytes)
    fail(path, fmt::format("its {} are too many; {} {} of memory", memory_text(file.size()), limit.owner, memory_text(limit.bytes)));
  std::vector<std::byte> bytes(static_cast<std::size_t>(file.size()));
  bytes.resize(file.read(bytes));  // fewer if the file became shorter meanwhile
  return bytes;
}

Hash128 hash_of_file(const std::filesystem::path& path, const MostBytes& most) {
  Opened file(path, most);
  Hasher hasher(0);
  std::vector<std::byte> some(std::size_t{1} << 20);
  while (const std::size_t count = file.read(some)) hasher.add(std::span(some).first(count));
  return hasher.finish();
}

}  // namespace rainref
