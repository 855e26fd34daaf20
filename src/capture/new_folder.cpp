#include "capture/new_folder.h"

#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/path_text.h"
#include "base/system.h"
#include "capture/write_back.h"
#include "rainref/error.h"

namespace rainref::capture {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw Error(ExitCode::io, fmt::format("cannot write '{}': {}", path_text(path), why));
}
[[noreturn]] void fail(const fs::path& path, int error) { fail(path, reason_of(error)); }

}  // namespace

NewFolder::NewFolder(fs::path target, MayReplace may_replace) : shown_(std::move(target)), may_replace_(std::move(may_replace)) {
  // "pack/" means the folder pack.
  if (!shown_.has_filename()) shown_ = shown_.parent_path();
  try {
    target_ = followed(shown_);
    remove_leftovers(target_.parent_path());
    has_older();  // fails before the work if it may not be replaced
    parents_.emplace(target_.parent_path());
    hidden_.emplace(target_.parent_path(), Hidden::Kind::folder);
    folders_.insert(hidden_->path());
  } catch (const std::system_error& e) {
    fail(shown_, e.code().message());
  }
}

NewFolder::~NewFolder() { hidden_.reset(); }

// True if the final name is a non-empty folder. Throws if that may not be replaced.
bool NewFolder::has_older() const {
  std::error_code error;
  if (!fs::exists(target_, error)) return false;
  if (!fs::is_directory(target_, error)) fail(shown_, "a file of that name exists");
  if (fs::is_empty(target_, error)) return false;
  const std::string why = may_replace_(target_);
  if (!why.empty()) fail(shown_, why);
  return true;
}

void NewFolder::write(const std::string& path, std::span<const std::byte> bytes) {
  const fs::path shown = shown_ / utf8_path(path), file = hidden_->path() / utf8_path(path);
  const auto close = [](std::FILE* f) { std::fclose(f); };
  std::unique_ptr<std::FILE, decltype(close)> out(nullptr, close);
  {
    const Uninterrupted scope;
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    if (error) fail(shown, error.message());
    out.reset(system::stream_to_new_file(file));
  }
  if (!out) fail(shown, errno);
  for (fs::path p = file.parent_path(); folders_.insert(p).second; p = p.parent_path()) {
  }
  if (std::fwrite(bytes.data(), 1, bytes.size(), out.get()) != bytes.size()) fail(shown, errno);
  if (std::fflush(out.get()) != 0) fail(shown, errno);
  begin_write_back(system::descriptor_of(out.get()));
  files_.push_back(file);
  // A full disk may be reported only here.
  if (std::fclose(out.release()) != 0) fail(shown, errno);
}

void NewFolder::commit() {
  try {
    sync_contents();
    // Checked again: something else may have been created since.
    if (has_older())
      hidden_->replace(target_);
    else
      hidden_->become(target_);
    for (const fs::path& folder : folders_of_names()) sync_to_disk(folder);
  } catch (const std::system_error& e) {
    fail(shown_, e.code().message());
  }
  hidden_.reset();
  parents_->keep();
}

bool NewFolder::commit_if_first(const std::vector<fs::path>& also) {
  try {
    std::vector<fs::path> all(files_);
    all.insert(all.end(), folders_.begin(), folders_.end());
    all.insert(all.end(), also.begin(), also.end());
    sync_to_disk(all);
    hidden_->become(target_);  // fails if the target is a non-empty folder
    hidden_.reset();
    parents_->keep();
    return true;
  } catch (const std::system_error& e) {
    if (e.code() != std::errc::directory_not_empty && e.code() != std::errc::file_exists) fail(shown_, e.code().message());
  }
  hidden_.reset();
  parents_->keep();
  return false;
}

std::vector<fs::path> NewFolder::folders_of_names() const {
  std::vector<fs::path> folders{target_.parent_path()};
  for (const fs::path& made : parents_->made()) folders.push_back(made.parent_path());
  return folders;
}

void NewFolder::sync_contents() const {
  for (const fs::path& file : files_) sync_to_disk(file);
  for (const fs::path& folder : folders_) sync_to_disk(folder);
}

}  // namespace rainref::capture
