// Pairs of cells that differ in nothing but their label, such as a street through a clean pane and through a wet one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sweep/cells.h"

namespace rainref::sweep {

/// What a data set is made of: options of `sweep collect`.
struct PairsAsked {
  std::string clean, rainy;     ///< labels: values of the column `name` of the plan's cases
  std::string mask;             ///< channel that the plan keeps as exr:CHANNEL; "": none
  double split = 0.9;           ///< share of the pairs that are for training
  std::int64_t split_seed = 1;  ///< another seed makes another split
};

struct Pair {
  std::size_t clean, rainy;  ///< indices of the cells
  bool is_train;
};

/// True for this share of all films: a hash of seed and film, as a number in [0, 1), is below the share. It depends on nothing else, so a
/// film stays on its side when others come or go.
bool is_train(std::string_view film, double share, std::int64_t seed);

/// The pairs in the order of the rainy cells. Cells of a pair have the same scene, frames, and rows of all axes but the labels'. The film
/// of the clean cell decides the side, so all chunks, and all kinds of rain before one clean scene, are on one side. Throws Error(usage),
/// with the nearest valid name, if the plan has no such labels, keeps no picture, or does not keep the mask's channel.
std::vector<Pair> pairs_of(const Cells& cells, const PairsAsked& asked);

}  // namespace rainref::sweep
