// A store: the folder with the results of sweeps, shared by any number of plans and machines.
//
//   rainref-store         marks the folder as a store: every run writes it, and it must exist before anything is removed
//   cells/ab/ab12...      a cell's files, and cell.json, which describes them; complete or absent
//   failed/ab12....json   why a cell has no result
//   states/<film>/N.state the state of a run before frame N, where a chunk may begin
//   tries/ab12... .x      a cell that is being made, locked; or was being made when its process died
//   log/x.csv             time and machine of each cell
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/hidden.h"
#include "base/path_text.h"

namespace rainref::sweep {

/// Why a cell was not made.
struct Failure {
  int code = 0;  ///< 2: refused permanently; 4, 5: the next run tries again; 0: its process died repeatedly
  std::string sentence;
  bool is_final() const { return code == 0 || code == 2; }
};

/// True for the name of a cell or of a film: 32 hexadecimal digits.
bool is_id(std::string_view name);

class Store {
 public:
  explicit Store(std::filesystem::path root) : root_(std::move(root)) {}
  const std::filesystem::path& root() const { return root_; }
  /// True if a run has marked the folder.
  bool is_marked() const;

  /// The folder of a cell, relative to the root.
  static std::string folder_of(const std::string& id) { return "cells/" + id.substr(0, 2) + "/" + id; }
  std::filesystem::path cell(const std::string& id) const { return root_ / utf8_path(folder_of(id)); }
  bool has(const std::string& id) const;

  std::optional<Failure> failure(const std::string& id) const;
  /// Throws Error(io).
  void record(const std::string& id, const std::string& words, const Failure& failure) const;
  /// Removes failure and deaths.
  void forget(const std::string& id) const;
  /// Removes a finished cell, so that it is made again. Throws Error(io).
  void remove_cell(const std::string& id) const;

  /// The processes that died while making the cell, and those making it now.
  struct Tries {
    int dead = 0, alive = 0;
  };
  Tries tries(const std::string& id) const;
  /// Marks the cell as being made during the object's lifetime; if the process is killed, the remaining mark counts as a death.
  std::unique_ptr<Hidden> begin(const std::string& id) const;

  std::filesystem::path states(const std::string& film) const { return root_ / "states" / utf8_path(film); }
  std::filesystem::path state(const std::string& film, std::int64_t frame) const;
  /// The last frame at or before this one that has a state; 0 if there is none.
  std::int64_t newest_state(const std::string& film, std::int64_t frame) const;

  /// Makes the folders, and marks the store. Throws Error(io).
  void make() const;

 private:
  std::filesystem::path root_;
};

}  // namespace rainref::sweep
