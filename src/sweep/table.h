// Results of a plan's cells as rows: the same bytes for any place and order in which they were made.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sweep/cell_record.h"
#include "sweep/cells.h"
#include "sweep/store.h"

namespace rainref::sweep {

enum class State : std::uint8_t { done, missing, refused, failed, damaged };
const char* name(State state);

struct Row {
  State state = State::missing;
  std::string sentence;                                     ///< why it is not done; for a judged cell its verdict
  std::vector<std::pair<std::string, std::string>> values;  ///< of the axes
  std::vector<std::pair<std::string, std::string>> hashes;  ///< "pass.buffer" of the last frame, and its hash
  std::vector<KeptFile> files;
};
/// The run to which chunks belong, if their hashes were kept: the last line of its `rainref hash`.
struct Film {
  std::string words;
  std::int64_t first = 0, end = 0;  ///< frames present without a gap
  std::string scene_hash;           ///< hash of these
};
struct Table {
  std::vector<Row> rows;    ///< one for each cell
  std::vector<Film> films;  ///< in the order of their first cells
  std::int64_t count(State state) const;
};

/// Reads every record and checks the hash of every file.
Table read_table(const Cells& cells, const Store& store);
/// The state of a cell, from the presence of its record alone; nothing is read.
State state_of(const Cell& cell, const Store& store, std::string& sentence);

/// A line of such a table. Fields with commas, quotes or newlines are quoted.
std::string csv_line(const std::vector<std::string>& fields);
/// A line for each cell: number, id, state, sentence, frames, values, hashes, its folder in the store, and the names of its files there,
/// with a space between them.
std::string table_csv(const Cells& cells, const Table& table);
std::string films_csv(const Table& table);

}  // namespace rainref::sweep
