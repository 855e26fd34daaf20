// What the numbers of an output are: the channels of its texels, or the fields of its records, by name and unit.
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
  double extent;           ///< of its declared range; 0: it has none
  FormatInfo::Kind kind;
  std::size_t offset, bytes;  ///< in the texel or the record
};
/// Those of an output in order; of a keyed list without its id, and without padding.
std::vector<Quantity> quantities_of(const capture::CaseOutput& output);
/// Writes their names, units and extents into the judgement, whose counts stay.
void name_quantities(const std::vector<Quantity>& quantities, OutputJudgement& out);

/// Of a channel among the units that are declared for all: one, or one for each, "m, m, s". "" where there is none.
std::string unit_of(const std::string& units, int channel);

/// Between what was stored and the nearest value that is accepted, as values; infinity where either is infinite or no number,
/// or nothing bounds it.
double value_distance(FormatInfo::Kind kind, const Failure& failure);

}  // namespace rainref::judge
