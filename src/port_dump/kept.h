// What is lost in a port's own form of a buffer (encoding.h).
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace rainref::port_dump {

struct Kept {
  /// For each channel of each texel of level 0: how far below and above its value the one may lie that the port had. Empty: nowhere.
  std::vector<std::array<float, 2>> spread;
  double widest = 0;  ///< the largest of these in any level; 0: the port's values are known to the bit
  /// Members of records that the port does not have; they are those of the expected record at the same place.
  std::vector<std::string> from_expected;
};
/// Of a buffer; null: nothing is open.
using KeptForm = std::shared_ptr<const Kept>;
/// Of the outputs of a run, in their order; empty: nothing is open.
using KeptForms = std::vector<KeptForm>;

}  // namespace rainref::port_dump
