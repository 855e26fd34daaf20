// Finds the invocations of a port that have the bits of a known device.
//
// If a profile allows the device's arithmetic in lookups and sums of products, its envelopes hold the device's results. One alternative
// holds them for all outputs together (tests: ShortCut.EveryEnvelopeHoldsTheKnownDevices).
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "capture/pass_model.h"
#include "judge/sample.h"
#include "judge/slots.h"
#include "judge/verdict.h"
#include "math/profile.h"

namespace rainref::judge {

/// Behaviours of known devices that differ from the reference, for Perturbed: one samples in fixed point, one fuses sums of products, one
/// does both.
std::vector<perturbed::Behaviour> known_devices();
/// True if a profile allows all that such a device does.
bool allows(const enclosed::Profile& profile, const perturbed::Behaviour& device);

class KnownDevice {
 public:
  /// As for ReferenceBits.
  KnownDevice(const capture::PassModel& model, const std::vector<capture::Array>& port, const std::vector<Slot>& slots,
              const std::vector<HalfMode>& modes);

  /// Chooses from `devices` the one whose bits most of the sampled invocations have that `is_wanted` selects; none if these are few.
  void prepare(const Sample& sample, const std::vector<perturbed::Behaviour>& devices, const std::function<bool(int, int)>& is_wanted);
  /// The chosen device.
  const std::optional<perturbed::Behaviour>& device() const { return device_; }
  /// Sets `is_held` for each rounding of halves: true if all stored values of an invocation have the device's bits. Sets the behaviour of
  /// the calling thread's Perturbed evaluation.
  void find(int x, int y, std::vector<char>& is_held) const;

 private:
  const capture::PassModel& model_;
  const std::vector<capture::Array>& port_;
  const std::vector<Slot>& slots_;
  const std::vector<HalfMode>& modes_;
  std::optional<perturbed::Behaviour> device_;
};

}  // namespace rainref::judge
