#include "judge/port_files.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/path_text.h"
#include "port_dump/read_buffer.h"
#include "registry/registry.h"

namespace rainref::judge {

namespace fs = std::filesystem;

void FileFaults::require_files() const {
  if (std::any_of(faults_.begin(), faults_.end(),
                  [](const FileFault& f) { return f.code == ExitCode::usage || f.code == ExitCode::internal; }))
    throw files_error(faults_);
}

Error files_error(const std::vector<FileFault>& faults) {
  constexpr std::size_t shown = 8;
  const auto rank = [](ExitCode code) {
    constexpr ExitCode order[] = {ExitCode::internal, ExitCode::io, ExitCode::usage, ExitCode::port_files, ExitCode::fail};
    return std::find(std::begin(order), std::end(order), code) - std::begin(order);
  };
  std::vector<FileFault> all = faults;
  std::stable_sort(all.begin(), all.end(), [&](const FileFault& a, const FileFault& b) { return rank(a.code) < rank(b.code); });
  if (all.size() == 1) return {all.front().code, all.front().text};
  std::vector<std::string> first;
  for (std::size_t i = 0; i < std::min(shown, all.size()); ++i) first.push_back(all[i].text);
  const std::string more = all.size() > shown ? fmt::format("; and {} more", all.size() - shown) : "";
  return {all.front().code, fmt::format("{} files are missing or cannot be used: {}{}", all.size(), fmt::join(first, "; "), more)};
}

std::string unusable_text(const std::vector<FileFault>& faults, const std::string& id) {
  std::vector<std::string> buffers;
  for (const FileFault& f : faults)
    if (f.id == id) buffers.push_back(f.output);
  return fmt::format("{}", fmt::join(buffers, ", "));
}

PortFiles::PortFiles(fs::path folder, const std::string& effect, const std::string& variant, std::shared_ptr<ReadBuffers> buffers)
    : folder_(std::move(folder)), buffers_(std::move(buffers)) {
  const effect::Effect* own = registry::find(effect);
  for (const capture::BufferInfo& buffer : own ? own->info->buffers : std::vector<capture::BufferInfo>())
    if ((buffer.variant.empty() || buffer.variant == variant) && (buffer.alpha == "1" || buffer.alpha == "opaque"))
      alpha_1_.insert(buffer.name);
  std::error_code error;
  if (!fs::is_directory(folder_, error)) {
    throw Error(ExitCode::port_files, fmt::format("{}: expected a folder of a port, found {}", path_text(folder_),
                                                  fs::exists(folder_, error) ? "a file" : "none"));
  }
  info_ = port_dump::read_port_info(folder_);
  if (!own) return;
  std::vector<std::string> names;
  for (const capture::BufferInfo& buffer : own->info->buffers) names.push_back(buffer.name);
  for (const auto& [name, sources] : info_.encodings)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw Error(ExitCode::port_files, fmt::format("'{}': encodings: expected a buffer of {}, found '{}'{}",
                                                    path_text(folder_ / "port.json"), effect, name, did_you_mean(name, names)));
}

capture::Array PortFiles::read(const fs::path& run, const std::string& stem, const capture::Array& expected, port_dump::KeptForm* kept) {
  // A level may be read alone, so the file name does not identify the buffer.
  const std::string key = fmt::format("{} {} {}x{} {}", path_text(folder_ / run / utf8_path(stem)), rainref::info(expected.format).name,
                                      expected.width, expected.height, expected.levels.size());
  if (buffers_ && buffers_->arrays.contains(key)) {
    const auto open = buffers_->kept.find(key);
    if (open != buffers_->kept.end()) note_kept(stem, open->second);
    if (kept) *kept = open == buffers_->kept.end() ? nullptr : open->second;
    return buffers_->arrays[key];
  }
  port_dump::ReadNotes notes;
  const bool is_opaque = alpha_1_.contains(stem.substr(stem.find('.') + 1));  // after "in." or "out."
  capture::Array array = port_dump::read_port_buffer(folder_ / run, stem, expected, info_, notes,
                                                     is_opaque ? port_dump::Alpha::one : port_dump::Alpha::stored);
  for (const std::string& note : notes.lines)
    if (std::find(notes_.begin(), notes_.end(), note) == notes_.end()) notes_.push_back(note);
  note_kept(stem, notes.kept);
  if (kept) *kept = notes.kept;
  if (buffers_) {
    constexpr std::size_t most = std::size_t{128} << 20;  // a small pack's buffers are a few MiB
    std::size_t bytes = buffers_->bytes;
    for (const std::vector<std::byte>& level : array.levels) bytes += level.size();
    if (bytes <= most) {
      buffers_->arrays[key] = array;
      if (notes.kept) buffers_->kept[key] = notes.kept;
      buffers_->bytes = bytes;
    }
  }
  return array;
}

void PortFiles::note_kept(const std::string& stem, const port_dump::KeptForm& form) {
  if (!form) return;
  const std::string buffer = port_dump::buffer_of(stem);
  if (form->widest > 0) rounded_[buffer] = std::max(rounded_[buffer], form->widest);
  if (!form->from_expected.empty()) from_expected_[buffer] = form->from_expected;
}

std::vector<std::string> PortFiles::notes() const {
  std::vector<std::string> out = notes_;
  for (const auto& [buffer, widest] : rounded_)
    out.push_back(fmt::format("encodings.{}: the port's own form rounds, so its envelopes are wider, by at most {:.3g} to each side",
                              buffer, widest));
  for (const auto& [buffer, members] : from_expected_)
    out.push_back(fmt::format("encodings.{}: without {}: record i is judged as the pack's record i", buffer, fmt::join(members, ", ")));
  return out;
}

void require_apart(const fs::path& pack, const fs::path& port, ExitCode code) {
  std::error_code error;
  if (!fs::equivalent(pack, port, error)) return;
  throw Error(
      code,
      fmt::format("{}: expected what the port itself wrote, found the pack's own '{}': its expected outputs would be judged by themselves",
                  path_text(port), path_text(pack)));
}

bool PortFiles::has_output(const std::string& run) const {
  const std::filesystem::path of_pass = (folder_ / utf8_path(run)).parent_path();
  std::error_code error;
  if (!std::filesystem::exists(of_pass, error)) return false;
  for (std::filesystem::recursive_directory_iterator i(of_pass, error), end; !error && i != end; i.increment(error)) {
    if (path_text(i->path().filename()).starts_with("out")) return true;
    if (i.depth() > 0) i.disable_recursion_pending();
  }
  return static_cast<bool>(error);  // an unreadable folder is rejected later, by name
}

}  // namespace rainref::judge
