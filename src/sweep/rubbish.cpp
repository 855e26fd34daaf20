#include "sweep/rubbish.h"

#include <algorithm>
#include <set>
#include <string>

#include <fmt/format.h>

#include "base/hidden.h"
#include "base/path_text.h"
#include "rainref/error.h"
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
/// Names of this type in a folder, sorted. Ignores links, also as the folder, and hidden names, which are unfinished results.
std::vector<fs::path> entries(const fs::path& folder, fs::file_type type) {
  std::vector<fs::path> found;
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(folder, error))) return found;
  for (fs::directory_iterator i(folder, error), end; !error && i != end; i.increment(error)) {
    std::error_code gone;
    if (i->symlink_status(gone).type() == type && !path_text(i->path().filename()).starts_with(".")) found.push_back(i->path());
  }
  std::sort(found.begin(), found.end());
  return found;
}
std::vector<fs::path> folders(const fs::path& folder) { return entries(folder, fs::file_type::directory); }
std::vector<fs::path> files(const fs::path& folder) { return entries(folder, fs::file_type::regular); }

}  // namespace

std::vector<Rubbish> rubbish_of(const Store& store, const std::vector<Cells>& plans, bool damaged) {
  std::error_code error;
  if (fs::exists(store.root(), error) && !store.is_marked())
    throw Error(ExitCode::usage,
                fmt::format("{}: expected a folder that `rainref sweep run` marked by its file rainref-store, found none; the "
                            "next `sweep run` into a folder of an older version marks it",
                            path_text(store.root())));
  std::set<std::string> ids, unfinished;
  for (const Cells& cells : plans) {
    for (const Cell& cell : cells.all()) {
      ids.insert(cell.id);
      if (!store.has(cell.id)) unfinished.insert(cell.film);
    }
  }
  std::vector<Rubbish> found;
  const auto add = [&](const fs::path& path, const char* why) { found.push_back({path, why, bytes_below(path)}); };
  for (const fs::path& folder : folders(store.root() / "cells")) {
    const std::string begin = path_text(folder.filename());
    if (begin.size() == 2) remove_leftovers(folder);
    for (const fs::path& cell : folders(folder)) {
      const std::string id = path_text(cell.filename());
      if (!is_id(id) || id.substr(0, 2) != begin) continue;
      if (!ids.contains(id))
        add(cell, "a cell of no plan");
      else if (damaged && !damage_of(cell).empty())
        add(cell, "a damaged cell");
    }
  }
  remove_leftovers(store.root() / "failed");
  for (const fs::path& tables : folders(store.root() / "plans")) remove_leftovers(tables);
  for (const fs::path& failure : files(store.root() / "failed"))
    if (is_id(path_text(failure.stem())) && failure.extension() == ".json" && !ids.contains(path_text(failure.stem())))
      add(failure, "a failure of no plan");
  for (const fs::path& film : folders(store.root() / "states")) {
    const std::string id = path_text(film.filename());
    if (!is_id(id)) continue;
    remove_leftovers(film);
    if (!unfinished.contains(id)) add(film, "states that no cell waits for");
  }
  for (const fs::path& left : files(store.root() / "tries")) {
    const std::string name = path_text(left.filename()), id = name.substr(0, 32);
    if (is_id(id) && is_hidden_name(name.substr(32)) && !ids.contains(id) && store.tries(id).dead > 0)
      add(left, "left by a killed process");
  }
  return found;
}

}  // namespace rainref::sweep
