// A failing run in which mistakes are made, to see which gives what the port stored.
#pragma once

#include <memory>
#include <vector>

#include "faults/fault.h"

namespace rainref::faults {

class Replay {
 public:
  virtual ~Replay() = default;
  /// What is tried, in the order in which it is to be believed; at most once each.
  virtual std::vector<Fault> plain() = 0;
  /// More of it, asked where nothing plain explains the run.
  virtual std::vector<Fault> deeper() { return {}; }
  /// What is fitted to the port, asked where all that explains too little. After these.
  virtual std::vector<Fault> fitted() = 0;
  /// How well each explains what fails.
  virtual std::vector<judge::Cause> causes(const std::vector<Fault>& all) const = 0;

  /// The pass on a case of other numbers: what gives the same bits here may differ there. Null: there is none.
  virtual std::unique_ptr<Replay> elsewhere() const = 0;
  /// What the pass gives with a mistake, at some places; empty where it cannot be made.
  virtual std::vector<float> given(const Fault& d) const = 0;
};

/// What explains a run, best first. `other`: another failing run of the pass, or null: what explains both is believed. A cause is
/// likely where no rival, which would be another mistake elsewhere, explains as much.
std::vector<judge::Cause> diagnosed(Replay& run, Replay* other);

/// A case whose uniforms, texels and records are others, within a quarter or so.
capture::PassCase varied(const capture::PackPass& pass, const capture::PassCase& c);

}  // namespace rainref::faults
