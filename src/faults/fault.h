// The named faults: realistic mistakes of a port, made on the reference evaluation rather than in copies of a pass.
// `mutate` asks which of them a pack would catch; the diagnosis asks which of them gives a port's failing bits.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "capture/pack_read.h"
#include "capture/pass_model.h"
#include "faults/what.h"
#include "judge/evaluations.h"
#include "judge/slots.h"
#include "judge/verdict.h"
#include "math/rewrites.h"
#include "random/draws.h"

namespace rainref::faults {

/// The records of a keyed list, one by one.
using Records = std::vector<std::vector<std::byte>>;
/// What a mistake in a list works on.
struct ListEdit {
  Records records;                ///< as the reference gives them, in the order of slots
  std::vector<std::uint32_t> at;  ///< ids that a mistake of few records happens to; empty: some that show it
  const Records* port = nullptr;  ///< what a port stored, for a mistake that is fitted to it
};

struct Texel {
  int x, y;
};

struct Fault : What {
  Fault() = default;
  explicit Fault(What what, bool is_asked_by_diagnosis_alone = true) : What(std::move(what)), for_diagnosis(is_asked_by_diagnosis_alone) {}

  perturbed::Behaviour behaviour;                      ///< what the arithmetic does
  std::function<void(capture::PassCase&)> alter_case;  ///< what the pass takes; null: as captured
  std::function<bool(const capture::PassCase&, std::vector<capture::Array>&)>
      alter_outputs;  ///< from the finished outputs; false: does not apply. Null: evaluated
  std::function<bool(const capture::PassCase&, ListEdit&)> alter_list;  ///< likewise from the finished list `list_output`
  int list_output = -1;
  std::function<float(float, const judge::Slot&)> alter_value;  ///< of the evaluated values, before they are stored
  /// The behaviour at one texel. `loads` is room for Behaviour::loads.
  std::function<void(Texel, perturbed::Behaviour&, std::vector<float>& loads)> at_texel;
  std::optional<perturbed::Rewrites> rewrites;         ///< of other values of the invocation
  std::vector<perturbed::Substitution> substitutions;  ///< other values for operands, of one mistake
  std::optional<random::Draws> draws;                  ///< of a pass of whole numbers: how it draws
  std::optional<judge::HalfMode> stores;               ///< how halves are stored, whatever was declared
  bool legal = false;                                  ///< a conforming GPU may do this: not a bug, but it explains differences
  bool is_one_of_many = false;                         ///< made by the thousand: given up after a few texels
  bool for_diagnosis = false;                          ///< asked by the diagnosis only: `mutate` has enough of its kind

  bool is_evaluated() const { return !alter_outputs && !alter_list && !draws; }
};
/// All numbers of this value have another one.
Fault replaced(What what, float value, float by, bool is_asked_by_diagnosis_alone = true);
/// The places of a fault are told apart by these numbers.
void tell_places_by(Fault& d, std::shared_ptr<const std::vector<float>> known);

/// All faults of a pass on a case: of the arithmetic, of each literal and uniform, of inputs, of finished buffers and lists.
/// `before` is the run of the same pass before this one, or null.
std::vector<Fault> faults_of(const capture::PackPass& pass, const capture::PassCase& c, const capture::PassModel& model,
                             const capture::PassCase* before);

/// What is stored for one invocation: of each slot the bytes of its channel.
using StoredTexel = std::vector<std::array<std::byte, 4>>;

/// What a fault stores at some texels. Applied once, asked texel by texel.
class FaultyPass {
 public:
  /// `finished`: what the reference gives, its halves stored by `mode`. The case and the fault must outlive it. Throws
  /// Error when the altered case cannot be bound.
  FaultyPass(const Fault& fault, const capture::PassCase& c, const judge::Bind& bind, const capture::PassModel& model, judge::HalfMode mode,
             const std::vector<capture::Array>& finished);
  bool applies() const { return applies_; }
  /// Gives `out` what is stored at a texel.
  void store(Texel at, StoredTexel& out) const;
  /// What it gives at a texel, and the bytes of that with halves stored by `mode`, unless the fault says how. Of evaluated faults only.
  std::vector<perturbed::Perturbed> values(Texel at) const;
  void store(const std::vector<perturbed::Perturbed>& values, judge::HalfMode mode, StoredTexel& out) const;
  /// What is done at a texel with the mistake and without it, so that the same node has the same shape in both. Of evaluated faults only.
  void trace(Texel at, perturbed::Trace& right, perturbed::Trace& wrong) const;

 private:
  std::vector<perturbed::Perturbed> evaluated(Texel at, perturbed::Trace* trace, bool is_right) const;

  const Fault& fault_;
  const capture::PassModel& model_;
  judge::HalfMode mode_;
  capture::PassCase altered_;
  std::unique_ptr<capture::PassModel> altered_model_;
  std::vector<capture::Array> finished_;
  std::vector<judge::Slot> slots_;
  bool applies_ = true;
};

}  // namespace rainref::faults
