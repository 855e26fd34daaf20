// Finds contents of a store that none of the given plans needs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "sweep/cells.h"
#include "sweep/store.h"

namespace rainref::sweep {

struct Rubbish {
  std::filesystem::path path;
  const char* why;
  std::uintmax_t bytes = 0;
};

/// Considers only names that rainref makes, and no links: cells and failures of no plan, states of films that no plan has or whose cells
/// all exist, leftovers of killed processes; with `damaged` also cells whose files differ from their records. Cells being made are never
/// included. Throws Error(usage) for an existing folder that is not a store.
std::vector<Rubbish> rubbish_of(const Store& store, const std::vector<Cells>& plans, bool damaged);

}  // namespace rainref::sweep
