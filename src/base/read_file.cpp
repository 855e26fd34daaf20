#include "base/read_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "base/memory.h"
#include "rainref/error.h"

namespace rainref {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why) {
  throw Error(ExitCode::io, fmt::format("cannot read '{}': {}", path.string(), why));
}
[[noreturn]] void fail(const std::filesystem::path& path, int error) { fail(path, std::generic_category().message(error)); }

}  // namespace

std::vector<std::byte> read_file(const std::filesystem::path& path) { return read_file(path, {UINT64_MAX, ExitCode::io}); }

std::vector<std::byte> read_file(const std::filesystem::path& path, const MostBytes& most) {
  struct Descriptor {
    int number;
    ~Descriptor() {
      if (number >= 0) ::close(number);
    }
  } file{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};  // opening a pipe must not wait for its writer
  if (file.number < 0) fail(path, errno);
  struct stat status;
  if (::fstat(file.number, &status) != 0) fail(path, errno);
  if (S_ISDIR(status.st_mode)) fail(path, EISDIR);
  if (!S_ISREG(status.st_mode)) fail(path, "not a regular file");
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size > most.bytes) throw Error(most.code, fmt::format("'{}': {} bytes; expected at most {}", path.string(), size, most.bytes));
  if (const MemoryLimit limit = memory_limit(); size > limit.bytes)
    fail(path, fmt::format("its {} are too many; {} {} of memory", memory_text(size), limit.owner, memory_text(limit.bytes)));
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::read(file.number, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(path, errno);
    if (count == 0) break;  // the file became shorter meanwhile
    done += static_cast<std::size_t>(count);
  }
  bytes.resize(done);
  return bytes;
}

}  // namespace rainref
