// The model of a pass that writes a list of records with ids, evaluated with enclosures to judge that list.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "math/enclosure.h"

namespace rainref::capture {

/// The record of one id in one alternative.
struct KeyedRecord {
  std::uint32_t id = 0;
  bool lives = true;                        ///< false: the list has no record of this id, and the fields are meaningless
  std::vector<enclosed::Enclosure> floats;  ///< of each float of the record, in the order of declaration, without padding
  std::vector<std::uint32_t> words;         ///< bits of the other integers in order, without the id
};

/// The usual minimum and maximum of a float member's components, in the member's unit. Outside, a value is measured relative to its own
/// size.
struct FieldRange {
  std::string_view member;
  double low, high;
};

/// Groups of records that share decisions: a drop that another one captures is in the group of the drop that absorbs it, so that both agree
/// on the result. Most groups hold one id. Evaluation is thread-safe.
class KeyedModel {
 public:
  virtual ~KeyedModel() = default;
  virtual int groups() const = 0;
  /// The range of every float member, to which the widths of its envelopes are compared.
  virtual const std::vector<FieldRange>& ranges() const = 0;
  /// Appends a record for every id that the group may produce, under the active profile and enumeration; the same ids in every alternative.
  /// No id is in two groups.
  virtual void enclose(int group, std::vector<KeyedRecord>& out) const = 0;
  /// Like enclose(), for every rearrangement that the active profile allows. False if there is no such evaluation.
  virtual bool rearrange(int, std::vector<KeyedRecord>&) const { return false; }
  /// The bytes of the whole list, in any order: the reference's, or those of Perturbed under the active behaviour (perturbed.h). Nothing if
  /// the model cannot compute it.
  virtual std::optional<std::vector<std::byte>> reference() const { return std::nullopt; }
  virtual std::optional<std::vector<std::byte>> perturbed() const { return std::nullopt; }
};

}  // namespace rainref::capture
