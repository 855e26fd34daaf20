// Reads a buffer that a port keeps in its own form (encoding.h).
#pragma once

#include <filesystem>
#include <string_view>

#include "capture/array.h"
#include "port_dump/encoding.h"

namespace rainref::port_dump {

struct PortInfo;
struct ReadNotes;

/// Reads the image `stem` ("out.wave") from where the sources of its channels lie. Sources that are not computed have the buffer's bits;
/// then files are as read_port_buffer demands. A file of which every source is computed may hold halves, floats or codes of 8 bits.
/// `notes.kept` says what rounding leaves open. Throws Error(port_files) also if there is not one source for each channel, or if the format
/// has no such values.
capture::Array read_channels(const std::filesystem::path& folder, std::string_view stem, const capture::Array& expected,
                             const Encoding& encoding, const PortInfo& port, ReadNotes& notes);

/// Reads the list `stem`, whose records have some members only, in the order of encoding.members: of .npy by their names, of .bin without
/// padding unless its sidecar says where they lie. A missing member is that of the record of `expected` at the same index, and 0 beyond its
/// end. Only an id may be missing, and members that are 0 in every expected record; Throws Error(port_files) for others, and for an
/// unknown or repeated member.
capture::Array read_members(const std::filesystem::path& folder, std::string_view stem, const capture::Array& expected,
                            const Encoding& encoding, const PortInfo& port, ReadNotes& notes);

}  // namespace rainref::port_dump
