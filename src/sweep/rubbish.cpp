#include "sweep/rubbish.h"

#include <algorithm>
#include <set>
#include <string>

#include "base/hidden.h"
#include "sweep/cell_record.h"

namespace rainref::sweep {
namespace {

namespace fs = std::filesystem;

std::uintmax_t bytes_below(const fs::path& path) {
  std::error_code error;
  if (fs::is_regular_file(path, error)) return fs::file_size(path, error);
  std::uintmax_t all = 0;
  for (fs::recursive_directory_iterator i(path, error), end; !error && i != end; i.increment(error))
    if (i->is_regular_file(error)) all += i->file_size(error);
  return all;
}
/// What a folder holds, sorted; hidden names are results in the making.
std::vector<fs::path> entries(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator i(folder, error), end; !error && i != end; i.increment(error))
    if (!i->path().filename().string().starts_with(".")) found.push_back(i->path());
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

std::vector<Rubbish> rubbish_of(const Store& store, const std::vector<Cells>& plans, bool damaged) {
  std::set<std::string> ids, unfinished;
  for (const Cells& cells : plans) {
    for (const Cell& cell : cells.all()) {
      ids.insert(cell.id);
      if (!store.has(cell.id)) unfinished.insert(cell.film);
    }
  }
  std::vector<Rubbish> found;
  const auto add = [&](const fs::path& path, const char* why) { found.push_back({path, why, bytes_below(path)}); };
  for (const fs::path& folder : entries(store.root() / "cells")) {
    remove_leftovers(folder);
    for (const fs::path& cell : entries(folder)) {
      if (!ids.contains(cell.filename().string()))
        add(cell, "a cell of no plan");
      else if (damaged && !damage_of(cell).empty())
        add(cell, "a damaged cell");
    }
  }
  for (const fs::path& failure : entries(store.root() / "failed"))
    if (!ids.contains(failure.stem().string())) add(failure, "a failure of no plan");
  for (const fs::path& film : entries(store.root() / "states"))
    if (!unfinished.contains(film.filename().string())) add(film, "states that no cell waits for");
  for (const fs::path& left : entries(store.root() / "tries"))
    if (const std::string id = left.filename().string().substr(0, 32); !ids.contains(id) && store.tries(id).dead > 0)
      add(left, "left by a killed process");
  return found;
}

}  // namespace rainref::sweep
