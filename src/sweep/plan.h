// A plan: the work of a sweep, from its TOML file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/path_text.h"
#include "rainref/error.h"
#include "scene/toml.h"
#include "sweep/keep.h"

namespace rainref::sweep {

/// The command that makes a cell.
enum class Verb : std::uint8_t { run, hash, pack, validate, mutate };
const char* name(Verb verb);

/// A text of the plan and its place in the file.
struct Placed {
  std::string text;
  SourceLocation at;
  std::string name{};  ///< for a file: the name in the plan; `text` is its path
};

/// Keys that change together: one key with a list or a range, or the columns of a file of cases. A row has a value for each key.
struct Axis {
  std::vector<std::string> keys;
  std::vector<std::vector<scene::Override>> rows;
};

/// Inputs of `pack` besides a scene, and of `validate` and `mutate`.
struct PackAsked {
  std::vector<std::int64_t> at;     ///< frames; empty: chosen by pack
  std::vector<std::string> passes;  ///< empty: all
};
struct JudgingAsked {
  std::vector<Placed> packs, profiles;  ///< absolute folders; names
  std::string exec, port;               ///< a port's command, or the folder of its outputs (absolute)
  std::int64_t timeout = 600, repeat = 1;
  std::vector<std::string> only;
  std::string label;  ///< other influences on the result: a device, a driver
};

struct Plan {
  std::filesystem::path file;  ///< as given
  Verb verb = Verb::run;
  std::vector<Placed> scenes;        ///< paths relative to the current folder
  std::vector<scene::Override> set;  ///< including frames and size
  std::vector<Axis> axes;            ///< the last one varies fastest
  std::vector<Keep> keep;
  std::int64_t first = 0;        ///< frames before it do not belong to any cell
  std::int64_t chunk = 0;        ///< frames per cell; 0: all
  std::int64_t state_every = 0;  ///< frames between states from which later chunks start; 0: only at the ends of chunks
  std::int64_t tries = 3;        ///< for a cell that ends with 4 or 5 or kills its process
  PackAsked pack;
  JudgingAsked judging;

  /// The file's name without folder and extension.
  std::string name() const { return path_text(file.stem()); }
};

/// Reads and checks a plan's own keys. Files that it names are relative to it; a missing scene is replaced by the bundled scene of that
/// name. Throws Error(usage) with file, line, key, expected, found and the nearest valid name; Error(io) if it cannot be read. Values that
/// a scene refuses are found when its cells are made.
Plan read_plan(const std::filesystem::path& file);

}  // namespace rainref::sweep
