// A plan: what a sweep computes, as its TOML file says it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "rainref/error.h"
#include "scene/toml.h"
#include "sweep/keep.h"

namespace rainref::sweep {

/// What a cell is: one such command.
enum class Verb : std::uint8_t { run, hash, pack, validate, mutate };
const char* name(Verb verb);

/// A text of the plan and where it stands there.
struct Placed {
  std::string text;
  SourceLocation at;
  std::string name{};  ///< of a file: as the plan says it; `text` leads there
};

/// Keys that change together: one key of a list or a range, or the columns of a file of cases. A row is a value for each key.
struct Axis {
  std::vector<std::string> keys;
  std::vector<std::vector<scene::Override>> rows;
};

/// What `pack` takes besides a scene; and what `validate` and `mutate` take.
struct PackAsked {
  std::vector<std::int64_t> at;     ///< frames; empty: pack's own choice
  std::vector<std::string> passes;  ///< empty: all
};
struct JudgingAsked {
  std::vector<Placed> packs, profiles;  ///< absolute folders; names
  std::string exec, port;               ///< a port's own command, or the folder of its outputs (absolute)
  std::int64_t timeout = 600, repeat = 1;
  std::vector<std::string> only;
  std::string label;  ///< of what the result depends on besides: a device, a driver
};

struct Plan {
  std::filesystem::path file;  ///< as named
  Verb verb = Verb::run;
  std::vector<Placed> scenes;        ///< paths that lead there from the current folder
  std::vector<scene::Override> set;  ///< frames and size included
  std::vector<Axis> axes;            ///< the last fastest
  std::vector<Keep> keep;
  std::int64_t first = 0;        ///< frames before it are not part of any cell
  std::int64_t chunk = 0;        ///< frames of a cell; 0: all
  std::int64_t state_every = 0;  ///< frames between states that later chunks start from; 0: none but at the ends of chunks
  std::int64_t tries = 3;        ///< of a cell that ends with 4 or 5 or kills its process
  PackAsked pack;
  JudgingAsked judging;

  /// The file's name without folder and extension.
  std::string name() const { return file.stem().string(); }
};

/// Reads and checks a plan's own keys. Files that it names lie beside it; a scene that does not is that of this name that came with
/// rainref. Throws Error(usage) with file, line, key, expected, found and the nearest valid name; Error(io) where it cannot be read. What a
/// scene refuses shows when its cells are made.
Plan read_plan(const std::filesystem::path& file);

}  // namespace rainref::sweep
