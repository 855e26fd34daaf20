#include "sweep/cell_record.h"

#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/hash.h"
#include "base/read_file.h"
#include "rainref/error.h"

namespace rainref::sweep {
namespace {

namespace fs = std::filesystem;
constexpr const char* record_name = "cell.json";

std::string hash_text(std::span<const std::byte> bytes) { return file_hash(bytes).text(); }

}  // namespace

CellWriter::CellWriter(const fs::path& cell) : folder_(cell, [](const fs::path&) { return "the cell is there"; }) {}

void CellWriter::write(const std::string& path, std::span<const std::byte> bytes) {
  folder_.write(path, bytes);
  files_.push_back({path, bytes.size(), hash_text(bytes)});
}

void CellWriter::wrote(const std::string& path) {
  const std::vector<std::byte> bytes = read_file(folder() / path);
  files_.push_back({path, bytes.size(), hash_text(bytes)});
}

std::uintmax_t CellWriter::bytes() const {
  std::uintmax_t all = 0;
  for (const KeptFile& f : files_) all += f.bytes;
  return all;
}

// The first line holds the hash of all that follows it.
bool CellWriter::finish(nlohmann::ordered_json record, std::vector<fs::path>& names) {
  record["files"] = nlohmann::ordered_json::array();
  for (const KeptFile& f : files_) record["files"].push_back({{"path", f.path}, {"bytes", f.bytes}, {"xxh3", f.hash}});
  std::string body = record.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace).substr(2) + "\n";
  const std::string text = fmt::format("{{ \"xxh3\": \"{}\",\n{}", hash_text(std::as_bytes(std::span(body))), body);
  folder_.write(record_name, std::as_bytes(std::span(text)));
  const std::vector<fs::path> of_others = std::exchange(names, folder_.folders_of_names());
  return folder_.commit_if_first(of_others);
}

nlohmann::ordered_json read_record(const fs::path& cell) {
  const std::vector<std::byte> bytes = read_file(cell / record_name);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::string_view body = text.substr(std::min(text.find('\n'), text.size() - !text.empty()) + !text.empty());
  nlohmann::ordered_json record = nlohmann::ordered_json::parse(text, nullptr, false);
  const bool is_whole = record.is_object() && record.contains("xxh3") && record["xxh3"] == hash_text(std::as_bytes(std::span(body)));
  if (!is_whole) throw Error(ExitCode::port_files, fmt::format("{}: is damaged", (cell / record_name).string()));
  return record;
}

std::vector<KeptFile> files_of(const nlohmann::ordered_json& record) {
  std::vector<KeptFile> files;
  for (const auto& f : record.at("files"))
    files.push_back({f.at("path").get<std::string>(), f.at("bytes").get<std::uintmax_t>(), f.at("xxh3").get<std::string>()});
  return files;
}

std::string damage_of(const fs::path& cell) {
  try {
    for (const KeptFile& f : files_of(read_record(cell))) {
      const std::vector<std::byte> bytes = read_file(cell / f.path);
      const std::string found = hash_text(bytes);
      if (found != f.hash) return fmt::format("{}: expected hash {}, found {}", (cell / f.path).string(), f.hash, found);
    }
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

}  // namespace rainref::sweep
