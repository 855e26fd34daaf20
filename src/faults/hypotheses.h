// All that the diagnosis of a failing run tries.
#pragma once

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include "faults/probe.h"

namespace rainref::faults {

struct Hypotheses {
  std::vector<Fault> faults;  ///< in the order in which they are to be believed
  Constants constants;        ///< that the pass meets
  std::vector<Fault> orders;  ///< what is asked only where these explain little
  std::vector<Probe> probes;  ///< some failing texels, of texels
  std::vector<float> known;   ///< as these were made with
};
/// `failing`: some texels that fail, at least one.
Hypotheses hypotheses(const Probed& p, const capture::PassCase* before, const std::vector<Texel>& failing);
/// Constants fitted to what a port stored there, halves by `mode`. `port`, `reference`: in the order of the case's outputs.
std::vector<Fault> fits(const Probed& p, const Constants& constants, const std::vector<capture::Array>& port,
                        const std::vector<capture::Array>& reference, const std::vector<Texel>& failing, judge::HalfMode mode);
/// The same for keyed lists, whose evaluation takes longer: what is asked first, and what only where that explains little. p.bind may
/// be null.
std::vector<Fault> plain_list_hypotheses(const Probed& p, const capture::PassCase* before);
/// `alone`: cases of one failing record each, where records can be evaluated by themselves; then places are those of a record.
Hypotheses list_hypotheses(const Probed& p, const std::string& list, const std::vector<Probed>& alone);

/// Numbers that are met everywhere, but for those that a record of a list holds.
std::vector<float> without_records(std::vector<float> known, const std::vector<Probe>& probes);

/// What an operation may be mistaken for, everywhere. At one place it is said better.
bool is_of_operation(const Fault& d);
/// Moves some faults to another list.
template <class Which>
void take(std::vector<Fault>& from, std::vector<Fault>& to, Which which) {
  std::copy_if(from.begin(), from.end(), std::back_inserter(to), which);
  std::erase_if(from, which);
}

}  // namespace rainref::faults
