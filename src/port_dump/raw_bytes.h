// Raw bytes, seen as their sidecar says.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "capture/array.h"
#include "port_dump/sidecar.h"
#include "port_dump/stored_image.h"
#include "port_dump/stored_records.h"

namespace rainref::port_dump {

/// A level of the expected image in raw bytes; bottom_up is left to the caller. Throws Error(port_files) when the size
/// is not the level's, the encoding contradicts the buffer's, a row does not fit the pitch, or the bytes end too early
/// or go on behind the last row; the message names the pitch that would fit.
StoredImage image_in(std::span<const std::byte> bytes, const std::string& file, const Sidecar& sidecar, const capture::Array& expected,
                     int level);

/// Records in raw bytes; without stride and fields they lie as `record` declares. Throws Error(port_files) when the
/// bytes go on behind the last record; canonical_records checks the rest.
StoredRecords records_in(std::span<const std::byte> bytes, const std::string& file, const Sidecar& sidecar,
                         const scene::UniformBlock& record);

}  // namespace rainref::port_dump
