#include "base/read_file.h"

#include <cerrno>
#include <string>

#include <fmt/format.h>

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

}  // namespace

std::vector<std::byte> read_file(const std::filesystem::path& path) { return read_file(path, {UINT64_MAX, ExitCode::io}); }

std::vector<std::byte> read_file(const std::filesystem::path& path, const MostBytes& most) {
  struct Descriptor {
    int number;
    ~Descriptor() {
      if (number >= 0) system::close(number);
    }
  } file{system::open(path, system::reading | system::no_wait)};  // opening a pipe must not wait for its writer
  if (file.number < 0) fail(path, errno);
  const system::Found found = system::found(file.number);
  if (found.kind == system::Kind::nothing) fail(path, errno);
  if (found.kind == system::Kind::folder) fail(path, EISDIR);
  if (found.kind != system::Kind::file) fail(path, "not a regular file");
  const std::uint64_t size = found.bytes;
  if (size > most.bytes) throw Error(most.code, fmt::format("'{}': {} bytes; expected at most {}", path_text(path), size, most.bytes));
  if (const MemoryLimit limit = memory_limit(); size > limit.bytes)
    fail(path, fmt::format("its {} are too many; {} {} of memory", memory_text(size), limit.owner, memory_text(limit.bytes)));
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  std::size_t done = 0;
  while (done < bytes.size()) {
    const std::ptrdiff_t count = system::read(file.number, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(path, errno);
    if (count == 0) break;  // the file became shorter meanwhile
    done += static_cast<std::size_t>(count);
  }
  bytes.resize(done);
  return bytes;
}

}  // namespace rainref
