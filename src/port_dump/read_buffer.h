// Reads a buffer that a port dumped, and gives it the form of the array that it is compared with.
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

/// Reads the buffer `stem` ("out.wave") of a case's folder. `expected` gives the required format, size and number of mip levels, or the
/// record's declaration; its values are not used. Mip level l > 0 is <stem>.L<l>; a DDS with several levels holds them all. The returned
/// rows begin with v = 0, by the origin of the sidecar or of `port`.
///
/// Images have exactly the size of `expected`. The number of records may differ: width gives it. NaN and infinity are kept. Every bit is as
/// the port stored it; the only conversion is from a float to the half that it equals. `alpha`: if the buffer's fourth channel is the
/// constant 1, an image of the other three is accepted.
///
/// A buffer that `port` has an encoding for is put together from the port's own channels or members (read_encoded.h); then the values of
/// an expected list are used.
///
/// `kinds`: with Kinds::any the file may hold other values than the buffer; the array then has the format of the file with this many
/// channels or more.
///
/// Throws Error(port_files) with one sentence that names the file, what was expected and what was found; Error(io) if a file cannot be
/// read. Memory depends on the sizes of `expected` and of the file, not on the header.
capture::Array read_port_buffer(const std::filesystem::path& folder, std::string_view stem, const capture::Array& expected,
                                const PortInfo& port, ReadNotes& notes, Alpha alpha = Alpha::stored, Kinds kinds = Kinds::own);

/// The same for the bytes of one file, as a level or as records. `sidecar` is the text beside a .bin. read_port_buffer does this for each
/// file; this is for callers that already have the bytes.
struct FileBytes {
  FileType type;
  std::string file;  ///< quoted, for messages
  std::span<const std::byte> bytes;
  std::string_view sidecar;
  std::string sidecar_file;  ///< quoted
};
/// Fills out.levels from `level` on, one level, or all levels of a DDS, and out.format. `out` is initially `expected` without levels.
void read_levels(const FileBytes& file, const capture::Array& expected, int level, const PortInfo& port, capture::Array& out,
                 ReadNotes& notes, Alpha alpha = Alpha::stored, Kinds kinds = Kinds::own);
/// Fills out.levels[0] and out.width.
void read_records(const FileBytes& file, const capture::Array& expected, capture::Array& out, ReadNotes& notes);

}  // namespace rainref::port_dump
