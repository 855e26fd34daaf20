#include "sweep/table.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/hash.h"
#include "base/read_file.h"
#include "rainref/error.h"

namespace rainref::sweep {
namespace {

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  return out + "\"";
}

/// Names in the order of their first occurrence in rows.
std::vector<std::string> columns(const Table& table, std::vector<std::pair<std::string, std::string>> Row::*pairs) {
  std::vector<std::string> names;
  std::map<std::string, bool> known;
  for (const Row& row : table.rows)
    for (const auto& [key, value] : row.*pairs)
      if (known.try_emplace(key, true).second) names.push_back(key);
  return names;
}
std::string value_of(const std::vector<std::pair<std::string, std::string>>& pairs, const std::string& name) {
  for (const auto& [key, value] : pairs)
    if (key == name) return value;
  return "";
}

void read_row(const Cell& cell, const Store& store, Row& row) {
  row.state = state_of(cell, store, row.sentence);
  if (row.state != State::done) return;
  CellRecord record;
  row.sentence = damage_of(store.cell(cell.id), record);
  if (!row.sentence.empty()) {
    row.state = State::damaged;
    return;
  }
  row.files = std::move(record.files);
  row.hashes = std::move(record.last_frame);
  row.sentence = std::move(record.verdict);
}

/// Joins hash lines of consecutive cells until one is missing.
class Fold {
 public:
  void add(const Cell& cell, const Row& row, const Store& store) {
    const auto has_lines = [](const KeptFile& f) { return f.path == "hashes.txt"; };
    is_whole_ = is_whole_ && row.state == State::done && std::any_of(row.files.begin(), row.files.end(), has_lines);
    if (!is_whole_) return;
    hasher_.add(read_file(store.cell(cell.id) / "hashes.txt"));
    end_ = cell.end;
  }
  std::int64_t end() const { return end_; }
  std::string hash() const { return hasher_.finish().text(); }

 private:
  Hasher hasher_;
  std::int64_t end_ = 0;
  bool is_whole_ = true;
};

}  // namespace

std::string csv_line(const std::vector<std::string>& fields) {
  std::vector<std::string> quoted;
  for (const std::string& f : fields) quoted.push_back(csv_field(f));
  return fmt::format("{}\n", fmt::join(quoted, ","));
}

const char* name(State state) {
  constexpr std::array names{"done", "missing", "refused", "failed", "damaged"};
  return names[static_cast<std::size_t>(state)];
}

std::int64_t Table::count(State state) const {
  return std::count_if(rows.begin(), rows.end(), [&](const Row& row) { return row.state == state; });
}

State state_of(const Cell& cell, const Store& store, std::string& sentence) {
  if (store.has(cell.id)) return State::done;
  const std::optional<Failure> failure = store.failure(cell.id);
  if (!failure) return State::missing;
  sentence = failure->sentence;
  return failure->code == 2 ? State::refused : State::failed;
}

Table read_table(const Cells& cells, const Store& store) {
  Table table;
  const std::vector<Cell>& all = cells.all();
  for (std::size_t i = 0; i < all.size(); ++i) {
    Row& row = table.rows.emplace_back();
    row.values = cells.values(all[i]);
    read_row(all[i], store, row);
  }
  for (std::size_t i = 0; i < all.size();) {
    Fold fold;
    const std::size_t begin = i;
    for (; i < all.size() && all[i].film == all[begin].film && (i == begin || !all[begin].film.empty()); ++i)
      fold.add(all[i], table.rows[i], store);
    if (fold.end() == 0) continue;
    std::vector<std::string> words;
    for (const auto& [key, value] : table.rows[begin].values) words.push_back(key + " " + value);
    table.films.push_back({fmt::format("{}", fmt::join(words, ", ")), all[begin].first, fold.end(), fold.hash()});
  }
  return table;
}

std::string table_csv(const Cells& cells, const Table& table) {
  const std::vector<std::string> values = columns(table, &Row::values), hashes = columns(table, &Row::hashes);
  std::vector<std::string> head{"cell", "id", "state", "sentence", "first", "end"};
  head.insert(head.end(), values.begin(), values.end());
  head.insert(head.end(), hashes.begin(), hashes.end());
  head.insert(head.end(), {"folder", "files"});
  std::string text = csv_line(head);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Cell& cell = cells.all()[i];
    const Row& row = table.rows[i];
    std::vector<std::string> line{std::to_string(i),       cell.id, name(row.state), row.sentence, std::to_string(cell.first),
                                  std::to_string(cell.end)};
    for (const std::string& key : values) line.push_back(value_of(row.values, key));
    for (const std::string& key : hashes) line.push_back(value_of(row.hashes, key));
    std::vector<std::string> files;
    for (const KeptFile& f : row.files) files.push_back(f.path);
    line.push_back(files.empty() ? "" : Store::folder_of(cell.id));
    line.push_back(fmt::format("{}", fmt::join(files, " ")));
    text += csv_line(line);
  }
  return text;
}

std::string films_csv(const Table& table) {
  std::string text = csv_line({"run", "first", "end", "scene_hash"});
  for (const Film& film : table.films)
    text += csv_line({film.words, std::to_string(film.first), std::to_string(film.end), film.scene_hash});
  return text;
}

}  // namespace rainref::sweep
