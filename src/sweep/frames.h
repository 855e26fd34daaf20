// A cell that simulates: its frames, and the data kept from them.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "rainref/executor.h"
#include "sweep/cells.h"
#include "sweep/store.h"

namespace rainref::sweep {

/// Result of making a cell.
struct Made {
  bool was_first = true;  ///< false: another process finished it meanwhile
  std::uintmax_t bytes = 0;
  std::int64_t begun_at = 0;  ///< frame of the state from which it continued; 0: from the beginning
};

/// Parent folders of finished cells that are not yet synced to disk.
using Names = std::vector<std::filesystem::path>;

/// Simulates the frames and writes the cell. A cell with a later first frame continues from the newest stored state, skips the frames
/// before its own, and stores a state at its end. Throws Error. `warn` receives doubtful properties of the scene's files.
Made make_frames(const Cells& cells, const Cell& cell, const Store& store, const parallel::Executor& executor, Names& names,
                 const std::function<void(const std::string&)>& warn);

}  // namespace rainref::sweep
