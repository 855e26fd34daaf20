#include "base/folders.h"

#include <algorithm>
#include <cerrno>
#include <exception>
#include <future>

#include "base/system.h"

namespace rainref {

namespace fs = std::filesystem;

fs::path followed(fs::path path) {
  constexpr int most_links = 40;  // the kernel's limit
  for (int i = 0; i <= most_links; ++i) {
    if (!path.has_filename() && path.has_relative_path()) path = path.parent_path();
    std::error_code error;
    if (!fs::is_symlink(fs::symlink_status(path, error))) return path;
    const fs::path to = fs::read_symlink(path, error);
    if (error) throw_system_error(error.value());
    path = path.parent_path() / to;  // only `to` if it is absolute
  }
  throw_system_error(ELOOP);
}

MadeFolders::MadeFolders(const fs::path& folder) {
  std::vector<fs::path> missing;  // innermost first
  std::error_code error;
  for (fs::path p = folder; !p.empty() && !fs::exists(fs::status(p, error)); p = p.parent_path()) {
    missing.push_back(p);
    if (p == p.parent_path()) break;
  }
  const Uninterrupted scope;
  for (auto p = missing.rbegin(); p != missing.rend(); ++p) {
    if (system::make_folder(*p, false) == 0) {
      made_.insert(made_.begin(), *p);
    } else if (const int why = errno; why != EEXIST || !fs::is_directory(*p, error)) {
      // A dangling link blocks the path like a file.
      remove();
      throw_system_error(why);
    }
  }
  if (!folder.empty() && !fs::is_directory(folder, error)) {
    remove();
    throw_system_error(ENOTDIR);
  }
  undo_.emplace([this] { remove(); });
}

MadeFolders::~MadeFolders() { remove(); }

void MadeFolders::keep() {
  const Uninterrupted scope;
  made_.clear();
}

void MadeFolders::remove() noexcept {
  const Uninterrupted scope;
  for (const fs::path& p : made_) system::remove_folder(p);
  made_.clear();
}

void sync_to_disk(const fs::path& path) {
  const int descriptor = system::open(path.empty() ? fs::path(".") : path, system::reading);
  if (descriptor < 0) throw_system_error(errno);
  const int error = system::sync(descriptor) == 0 || errno == EINVAL ? 0 : errno;
  system::close(descriptor);
  if (error != 0) throw_system_error(error);
}

void sync_to_disk(std::span<const fs::path> paths) {
  constexpr std::size_t at_once = 16;
  std::exception_ptr failure;
  for (std::size_t first = 0; first < paths.size(); first += at_once) {
    std::vector<std::future<void>> waiting;
    for (const fs::path& path : paths.subspan(first, std::min(at_once, paths.size() - first))) {
      const auto sync = [&path] { sync_to_disk(path); };
      try {
        waiting.push_back(std::async(std::launch::async, sync));
      } catch (const std::system_error&) {  // no thread available: one after the other
        waiting.push_back(std::async(std::launch::deferred, sync));
      }
    }
    for (std::future<void>& one : waiting) {
      try {
        one.get();
      } catch (...) {
        if (!failure) failure = std::current_exception();
      }
    }
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace rainref
