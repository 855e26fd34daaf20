// All mistakes that the diagnosis of a failing run tries.
#pragma once

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "faults/probe.h"

namespace rainref::faults {

struct Hypotheses {
  std::vector<Fault> faults;  ///< in order of plausibility
  Constants constants;        ///< that the pass uses
  std::vector<Fault> orders;  ///< tried only if `faults` explain little
  std::vector<Probe> probes;  ///< of some failing texels
  std::vector<float> known;   ///< the constants that the probes were made with
};
/// `failing`: some texels that fail, at least one.
Hypotheses hypotheses(const Probed& p, const capture::PassCase* before, const std::vector<Texel>& failing);
/// Constants fitted to what a port stored there, with halves stored by `mode`. `port`, `reference`: in the order of the case's outputs.
std::vector<Fault> fits(const Probed& p, const Constants& constants, const std::vector<capture::Array>& port,
                        const std::vector<capture::Array>& reference, const std::vector<Texel>& failing, judge::HalfMode mode);
/// The same for keyed lists, whose evaluation takes longer: the mistakes to try first. p.bind may be null.
std::vector<Fault> plain_list_hypotheses(const Probed& p, const capture::PassCase* before);
/// The mistakes to try if those explain little. `alone`: one case for each of some failing records, if records can be evaluated separately;
/// places are then those of a record.
Hypotheses list_hypotheses(const Probed& p, const std::string& list, const std::vector<Probed>& alone);

/// Removes the numbers that a record of a list holds from those that are met everywhere.
std::vector<float> without_records(std::vector<float> known, const std::vector<Probe>& probes);

/// True if an operation is replaced by another one everywhere. A fault at one place describes it better.
bool is_of_operation(const Fault& d);
/// Moves the faults that `which` selects to another list.
template <class Which>
void take(std::vector<Fault>& from, std::vector<Fault>& to, Which which) {
  std::copy_if(from.begin(), from.end(), std::back_inserter(to), which);
  std::erase_if(from, which);
}

}  // namespace rainref::faults
