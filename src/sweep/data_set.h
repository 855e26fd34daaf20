// A data set of pairs: a folder with pictures, masks and a line for each pair, made from finished cells.
//
//   train/clean/000007.png, train/rainy/000007.png, train/mask/000007.png, and the same in test
//   train/data.jsonl, test/data.jsonl    a line for each pair: paths, parameters, drops, camera, figures
//   table.csv                            a row for each pair: side, paths, values of the plan, figures
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "capture/new_folder.h"
#include "sweep/pairs.h"
#include "sweep/store.h"
#include "sweep/table.h"

namespace rainref::sweep {

/// Figures of the pairs, in their order; a pair without a mask or a list of drops has none of these.
struct DataSetFigures {
  std::int64_t train = 0, test = 0;
  std::int64_t same = 0;                        ///< pairs whose pictures are the same, which have no PSNR
  std::vector<double> psnr, mask_share, drops;  ///< [dB]; share of the picture that the mask covers; drops in a picture
  std::int64_t dry = 0, dry_differing = 0;      ///< pixels where the mask is 0, and those of them where the pictures differ
  int dry_difference = 0;                       ///< the largest difference of a code there
};

/// The code of a mask for this coverage: the nearest, but 0 only if there is no water at all.
std::uint8_t mask_code(double coverage);

/// Writes the pairs, and does not commit. All cells must be done. The bytes depend on the cells and `asked` alone. Throws Error.
DataSetFigures write_data_set(const Cells& cells, const Table& table, const Store& store, const PairsAsked& asked,
                              const std::vector<Pair>& pairs, capture::NewFolder& folder);

/// Lines for people: how many pairs, and how the figures are distributed.
std::string figures_text(const DataSetFigures& figures);

}  // namespace rainref::sweep
