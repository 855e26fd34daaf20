// Which invocations of a port have the bits of a device that is known.
//
// A profile that allows what the device does in its lookups and in its sums of products has an envelope that holds what it gives, in one
// alternative for all outputs together (tests: ShortCut.EveryEnvelopeHoldsTheKnownDevices).
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

/// What known devices do that the reference does not, as Perturbeds are told: one samples in fixed point, one fuses sums of products, one
/// does both.
std::vector<perturbed::Behaviour> known_devices();
/// Whether a profile allows all that such a device does.
bool allows(const enclosed::Profile& profile, const perturbed::Behaviour& device);

class KnownDevice {
 public:
  /// As ReferenceBits.
  KnownDevice(const capture::PassModel& model, const std::vector<capture::Array>& port, const std::vector<Slot>& slots,
              const std::vector<HalfMode>& modes);

  /// Chooses of `devices` the one whose bits most of the sampled invocations have that `is_wanted`; none where they are few.
  void prepare(const Sample& sample, const std::vector<perturbed::Behaviour>& devices, const std::function<bool(int, int)>& is_wanted);
  /// What was chosen.
  const std::optional<perturbed::Behaviour>& device() const { return device_; }
  /// Into `is_held`, for each rounding of halves, whether all that is stored for an invocation has the device's bits, which the calling
  /// thread's Perturbeds follow.
  void find(int x, int y, std::vector<char>& is_held) const;

 private:
  const capture::PassModel& model_;
  const std::vector<capture::Array>& port_;
  const std::vector<Slot>& slots_;
  const std::vector<HalfMode>& modes_;
  std::optional<perturbed::Behaviour> device_;
};

}  // namespace rainref::judge
