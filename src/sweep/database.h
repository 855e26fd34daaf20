// A table as an SQLite file.
#pragma once

#include <filesystem>

#include "sweep/table.h"

namespace rainref::sweep {

/// Writes tables `cells`, `parameters`, `hashes`, `files` and `films`; replaces an older file when it is complete. The same rows give the
/// same bytes with the same version of SQLite. Throws Error(io).
void write_database(const std::filesystem::path& path, const Cells& cells, const Table& table);

}  // namespace rainref::sweep
