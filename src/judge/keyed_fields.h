// The fields of records that are matched by id: offsets, and counts of judged fields.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "capture/array.h"
#include "capture/keyed_model.h"
#include "judge/verdict.h"
#include "judge/widths.h"

namespace rainref::judge {

/// Offsets of a record's fields.
struct RecordLayout {
  std::size_t id = 0;
  std::vector<std::size_t> floats, words;
  std::vector<int> float_fields, word_fields;  ///< their indices among all fields
  std::vector<std::string> float_names, word_names;
};
RecordLayout record_layout(const scene::UniformBlock& record);

/// Reads four bytes of a record.
std::uint32_t word_at(const std::byte* record, std::size_t offset);

/// Records by id. If an id repeats, the first record counts, and the id goes to `duplicate`. The list must outlive it.
using RecordTable = std::map<std::uint32_t, const std::byte*>;
RecordTable table_of(const capture::Array& list, const RecordLayout& layout, std::vector<std::uint32_t>& duplicate);

/// Failures for the floats of these ids that are NaN.
std::vector<Failure> not_numbers(const std::vector<capture::KeyedRecord>& records, const RecordTable& table, const RecordLayout& layout);

/// Counts fields: all, differing, and the widths of their bounds.
class FieldCounts {
 public:
  /// `extents`: of each float's declared range. `out` has the fields' names. The arguments must outlive it.
  FieldCounts(const RecordTable& port, const RecordTable& expected, const RecordLayout& layout, std::vector<double> extents,
              OutputJudgement& out)
      : port_(port), expected_(expected), layout_(layout), extents_(std::move(extents)), out_(out) {}

  /// Adds a group: the bounds of an alternative, or nothing if there were too many.
  void add(const std::vector<capture::KeyedRecord>& alternative, bool gave_up);
  /// Adds a record that only one list has.
  void add_whole_record();
  /// Adds the failures of fields that were already counted.
  void add_failures(const std::vector<Failure>& failures);
  /// Called when all are counted.
  void finish() { widths_.summarize(out_); }

 private:
  void add_field(int field, bool differs, const enclosed::CodeRange& range, double width, bool is_vacuous, bool is_loose);

  const RecordTable &port_, &expected_;
  const RecordLayout& layout_;
  std::vector<double> extents_;
  OutputJudgement& out_;
  Widths widths_;
};

}  // namespace rainref::judge
