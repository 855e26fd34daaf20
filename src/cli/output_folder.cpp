#include "cli/output_folder.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/hidden.h"
#include "base/number_text.h"
#include "base/path_text.h"
#include "capture/manifest_write.h"
#include "capture/pack_read.h"
#include "cli/progress.h"
#include "rainref/error.h"
#include "registry/registry.h"

namespace rainref::cli {
namespace {

namespace fs = std::filesystem;

std::optional<RunPicture> run_picture_of(const std::string& name) {
  const std::size_t first = name.find('.'), second = name.find('.', first + 1);
  if (first == std::string::npos || second == std::string::npos || !registry::find(name.substr(0, first))) return {};
  const std::string digits = name.substr(first + 1, second - first - 1), ending = name.substr(second);
  const std::optional<std::int64_t> frame = whole_from<std::int64_t>(digits);
  if (!frame || *frame < 0 || digits.size() < 4 || digits.front() == '-') return {};
  using Kind = RunPicture::Kind;
  const bool is_truth = ending.starts_with(".truth.") && ending.ends_with(".png");
  if (!is_truth && ending != ".png" && ending != ".exr") return {};
  return RunPicture{is_truth ? Kind::truth : ending == ".png" ? Kind::png : Kind::exr, name.substr(0, first), *frame};
}

/// Pictures name their producer in their first bytes; comparisons with truth have only their name.
bool is_of_rainref(const fs::path& path, RunPicture::Kind kind) {
  std::error_code error;
  if (!fs::is_regular_file(fs::symlink_status(path, error))) return false;
  if (kind == RunPicture::Kind::truth) return true;
  std::array<char, 1 << 14> first{};
  std::ifstream in(path, std::ios::binary);
  in.read(first.data(), first.size());
  return std::string_view(first.data(), static_cast<std::size_t>(in.gcount())).find("rainref:version") != std::string_view::npos;
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& folder) : folder_(folder), summary_(folder / "summary.json") {
  const auto fail = [&](const std::string& why) { throw Error(ExitCode::io, fmt::format("{}: {}", path_text(folder), why)); };
  try {
    made_.emplace(followed(folder));
  } catch (const std::system_error& e) {
    std::error_code ignored;
    const bool is_file = fs::exists(folder, ignored) && !fs::is_directory(folder, ignored);
    fail(fmt::format("cannot make this folder: {}", is_file ? "a file of that name exists" : e.code().message()));
  }
  try {
    lock_.emplace(folder);
  } catch (const std::system_error& e) {
    if (e.code() == std::errc::operation_would_block) fail("another run writes to this folder");
    fail(fmt::format("cannot write there: {}", e.code().message()));
  }
  remove_leftovers(folder);
}

void OutputFolder::require_one_run(const RunOptions& options, const Checkpoint& checkpoint, bool goes_on, const Writes& writes) {
  std::error_code error;
  std::set<std::int64_t> frames;  // of the other pictures
  for (fs::directory_iterator i(folder_, error), end; !error && i != end; i.increment(error)) {
    const std::optional<RunPicture> picture = run_picture_of(path_text(i->path().filename()));
    if (!picture || !is_of_rainref(i->path(), picture->kind)) continue;
    const bool is_written = writes(*picture);
    (is_written ? replaced_ : others_).push_back(i->path());
    if (!is_written) frames.insert(picture->frame);
  }
  const fs::path captured = folder_ / "capture";
  removes_capture_ = options.capture == RunOptions::none && fs::exists(captured / capture::manifest_name, error);
  const auto refuse = [&](const std::string& why) { throw Error(ExitCode::usage, fmt::format("{}: {}", path_text(folder_), why)); };
  if (options.overwrite) {
    if (!removes_capture_) return;
    try {
      if (const std::string spare = capture::Pack(captured).file_beside(); !spare.empty())
        refuse(fmt::format("--overwrite: expected a capture of rainref alone in capture/, found '{}' beside it", spare));
    } catch (const Error& e) {
      if (e.code() == ExitCode::usage) throw;
      refuse(fmt::format("--overwrite: expected a capture of rainref in capture/, found none: {}", e.what()));
    }
    return;
  }
  constexpr const char* ways = "--overwrite removes what that run left, -o names another folder";
  if (checkpoint.bytes() && !goes_on)
    refuse("expected no other run's results, found the checkpoint.state of one that was killed: --resume goes on from it, " +
           std::string(ways));
  const bool is_one_look_after_another = options.output.empty() && frames.size() <= 1;
  if (!others_.empty() && !is_one_look_after_another) {
    std::sort(others_.begin(), others_.end());
    refuse(fmt::format("expected no other run's results, found {} that this run does not write, such as {}: {}",
                       counted(static_cast<long long>(others_.size()), "picture"), path_text(others_.front().filename()), ways));
  }
  if (removes_capture_) refuse(fmt::format("expected no other run's results, found capture/: {}", ways));
}

void OutputFolder::forget_older_run(const Checkpoint& checkpoint, bool goes_on) {
  if (std::exchange(is_new_, true)) return;
  if (!goes_on) checkpoint.remove();
  try {
    const fs::path older = followed(summary_);
    if (fs::is_regular_file(older)) remove(older);
  } catch (const std::system_error& e) {
    throw Error(ExitCode::io, fmt::format("{}: cannot be removed: {}", path_text(summary_), e.code().message()));
  }
  for (const fs::path& path : others_) remove(path);
  // If this run is killed, an earlier run's pictures must not remain beside its own.
  if (!goes_on)
    for (const fs::path& path : replaced_) remove(path);
  if (removes_capture_) remove(folder_ / "capture");
}

void OutputFolder::remove(const fs::path& path) const {
  std::error_code error;
  fs::remove_all(path, error);
  if (error) throw Error(ExitCode::io, fmt::format("{}: cannot be removed: {}", path_text(path), error.message()));
}

}  // namespace rainref::cli
