// Judges a list of records by their ids. The records may have any order, because parallel appends have none.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "capture/keyed_model.h"
#include "capture/pass_case.h"
#include "judge/verdict.h"
#include "math/profile.h"

namespace rainref::judge {

/// Ids with a failure, ascending, each once.
struct KeyedEvents {
  std::vector<std::uint32_t> missing;    ///< must live and do not: an extra death or capture, or a missing birth
  std::vector<std::uint32_t> extra;      ///< live and must not: a missing death, capture or merge, or an extra birth
  std::vector<std::uint32_t> duplicate;  ///< in more than one record
  std::vector<std::uint32_t> outside;    ///< may live, with a float outside its envelope or an integer with other bits
  /// "" or "missing: 3, 17; duplicate: 4": at most eight ids of each kind.
  std::string text() const;
};

struct KeyedJudgement {
  /// Elements are the fields, without the id, of the records in either list; all fields of a missing, extra or duplicate record are
  /// outside. Failure::x is the id, channel the field.
  OutputJudgement output;
  KeyedEvents events;
  std::int64_t groups = 0, failing = 0, ambiguous = 0, other_branch = 0, gave_up = 0;
  std::int64_t rearranged = 0;            ///< groups that only a rearrangement accepts
  std::uint64_t rearranged_distance = 0;  ///< as CaseJudgement::rearranged_distance
};

/// True if a record has a key.
bool has_key(const scene::UniformBlock& record);

/// Outputs of the case that are matched by id.
std::vector<std::size_t> keyed_outputs(const capture::PassCase& c);

/// True if two lists hold the same records, byte for byte, in any order.
bool same_records(const capture::Array& a, const capture::Array& b);

/// Extent of the declared range of each float of a record, in the order of declaration. Throws Error(internal) for a member without a range
/// in the model.
std::vector<double> extents_of(const scene::UniformBlock& record, const capture::KeyedModel& model);

/// Judges a port's list. A group of ids passes if one alternative of the model holds all of it: the ids that live, their floats by
/// envelope, their integers by bits. Ids of no group are extra. A group with too many alternatives is vacuous. Without a model, and under
/// exact rules, each expected record is a group whose fields must have the expected bits. Throws Error(internal) for a record without a key
/// or a model that does not fit it, Error(port_files) if the expected list has an id twice.
KeyedJudgement judge_keyed(const capture::CaseOutput& expected, const capture::Array& port, const capture::KeyedModel* model,
                           const enclosed::Profile& profile);

}  // namespace rainref::judge
