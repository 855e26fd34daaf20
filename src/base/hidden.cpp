#include "base/hidden.h"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/file_lock.h"
#include "base/path_text.h"
#include "base/system.h"

namespace rainref {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view prefix = ".rainref-", making = ".tmp", replaced = ".old";
constexpr std::size_t digits = 16;

// Opens and locks this user's own unfinished file or folder; -1 if that is impossible.
int lock_leftover(const fs::path& path) {
  const system::Found found = system::found(path, false);
  const bool is_folder = found.kind == system::Kind::folder;
  if (!found.is_mine || (!is_folder && found.kind != system::Kind::file)) return -1;
  // NFS locks only files that are open for writing.
  const int descriptor = is_folder ? system::open_folder_lock(path)
                                   : system::open(path, system::reading | system::writing | system::no_wait | system::no_link);
  if (descriptor < 0) return -1;
  if (lock_file(descriptor) == FileLock::mine && is_still(descriptor, path)) return descriptor;
  system::close(descriptor);
  return -1;
}

bool has_hidden_form(std::string_view name, std::string_view end) {
  if (name.size() != prefix.size() + digits + end.size() || !name.starts_with(prefix) || !name.ends_with(end)) return false;
  return name.substr(prefix.size(), digits).find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

// Restores a folder that was being replaced; it lies under its own name in a folder with a hidden name. Returns false if its place is free
// but it cannot be moved there.
bool put_back(const fs::path& holder) {
  for (const auto& entry : fs::directory_iterator(holder)) {
    const fs::path place = holder.parent_path() / entry.path().filename();
    if (system::found(place, false).kind != system::Kind::nothing) continue;  // the new folder is already in place
    if (errno != ENOENT || system::rename(entry.path(), place) != 0) return false;
  }
  return true;
}

}  // namespace

std::string Hidden::random_name(std::string_view end) {
  std::uint64_t number = 0;
  if (system::random_bits(number) != 0) throw_system_error(errno);
  return fmt::format("{}{:016x}{}", prefix, number, end);
}

Hidden::Hidden(const fs::path& parent, Kind kind, const std::function<std::string()>& name) {
  const Uninterrupted scope;
  do {
    path_ = parent / utf8_path(name());
  } while (!make(kind));
  undo_.emplace([this] {
    remove();
    system::release(descriptor_);
  });
}

// Returns false if the name is taken, or if another process treated this as a leftover before it was locked.
bool Hidden::make(Kind kind) {
  if (kind == Kind::file) {
    descriptor_ = system::open(path_, system::writing | system::new_only);
    if (descriptor_ < 0 && errno != EEXIST && errno != EINTR) throw_system_error(errno);
  } else {
    if (system::make_folder(path_, kind == Kind::private_folder) != 0) {
      if (errno != EEXIST) throw_system_error(errno);
      return false;
    }
    descriptor_ = system::open_folder_lock(path_);
    if (descriptor_ < 0 && errno != ENOENT) {
      const int error = errno;
      system::remove_folder(path_);
      throw_system_error(error);
    }
  }
  if (descriptor_ < 0) return false;
  if (lock_file(descriptor_) != FileLock::taken && system::found(path_, false).kind != system::Kind::nothing) return true;
  system::close(std::exchange(descriptor_, -1));
  return false;
}

Hidden::~Hidden() {
  {
    const Uninterrupted scope;
    remove();
    undo_.reset();
  }
  if (descriptor_ >= 0) system::close(descriptor_);  // and with it the lock
}

void Hidden::remove() noexcept {
  std::error_code ignored;
  if (!is_gone_) fs::remove_all(path_, ignored);
  is_gone_ = true;
}

void Hidden::become(const fs::path& target) {
  const Uninterrupted scope;
  if (system::rename(path_, target) != 0) throw_system_error(errno);
  is_gone_ = true;
}

void Hidden::replace(const fs::path& target) {
  const Uninterrupted scope;
  if (system::exchange(path_, target)) return;  // the old folder now has the hidden name
  Hidden holder(path_.parent_path(), Kind::folder, [] { return random_name(replaced); });
  const fs::path old = holder.path_ / target.filename();
  if (system::rename(target, old) != 0) throw_system_error(errno);
  if (system::rename(path_, target) != 0) {
    const int error = errno;
    if (system::rename(old, target) != 0) holder.is_gone_ = true;  // it stays, with the old folder in it
    throw_system_error(error);
  }
  is_gone_ = true;
}

bool is_hidden_name(std::string_view name) { return has_hidden_form(name, making); }

void remove_leftovers(const fs::path& folder) noexcept {
  try {
    std::vector<fs::path> found;
    std::error_code error;
    for (fs::directory_iterator i(folder.empty() ? fs::path(".") : folder, error), end; !error && i != end; i.increment(error)) {
      const std::string name = path_text(i->path().filename());
      if (has_hidden_form(name, making) || has_hidden_form(name, replaced)) found.push_back(i->path());
    }
    for (const fs::path& path : found) {
      const int descriptor = lock_leftover(path);
      if (descriptor < 0) continue;
      if (path_text(path.extension()) != replaced || put_back(path)) fs::remove_all(path, error);
      system::close(descriptor);
    }
  } catch (...) {
    // A failure here must not disturb the caller's work.
  }
}

}  // namespace rainref
