#include "base/path_text.h"
#include "sweep/database.h"

#include <memory>
#include <optional>
#include <set>
#include <variant>

#include <fmt/format.h>
#include <sqlite3.h>

#include "base/atomic_file.h"
#include "base/hidden.h"
#include "base/number_text.h"
#include "base/read_file.h"
#include "rainref/error.h"
#include "simulation/opened.h"

namespace rainref::sweep {
namespace {

constexpr const char* schema = R"(
PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF;
CREATE TABLE cells (cell INTEGER PRIMARY KEY, id TEXT NOT NULL, state TEXT NOT NULL, sentence TEXT NOT NULL, first INTEGER NOT NULL, "end" INTEGER NOT NULL);
CREATE TABLE parameters (cell INTEGER NOT NULL, key TEXT NOT NULL, value, PRIMARY KEY (cell, key)) WITHOUT ROWID;
CREATE TABLE hashes (cell INTEGER NOT NULL, pass TEXT NOT NULL, buffer TEXT NOT NULL, hash TEXT NOT NULL, PRIMARY KEY (cell, pass, buffer)) WITHOUT ROWID;
CREATE TABLE files (cell INTEGER NOT NULL, path TEXT NOT NULL, bytes INTEGER NOT NULL, xxh3 TEXT NOT NULL, PRIMARY KEY (cell, path)) WITHOUT ROWID;
CREATE TABLE films (run TEXT NOT NULL, first INTEGER NOT NULL, "end" INTEGER NOT NULL, scene_hash TEXT NOT NULL);
BEGIN)";

using Value = std::variant<std::int64_t, double, std::string>;

/// Keys with numeric values. Labels, file names and words stay text, whatever they look like.
std::set<std::string> numeric_keys() {
  std::set<std::string> keys;
  for (const scene::Effect& effect : simulation::effect_table().effects)
    for (const scene::Parameter& p : scene::scene_parameters(effect, simulation::effect_table()))
      if (p.type == scene::Type::integer || p.type == scene::Type::real) keys.insert(p.key);
  return keys;
}
/// A number if the text is one.
Value typed(const std::string& text) {
  if (const std::optional<std::int64_t> whole = whole_from<std::int64_t>(text)) return *whole;
  if (const std::optional<double> real = number_from<double>(text)) return *real;
  return text;
}

class Database {
 public:
  explicit Database(const std::filesystem::path& path) {
    check(sqlite3_open(path_text(path).c_str(), &handle_));
    run(schema);
  }
  ~Database() { sqlite3_close(handle_); }
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void run(const char* sql) { check(sqlite3_exec(handle_, sql, nullptr, nullptr, nullptr)); }
  void insert(const char* sql, const std::vector<Value>& values) {
    sqlite3_stmt* made = nullptr;
    if (sql != last_) {
      check(sqlite3_prepare_v2(handle_, sql, -1, &made, nullptr));
      statement_.reset(made);
      last_ = sql;
    }
    check(sqlite3_reset(statement_.get()));
    for (std::size_t i = 0; i < values.size(); ++i) {
      const int at = static_cast<int>(i) + 1;
      if (const auto* number = std::get_if<std::int64_t>(&values[i]))
        check(sqlite3_bind_int64(statement_.get(), at, *number));
      else if (const auto* real = std::get_if<double>(&values[i]))
        check(sqlite3_bind_double(statement_.get(), at, *real));
      else
        check(sqlite3_bind_text(statement_.get(), at, std::get<std::string>(values[i]).c_str(), -1, SQLITE_TRANSIENT));
    }
    if (sqlite3_step(statement_.get()) != SQLITE_DONE) check(SQLITE_ERROR);
  }
  void close() {
    statement_.reset();
    run("COMMIT");
    check(sqlite3_close(handle_));
    handle_ = nullptr;
  }

 private:
  void check(int result) {
    if (result != SQLITE_OK)
      throw Error(ExitCode::io, fmt::format("SQLite: {}", handle_ ? sqlite3_errmsg(handle_) : sqlite3_errstr(result)));
  }
  struct Finalize {
    void operator()(sqlite3_stmt* s) const { sqlite3_finalize(s); }
  };
  sqlite3* handle_ = nullptr;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  const char* last_ = nullptr;
};

void fill(Database& to, const Cells& cells, const Table& table) {
  const auto number = [](std::size_t i) { return static_cast<std::int64_t>(i); };
  const std::set<std::string> numeric = numeric_keys();
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Cell& cell = cells.all()[i];
    const Row& row = table.rows[i];
    to.insert("INSERT INTO cells VALUES (?, ?, ?, ?, ?, ?)", {number(i), cell.id, name(row.state), row.sentence, cell.first, cell.end});
  }
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    for (const auto& [key, value] : table.rows[i].values)
      to.insert("INSERT INTO parameters VALUES (?, ?, ?)", {number(i), key, numeric.contains(key) ? typed(value) : Value(value)});
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    for (const auto& [key, hash] : table.rows[i].hashes)
      to.insert("INSERT INTO hashes VALUES (?, ?, ?, ?)", {number(i), key.substr(0, key.find('.')), key.substr(key.find('.') + 1), hash});
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    for (const KeptFile& f : table.rows[i].files)
      to.insert("INSERT INTO files VALUES (?, ?, ?, ?)", {number(i), f.path, static_cast<std::int64_t>(f.bytes), f.hash});
  for (const Film& f : table.films) to.insert("INSERT INTO films VALUES (?, ?, ?, ?)", {f.words, f.first, f.end, f.scene_hash});
}

}  // namespace

void write_database(const std::filesystem::path& path, const Cells& cells, const Table& table) {
  try {
    Hidden folder(path.parent_path(), Hidden::Kind::folder);
    const std::filesystem::path made = folder.path() / "table.sqlite";
    Database database(made);
    fill(database, cells, table);
    database.close();
    write_file(path, read_file(made));
  } catch (const std::system_error& e) {
    throw Error(ExitCode::io, fmt::format("cannot write '{}': {}", path_text(path), e.code().message()));
  }
}

}  // namespace rainref::sweep
