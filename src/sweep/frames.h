// A cell that simulates: its frames, and what is kept of them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "rainref/executor.h"
#include "sweep/cells.h"
#include "sweep/store.h"

namespace rainref::sweep {

/// What making a cell took.
struct Made {
  bool was_first = true;  ///< false: another process had it meanwhile
  std::uintmax_t bytes = 0;
  std::int64_t begun_at = 0;  ///< the frame of the state that it went on from; 0: from the beginning
};

/// Folders that hold the names of finished cells, not yet on the disk.
using Names = std::vector<std::filesystem::path>;

/// Simulates the frames and writes the cell. A cell that begins later goes on from the newest state that lies there, passes over the frames
/// up to its own, and leaves a state at its end. Throws Error. `warn` gets what is doubtful about the scene's files.
Made make_frames(const Cells& cells, const Cell& cell, const Store& store, const parallel::Executor& executor, Names& names,
                 const std::function<void(const std::string&)>& warn);

}  // namespace rainref::sweep
