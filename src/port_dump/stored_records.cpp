#include "port_dump/stored_records.h"

#include <algorithm>
#include <cstring>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "rainref/error.h"

namespace rainref::port_dump {
namespace {

[[noreturn]] void refuse(const StoredRecords& stored, const std::string& why) {
  throw Error(ExitCode::port_files, fmt::format("{}: {}", stored.file, why));
}

std::string shown(const std::string& name) { return name.size() <= 40 ? name : fmt::format("{:.40}...", name); }

std::string type_of(const scene::Member& member) { return member.scalar == scene::Scalar::float32 ? "<f4" : "<u4"; }

const capture::NpyField* find(const StoredRecords& stored, const std::string& name) {
  const auto found = std::ranges::find(stored.fields, name, &capture::NpyField::name);
  return found == stored.fields.end() ? nullptr : &*found;
}

// Offset of the member in a stored record.
std::size_t offset_of(const StoredRecords& stored, const scene::Member& member) {
  const capture::NpyField* field = find(stored, member.name);
  if (!field) {
    std::vector<std::string> names;
    for (const capture::NpyField& f : stored.fields) names.push_back(shown(f.name));
    if (names.size() > 16) names.resize(16);
    refuse(stored, fmt::format("no field '{}'; found {}{}", member.name, fmt::join(names, ", "), did_you_mean(member.name, names)));
  }
  const auto components = static_cast<std::size_t>(member.components);
  if (!field->type.empty() && (field->type != type_of(member) || field->components != components)) {
    refuse(stored, fmt::format("field '{}': expected {} of '{}', found {} of '{}'", member.name, components, type_of(member),
                               field->components, field->type));
  }
  if (stored.stride < member.size() || field->offset > stored.stride - member.size()) {
    refuse(stored, fmt::format("field '{}': {} bytes at offset {} do not fit records of {} bytes", member.name, member.size(),
                               field->offset, stored.stride));
  }
  return field->offset;
}

void check_overlap(const StoredRecords& stored, const scene::UniformBlock& record, const std::vector<std::size_t>& offsets) {
  for (std::size_t a = 0; a < offsets.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const scene::Member &first = record.members[b], &second = record.members[a];
      if (offsets[a] < offsets[b] + first.size() && offsets[b] < offsets[a] + second.size()) {
        refuse(stored, fmt::format("fields '{}' and '{}' overlap", first.name, second.name));
      }
    }
  }
}

void name_extra_fields(const StoredRecords& stored, const scene::UniformBlock& record, ReadNotes& notes) {
  std::vector<std::string> extra;
  for (const capture::NpyField& field : stored.fields) {
    if (field.name.starts_with("padding")) continue;
    if (std::ranges::find(record.members, field.name, &scene::Member::name) == record.members.end()) extra.push_back(shown(field.name));
  }
  if (extra.size() > 16) extra.resize(16);
  if (!extra.empty())
    notes.lines.push_back(fmt::format("{}: fields not declared by the pack, not read: {}", stored.file, fmt::join(extra, ", ")));
}

}  // namespace

std::vector<std::byte> canonical_records(const StoredRecords& stored, const scene::UniformBlock& record, ReadNotes& notes) {
  std::vector<std::size_t> offsets;
  std::size_t end = 0;  // of the last member in a stored record
  for (const scene::Member& member : record.members) {
    offsets.push_back(offset_of(stored, member));
    end = std::max(end, offsets.back() + member.size());
  }
  check_overlap(stored, record, offsets);
  // The last record may lack its padding. Compared by division, because count times stride may not fit.
  if (stored.count > 0 && (stored.bytes.size() < end || (stored.bytes.size() - end) / stored.stride < stored.count - 1)) {
    refuse(stored, fmt::format("truncated: {} records of {} bytes, found {} bytes", stored.count, stored.stride, stored.bytes.size()));
  }
  name_extra_fields(stored, record, notes);
  std::vector<std::byte> out(stored.count * record.size);
  for (std::size_t i = 0; i < stored.count; ++i) {
    for (std::size_t m = 0; m < record.members.size(); ++m) {
      std::memcpy(out.data() + i * record.size + record.members[m].offset, stored.bytes.data() + i * stored.stride + offsets[m],
                  record.members[m].size());
    }
  }
  return out;
}

}  // namespace rainref::port_dump
