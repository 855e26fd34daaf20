// Judging a list of records by their ids: the order of the list is free, as parallel appends leave it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "capture/keyed_model.h"
#include "capture/pass_case.h"
#include "judge/verdict.h"
#include "math/profile.h"

namespace rainref::judge {

/// Ids that something happened to, ascending, without repetition.
struct KeyedEvents {
  std::vector<std::uint32_t> missing;    ///< must live and do not: a death or capture too many, a birth too few
  std::vector<std::uint32_t> extra;      ///< live and may not: a death, capture or merge that did not happen, a birth too many
  std::vector<std::uint32_t> duplicate;  ///< of more than one record
  std::vector<std::uint32_t> outside;    ///< live rightly, with a float outside its envelope or an integer of other bits
  /// "" or "missing: 3, 17; duplicate: 4": at most eight ids of each kind.
  std::string text() const;
};

struct KeyedJudgement {
  /// Elements are the fields, id left out, of the records that either list has; of one that is missing, extra or there
  /// twice all are outside. Failure::x is the id, channel the field.
  OutputJudgement output;
  KeyedEvents events;
  std::int64_t groups = 0, failing = 0, ambiguous = 0, other_branch = 0, gave_up = 0;
  std::int64_t rearranged = 0;            ///< groups that only a rearrangement accepts
  std::uint64_t rearranged_distance = 0;  ///< as CaseJudgement::rearranged_distance
};

/// Whether a member is the key of its record: `id`, one uint.
bool is_key(const scene::Member& member);
/// Whether a record has one.
bool has_key(const scene::UniformBlock& record);

/// Outputs of the case that are matched by id.
std::vector<std::size_t> keyed_outputs(const capture::PassCase& c);

/// Whether two lists hold the same records, byte for byte, in any order.
bool same_records(const capture::Array& a, const capture::Array& b);

/// The extent of the declared range of each float of a record, in the order of declaration. Throws Error(internal) for a
/// member that the model gives none.
std::vector<double> extents_of(const scene::UniformBlock& record, const capture::KeyedModel& model);

/// Judges a port's list. A group of ids passes when one alternative of the model holds all of it: who lives, their
/// floats by envelope, their integers by bits. Ids that no group knows are extra. A group with too many alternatives is
/// vacuous. Without a model, and under exact rules, each expected record is a group whose fields must have the expected
/// bits. Throws Error(internal) for a record without a key or a model that does not fit it, Error(port_files) when the
/// expected list has an id twice.
KeyedJudgement judge_keyed(const capture::CaseOutput& expected, const capture::Array& port, const capture::KeyedModel* model,
                           const enclosed::Profile& profile);

}  // namespace rainref::judge
