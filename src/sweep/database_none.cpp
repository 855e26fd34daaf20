// For a platform without SQLite.
#include "rainref/error.h"
#include "sweep/database.h"

namespace rainref::sweep {

void write_database(const std::filesystem::path&, const Cells&, const Table&) {
  throw Error(ExitCode::io, "this build of rainref writes no table.sqlite: it was made without SQLite");
}

}  // namespace rainref::sweep
