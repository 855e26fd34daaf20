// Raw bytes whose layout is in a sidecar file.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "capture/array.h"
#include "port_dump/sidecar.h"
#include "port_dump/stored_image.h"
#include "port_dump/stored_records.h"

namespace rainref::port_dump {

/// A level of the expected image in raw bytes; the caller handles bottom_up. Throws Error(port_files) if the size is not the level's, the
/// encoding contradicts the buffer's, a row does not fit the pitch, or there are too few or surplus bytes; the message gives the pitch that
/// would fit.
StoredImage image_in(std::span<const std::byte> bytes, const std::string& file, const Sidecar& sidecar, const capture::Array& expected,
                     int level);

/// Records in raw bytes; without stride and fields they have the layout of `record`. Throws Error(port_files) for surplus bytes after the
/// last record; canonical_records checks the rest.
StoredRecords records_in(std::span<const std::byte> bytes, const std::string& file, const Sidecar& sidecar,
                         const scene::UniformBlock& record);

}  // namespace rainref::port_dump
