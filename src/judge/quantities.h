// Names and units of the numbers of an output: the channels of its texels, or the fields of its records.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "capture/pass_case.h"
#include "judge/verdict.h"

namespace rainref::judge {

/// One number of a texel or of a record.
struct Quantity {
  std::string name, unit;  ///< as QuantityJudgement
  double extent;           ///< of its declared range; 0: none
  FormatInfo::Kind kind;
  std::size_t offset, bytes;  ///< in the texel or the record
};
/// The numbers of an output in order, without padding, and for a keyed list without the id.
std::vector<Quantity> quantities_of(const capture::CaseOutput& output);
/// Writes their names, units and extents to the judgement, and keeps its counts.
void name_quantities(const std::vector<Quantity>& quantities, OutputJudgement& out);

/// Unit of a channel from the declared units: one for all, or one for each, "m, m, s". "" if there is none.
std::string unit_of(const std::string& units, int channel);

/// Distance between a stored value and the nearest accepted one; infinity if either is infinite or NaN, or if there is no bound.
double value_distance(FormatInfo::Kind kind, const Failure& failure);

}  // namespace rainref::judge
