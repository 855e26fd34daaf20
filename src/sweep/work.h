// Makes the cells of a shard one after the other, with repeated tries.
#pragma once

#include <functional>
#include <string>

#include "sweep/cells.h"
#include "sweep/frames.h"
#include "sweep/shard.h"
#include "sweep/store.h"

namespace rainref::sweep {

struct WorkOptions {
  Shard shard;
  bool again = false;  ///< also cells that failed permanently, and finished cells of a port's command, which depend on more than their
                       ///< names
};
/// Result for a cell.
enum class Outcome : std::uint8_t {
  had,  ///< already existed
  made,
  lost,     ///< another process made it meanwhile
  refused,  ///< ended with 2, now or before
  failed    ///< ended otherwise, after all tries of the plan
};
const char* name(Outcome outcome);

struct Counts {
  std::int64_t of[5] = {};
  std::int64_t operator[](Outcome o) const { return of[static_cast<int>(o)]; }
  bool is_whole() const { return (*this)[Outcome::refused] + (*this)[Outcome::failed] == 0; }
};

/// Makes one cell, and syncs the names of previous cells together with its own files. Throws Error.
using Maker = std::function<Made(const Cell&, Names&)>;
/// Receives the result of each cell of the shard, and a sentence if it has none.
using Listener = std::function<void(const Cell&, Outcome, const std::string& sentence)>;

/// Takes the shard's cells in order; cells that another process is making come last. A cell that a scene refuses is recorded at once and
/// never tried again. A cell that ends with 4 or 5 is tried `plan.tries` times; a cell that killed that many processes is not tried again.
/// Throws Error(io) if the store cannot be written; nothing is lost, and the next run continues there.
Counts work(const Cells& cells, const Store& store, const WorkOptions& options, const Maker& make, const Listener& tell);

}  // namespace rainref::sweep
