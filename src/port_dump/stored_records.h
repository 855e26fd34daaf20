// Records as a file stores them.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "capture/npy_read.h"
#include "port_dump/stored_image.h"
#include "scene/uniform_block.h"

namespace rainref::port_dump {

/// Records in memory that outlives this.
struct StoredRecords {
  std::string file;                       ///< quoted, for messages
  std::vector<capture::NpyField> fields;  ///< a field of type "" has the type that the pack declares
  std::size_t stride = 0, count = 0;
  std::span<const std::byte> bytes;  ///< from the first record on
};

/// The records as the pack declares them, padding zero. Fields are matched by name; an int32 member is stored as <u4, its bits. Fields that
/// the pack does not declare are ignored: those named padding silently, others with a note.
///
/// Throws Error(port_files) if a field is missing or has another type or number of components, or if a field or the last record does not
/// fit into the stride or the bytes.
std::vector<std::byte> canonical_records(const StoredRecords& stored, const scene::UniformBlock& record, ReadNotes& notes);

}  // namespace rainref::port_dump
