// A port that computes several passes in one shader, so it writes only the outputs of the last of them.
#pragma once

#include <string>
#include <vector>

#include "capture/pack_read.h"
#include "judge/port_files.h"
#include "math/profile.h"
#include "rainref/executor.h"

namespace rainref::judge {

/// The passes of one shader, at least two, in the order of execution.
using FusedPasses = std::vector<std::string>;
/// Reads "ground_noise+shade". Throws Error(usage) for an unknown pass, for a single one, and if a pass takes nothing that one before it
/// gives.
FusedPasses fused_passes(const std::string& text, const capture::Pack& pack);

/// The latest run of a pass in the same frame before the run `id`, which takes what it gave. Null if the pack has none.
const capture::PackCase* source_of(const capture::Pack& pack, const std::string& id, const std::string& pass);

/// Prepares the runs of fused passes. The arguments must outlive it.
class FusedInputs {
 public:
  FusedInputs(const capture::Pack& pack, const std::vector<FusedPasses>& groups, const enclosed::Profile& profile,
              const parallel::Executor& executor)
      : pack_(pack), groups_(groups), profile_(profile), executor_(executor) {}

  /// The passes of which a pass takes something that the same shader computes.
  std::vector<std::string> computed_for(const std::string& pass) const;
  /// The pass in whose shader this one is computed, if it is not the last there; "": none.
  std::string last_of(const std::string& pass) const;
  /// Replaces the inputs that the same shader computes. If the port has files of the pass that gives one, the input becomes what the port
  /// stored, and the expected outputs are computed again. Otherwise it becomes everything that the profile allows the pass to give,
  /// with or without the rounding of a store. Throws Error(usage) if that is not known for a pass, and what port.read() throws.
  void replace(const capture::PackCase& entry, capture::PassCase& c, PortFiles& port) const;
  /// The same without files of the port.
  void widen(const capture::PackCase& entry, capture::PassCase& c) const;

 private:
  void replace(const capture::PackCase& entry, capture::PassCase& c, PortFiles* port) const;

  const capture::Pack& pack_;
  const std::vector<FusedPasses>& groups_;
  const enclosed::Profile& profile_;
  const parallel::Executor& executor_;
};

}  // namespace rainref::judge
