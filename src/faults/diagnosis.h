// A search for the mistake of a failing run: which mistakes explain it, and what is said of them.
#pragma once

#include <array>
#include <deque>
#include <set>
#include <string>
#include <vector>

#include "faults/replay.h"

namespace rainref::faults {

/// One search, and the causes that it found.
class Diagnosis {
 public:
  /// `other`: another failing run of the pass, or null; a cause must explain both. Both must outlive it.
  Diagnosis(Replay& run, Replay* other) : run_(run), other_(other) {}
  /// Tries mistakes, the plain ones first. `is_plain`: only these.
  void search(bool is_plain = false);
  /// Tries only what explained something in `first`, a search of the same runs judged by another rounding of stores: the rounding hardly
  /// changes which mistakes come near. `is_swapped`: the two runs have changed places.
  void search_among(const Diagnosis& first, bool is_swapped = false);
  /// Returns the causes after a search, best first. A cause is likely if no rival, a different mistake at another place, explains as much;
  /// none is likely if time ran out before all were tried.
  std::vector<judge::Cause> causes();

 private:
  void try_all(std::vector<Fault> all, bool is_sought);

  Replay& run_;
  Replay* other_;
  std::deque<std::vector<Fault>> faults_;  ///< owns faults that causes point to
  std::vector<Fault> faults_in_other_;     ///< of the other run: those that explain much in this one
  std::vector<Tried> causes_;
  std::set<std::string> sought_;                        ///< names of causes that are chosen from thousands
  std::array<std::vector<const Fault*>, 2> promising_;  ///< what explained something: plain, and sought
  bool is_wide_ = false;
};

/// The causes of a run after a whole search.
std::vector<judge::Cause> diagnosed(Replay& run, Replay* other);

}  // namespace rainref::faults
