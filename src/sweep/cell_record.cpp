#include "sweep/cell_record.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/hash.h"
#include "base/path_text.h"
#include "base/read_file.h"
#include "capture/json_field.h"
#include "capture/json_read.h"
#include "rainref/error.h"

namespace rainref::sweep {
namespace {

namespace fs = std::filesystem;
constexpr char record_name[] = "cell.json";
constexpr std::int64_t most_frame = 1'000'000;

std::string hash_text(std::span<const std::byte> bytes) { return file_hash(bytes).text(); }
bool lies_inside(const fs::path& path) {
  return !path.empty() && path.is_relative() && std::none_of(path.begin(), path.end(), [](const fs::path& part) { return part == ".."; });
}

}  // namespace

CellWriter::CellWriter(const fs::path& cell) : folder_(cell, [](const fs::path&) { return "the cell is there"; }) {}

void CellWriter::write(const std::string& path, std::span<const std::byte> bytes) {
  folder_.write(path, bytes);
  files_.push_back({path, bytes.size(), hash_text(bytes)});
}

void CellWriter::wrote(const std::string& path) {
  const std::vector<std::byte> bytes = read_file(folder() / utf8_path(path));
  files_.push_back({path, bytes.size(), hash_text(bytes)});
}

std::uintmax_t CellWriter::bytes() const {
  std::uintmax_t all = 0;
  for (const KeptFile& f : files_) all += f.bytes;
  return all;
}

// The first line contains the hash of everything after it.
bool CellWriter::finish(nlohmann::ordered_json record, std::vector<fs::path>& names) {
  record["files"] = nlohmann::ordered_json::array();
  for (const KeptFile& f : files_) record["files"].push_back({{"path", f.path}, {"bytes", f.bytes}, {"xxh3", f.hash}});
  std::string body = record.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace).substr(2) + "\n";
  const std::string text = fmt::format("{{ \"xxh3\": \"{}\",\n{}", hash_text(std::as_bytes(std::span(body))), body);
  folder_.write(record_name, std::as_bytes(std::span(text)));
  const std::vector<fs::path> of_others = std::exchange(names, folder_.folders_of_names());
  return folder_.commit_if_first(of_others);
}

CellRecord read_record(const fs::path& cell) {
  const fs::path path = cell / record_name;
  const std::vector<std::byte> bytes = read_file(path, {capture::large_json.bytes, capture::large_json.code});
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::string_view body = text.substr(std::min(text.find('\n'), text.size() - !text.empty()) + !text.empty());
  const nlohmann::ordered_json json = capture::parse_json(text, path_text(path), capture::large_json);
  const capture::JsonField from(json, path_text(path));
  if (from["xxh3"].text() != hash_text(std::as_bytes(std::span(body)))) from.refuse("is damaged");
  if (from["cell"].text() != path_text(cell.filename())) from["cell"].fail(path_text(cell.filename()));
  CellRecord record;
  std::set<std::string> names;
  const auto new_name = [&](const capture::JsonField& field, const std::string& name) {
    if (!names.insert(name).second) field.refuse(fmt::format("'{}' is there twice", name));
    return name;
  };
  if (from.has("verdict")) record.verdict = from["verdict"].text();
  if (from.has("last_frame")) {
    const std::int64_t last = from["end"].whole(1, most_frame) - 1;
    for (const capture::JsonField& line : from["last_frame"].elements()) {
      // Made from the state of another frame, under this frame's name.
      if (line["frame"].whole(0, most_frame) != last) line["frame"].fail(fmt::format("{}, the one before its end", last));
      record.last_frame.emplace_back(new_name(line, line["pass"].text() + "." + line["buffer"].text()), line["xxh3"].text());
    }
  }
  names.clear();
  for (const capture::JsonField& f : from["files"].elements()) {
    KeptFile& file = record.files.emplace_back();
    file.path = new_name(f, f["path"].text());
    if (!lies_inside(utf8_path(file.path))) f["path"].fail("a path in the cell's folder");
    file.bytes = static_cast<std::uintmax_t>(f["bytes"].whole(0, INT64_MAX));
    file.hash = f["xxh3"].text();
  }
  return record;
}

std::string damage_of(const fs::path& cell, CellRecord& record) {
  try {
    record = read_record(cell);
    for (const KeptFile& f : record.files) {
      const std::string found = hash_text(read_file(cell / utf8_path(f.path), {f.bytes, ExitCode::port_files}));
      if (found != f.hash) return fmt::format("{}: expected hash {}, found {}", path_text(cell / utf8_path(f.path)), f.hash, found);
    }
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}
std::string damage_of(const fs::path& cell) {
  CellRecord record;
  return damage_of(cell, record);
}

}  // namespace rainref::sweep
