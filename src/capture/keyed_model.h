// A pass whose output is a list of records with ids, read as enclosures: what conformance judges such a list by.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "math/enclosure.h"

namespace rainref::capture {

/// What one alternative says of one id.
struct KeyedRecord {
  std::uint32_t id = 0;
  bool lives = true;                        ///< false: the list has no record of this id; the fields mean nothing
  std::vector<enclosed::Enclosure> floats;  ///< of each float of the record, in the order of declaration, padding left out
  std::vector<std::uint32_t> words;         ///< bits of each other integer, likewise, the id left out
};

/// The least and the most that a float member of a record ordinarily is, each of its components, in the member's unit.
/// Beyond it a value counts by its own size.
struct FieldRange {
  std::string_view member;
  double low, high;
};

/// Groups of records that share decisions: a drop that another one captures is in the group of its absorbing drop, so that the
/// two agree on what happened. Most groups hold one id. Evaluation is thread-safe.
class KeyedModel {
 public:
  virtual ~KeyedModel() = default;
  virtual int groups() const = 0;
  /// Of every float member: what the widths of its envelopes are compared with.
  virtual const std::vector<FieldRange>& ranges() const = 0;
  /// Appends a record for every id that the group may give, under the profile and the enumeration in force; the same ids in
  /// every alternative. No id is in two groups.
  virtual void enclose(int group, std::vector<KeyedRecord>& out) const = 0;
  /// As enclose(), of every rearrangement that the profile in force allows. False where there is no such evaluation.
  virtual bool rearrange(int, std::vector<KeyedRecord>&) const { return false; }
  /// The bytes of the whole list, in any order: what the reference gives, and what Perturbeds give under the behaviour in
  /// force (perturbed.h). Nothing where the model cannot say.
  virtual std::optional<std::vector<std::byte>> reference() const { return std::nullopt; }
  virtual std::optional<std::vector<std::byte>> perturbed() const { return std::nullopt; }
};

}  // namespace rainref::capture
