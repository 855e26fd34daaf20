// A buffer that a port dumped, as the array that it should be compared with.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "capture/array.h"
#include "port_dump/dump_file.h"
#include "port_dump/port_info.h"
#include "port_dump/stored_image.h"

namespace rainref::port_dump {

/// Reads the buffer `stem` ("out.wave") of a case's folder. `expected` says what it must be: format, size and number of
/// mip levels, or the record's declaration; its values are not looked at. Mip level l > 0 is <stem>.L<l>; a DDS with
/// several levels holds them all. Rows come out with v = 0 first, by the origin of the sidecar or of `port`.
///
/// Images have exactly the size of `expected`. Records may be more or fewer: width says how many. NaN and infinity are
/// kept. Every bit is as the port stored it: no conversion but from a float to the half that it equals. `alpha`: where the buffer's fourth
/// channel is the constant 1, an image of the other three is taken for it.
///
/// Throws Error(port_files) with one sentence that names the file, what was expected and what was found; Error(io) when
/// a file cannot be read. Memory goes with the size of `expected` and of the file, not with what a header claims.
capture::Array read_port_buffer(const std::filesystem::path& folder, std::string_view stem, const capture::Array& expected,
                                const PortInfo& port, ReadNotes& notes, Alpha alpha = Alpha::stored);

/// The same for the bytes of one file, as a level or as records. `sidecar` is the text beside a .bin. This is what
/// read_port_buffer does to each file, for callers that hold the bytes.
struct FileBytes {
  FileType type;
  std::string file;  ///< quoted, for messages
  std::span<const std::byte> bytes;
  std::string_view sidecar;
  std::string sidecar_file;  ///< quoted
};
/// Fills out.levels from `level` on: one level, or all that a DDS holds. `out` is `expected` without levels at first.
void read_levels(const FileBytes& file, const capture::Array& expected, int level, const PortInfo& port, capture::Array& out,
                 ReadNotes& notes, Alpha alpha = Alpha::stored);
/// Fills out.levels[0] and out.width.
void read_records(const FileBytes& file, const capture::Array& expected, capture::Array& out, ReadNotes& notes);

}  // namespace rainref::port_dump
