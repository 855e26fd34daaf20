#include "capture/new_folder.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>

#include <fmt/format.h>

#include "rainref/error.h"

namespace rainref::capture {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw Error(ExitCode::io, fmt::format("cannot write '{}': {}", path.string(), why));
}
[[noreturn]] void fail(const fs::path& path, int error) { fail(path, std::generic_category().message(error)); }

}  // namespace

NewFolder::NewFolder(fs::path target, const MayReplace& may_replace) : target_(std::move(target)) {
  // "pack/" names the folder pack.
  if (!target_.has_filename()) target_ = target_.parent_path();
  std::error_code error;
  if (fs::exists(target_, error)) {
    if (!fs::is_directory(target_, error)) fail(target_, "a file of that name exists");
    if (!fs::is_empty(target_, error)) {
      const std::string why = may_replace(target_);
      if (!why.empty()) fail(target_, why);
    }
  }
  for (fs::path p = target_.parent_path(); !p.empty() && !fs::exists(p, error); p = p.parent_path()) made_.push_back(p);
  hidden_ = hidden_name();
  fs::create_directories(hidden_, error);
  if (error) {
    for (const fs::path& p : made_) {
      std::error_code ignored;
      fs::remove(p, ignored);
    }
    fail(target_, error.message());
  }
}

NewFolder::~NewFolder() {
  std::error_code ignored;
  if (!hidden_.empty()) fs::remove_all(hidden_, ignored);
  for (const fs::path& p : made_) fs::remove(p, ignored);
}

fs::path NewFolder::hidden_name() const {
  static std::atomic<unsigned> counter{0};
  fs::path name;
  std::error_code ignored;
  // A leftover of a killed process that had the same number is stepped over.
  do {
    name = target_.parent_path() / fmt::format(".rainref-{}-{}.tmp", ::getpid(), counter.fetch_add(1));
  } while (fs::exists(fs::symlink_status(name, ignored)));
  return name;
}

void NewFolder::write(const std::string& path, std::span<const std::byte> bytes) {
  const fs::path shown = target_ / path, file = hidden_ / path;
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) fail(shown, error.message());
  const auto close = [](std::FILE* f) { std::fclose(f); };
  std::unique_ptr<std::FILE, decltype(close)> out(std::fopen(file.c_str(), "wbxe"), close);
  if (!out) fail(shown, errno);
  if (std::fwrite(bytes.data(), 1, bytes.size(), out.get()) != bytes.size()) fail(shown, errno);
  // A full disk may show only here.
  if (std::fclose(out.release()) != 0) fail(shown, errno);
}

void NewFolder::commit() {
  std::error_code error;
  fs::path old;
  if (fs::exists(target_, error)) {
    old = hidden_name();
    fs::rename(target_, old, error);
    if (error) fail(target_, error.message());
  }
  fs::rename(hidden_, target_, error);
  if (error) {
    std::error_code ignored;
    if (!old.empty()) fs::rename(old, target_, ignored);
    fail(target_, error.message());
  }
  hidden_.clear();
  made_.clear();
  if (!old.empty()) fs::remove_all(old, error);
}

}  // namespace rainref::capture
