// What a store holds that none of the given plans needs.
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

/// By the names that rainref gives alone, and no link: cells and failures of no plan, states of films that no plan has or whose cells are
/// all there, leftovers of killed processes; with `damaged` also cells whose files are not what their records say. Cells that are being
/// made are none of it. Throws Error(usage) for a folder that is there and is no store.
std::vector<Rubbish> rubbish_of(const Store& store, const std::vector<Cells>& plans, bool damaged);

}  // namespace rainref::sweep
