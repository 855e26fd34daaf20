// The fields of records that are matched by id: where they lie, and how many of them a judgement is about.
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

/// Where the fields of a record lie.
struct RecordLayout {
  std::size_t id = 0;
  std::vector<std::size_t> floats, words;
  std::vector<int> float_fields, word_fields;  ///< their numbers among all fields
  std::vector<std::string> float_names, word_names;
};
RecordLayout record_layout(const scene::UniformBlock& record);

/// Four bytes of a record.
std::uint32_t word_at(const std::byte* record, std::size_t offset);

/// Records by id; where there are several, the first: the ids of the others go to `duplicate`. The list must outlive it.
using RecordTable = std::map<std::uint32_t, const std::byte*>;
RecordTable table_of(const capture::Array& list, const RecordLayout& layout, std::vector<std::uint32_t>& duplicate);

/// The floats of these ids that are not a number.
std::vector<Failure> not_numbers(const std::vector<capture::KeyedRecord>& records, const RecordTable& table, const RecordLayout& layout);

/// Counts fields: how many there are, how many differ, how well they are bounded.
class FieldCounts {
 public:
  /// `extents`: of each float's declared range. `out` has the fields' names. Whatever is referred to must outlive it.
  FieldCounts(const RecordTable& port, const RecordTable& expected, const RecordLayout& layout, std::vector<double> extents,
              OutputJudgement& out)
      : port_(port), expected_(expected), layout_(layout), extents_(std::move(extents)), out_(out) {}

  /// Of a group: what an alternative bounds, or nothing where there were too many.
  void add(const std::vector<capture::KeyedRecord>& alternative, bool gave_up);
  /// Of a record that one list has and the other must not lack.
  void add_whole_record();
  /// Of fields that were counted and are outside.
  void add_failures(const std::vector<Failure>& failures);
  /// When all are counted.
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
