// POSIX, also of emscripten.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#if __has_include(<sys/random.h>)
#include <sys/random.h>  // getentropy on macOS
#endif

#include <cerrno>

#include "base/system.h"

namespace rainref::system {
namespace {

namespace fs = std::filesystem;

Found found_of(const struct stat& status) {
  const Kind kind = S_ISREG(status.st_mode) ? Kind::file : S_ISDIR(status.st_mode) ? Kind::folder : Kind::other;
  return {kind,
          status.st_uid == ::geteuid(),
          (status.st_mode & (S_IWGRP | S_IWOTH)) != 0,
          status.st_dev,
          status.st_ino,
          static_cast<std::uint64_t>(status.st_size)};
}

}  // namespace

int open(const fs::path& path, unsigned how) {
  int flags = O_CLOEXEC | O_NOCTTY | ((how & writing) == 0 ? O_RDONLY : (how & reading) != 0 ? O_RDWR : O_WRONLY);
  if (how & creating) flags |= O_CREAT;
  if (how & new_only) flags |= O_CREAT | O_EXCL;
  if (how & no_link) flags |= O_NOFOLLOW;
  if (how & no_wait) flags |= O_NONBLOCK;
  return ::open(path.c_str(), flags, 0666);
}
int open_folder_lock(const fs::path& folder) { return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC); }
int close(int descriptor) { return ::close(descriptor) == 0 || errno == EINTR ? 0 : -1; }
std::ptrdiff_t read(int descriptor, void* to, std::size_t bytes) { return ::read(descriptor, to, bytes); }
std::ptrdiff_t write(int descriptor, const void* from, std::size_t bytes) { return ::write(descriptor, from, bytes); }
int duplicate(int descriptor) { return ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0); }
int sync(int descriptor) { return ::fsync(descriptor); }
int make_private(int descriptor) { return ::fchmod(descriptor, S_IRUSR | S_IWUSR); }

std::FILE* stream_to_read(const fs::path& path) { return std::fopen(path.c_str(), "rbe"); }
std::FILE* stream_to_new_file(const fs::path& path) { return std::fopen(path.c_str(), "wbxe"); }
int descriptor_of(std::FILE* stream) { return ::fileno(stream); }

Found found(int descriptor) {
  struct stat status {};
  return ::fstat(descriptor, &status) == 0 ? found_of(status) : Found{};
}
Found found(const fs::path& path, bool follows_links) {
  struct stat status {};
  return (follows_links ? ::stat(path.c_str(), &status) : ::lstat(path.c_str(), &status)) == 0 ? found_of(status) : Found{};
}

int make_folder(const fs::path& path, bool is_private) { return ::mkdir(path.c_str(), is_private ? 0700 : 0777); }
int remove_folder(const fs::path& path) { return ::rmdir(path.c_str()); }
int remove_file(const fs::path& path) { return ::unlink(path.c_str()); }
void release(int&) {}

int random_bits(std::uint64_t& bits) { return ::getentropy(&bits, sizeof bits); }

}  // namespace rainref::system
