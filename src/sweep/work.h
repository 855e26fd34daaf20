// The cells of a shard, one after the other, each as often as it takes.
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
  bool again = false;  ///< cells that failed for good, too; and finished ones of a port's command, which hang on more than their names say
};
/// What became of a cell.
enum class Outcome : std::uint8_t {
  had,  ///< it was there
  made,
  lost,     ///< another process made it meanwhile
  refused,  ///< ended with 2, now or before
  failed    ///< ended otherwise, as often as the plan says
};
const char* name(Outcome outcome);

struct Counts {
  std::int64_t of[5] = {};
  std::int64_t operator[](Outcome o) const { return of[static_cast<int>(o)]; }
  bool is_whole() const { return (*this)[Outcome::refused] + (*this)[Outcome::failed] == 0; }
};

/// Makes one cell, and waits for the names of the ones before it together with its own files. Throws Error.
using Maker = std::function<Made(const Cell&, Names&)>;
/// Hears of each cell of the shard: what became of it, and a sentence where it has none.
using Listener = std::function<void(const Cell&, Outcome, const std::string& sentence)>;

/// Takes the shard's cells in order, last those that another process is making meanwhile. What a scene refuses is recorded at once and
/// never tried again; what ends with 4 or 5 is tried `plan.tries` times, a cell that killed so many processes no more. Throws Error(io)
/// where the store itself cannot be written: nothing is lost, and the next run goes on there.
Counts work(const Cells& cells, const Store& store, const WorkOptions& options, const Maker& make, const Listener& tell);

}  // namespace rainref::sweep
