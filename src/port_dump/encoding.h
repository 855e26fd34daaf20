// How a port keeps a buffer in its own way, as far as that is exact: other channels, signs and files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "capture/array.h"

namespace rainref::port_dump {

struct PortInfo;
struct ReadNotes;

/// Where a channel of a buffer lies in a port's files.
struct ChannelSource {
  /// negated: the port keeps minus the value. complement: a code of 8 bits is 255 minus the buffer's.
  enum class Change : std::uint8_t { none, negated, complement };
  std::string file;  ///< the name of the port's buffer, as in out.<file>; "": the buffer's own
  int channel = 0;
  Change change = Change::none;
};
/// A source for each channel of a buffer, by the buffer's name.
using Encodings = std::map<std::string, std::vector<ChannelSource>>;

/// Parses "x", "-y", "1-g" or "newest.x": an optional minus or "1-", an optional file and a point, and a channel x y z w or r g b a. False
/// for anything else.
bool parse_source(std::string_view text, ChannelSource& source);

/// "wave" of "out.wave" and of "out.wave.L2".
std::string buffer_of(std::string_view stem);

/// The stems of the files that hold the buffer `stem`: itself, or those of its sources.
std::vector<std::string> stems_of(std::string_view stem, const PortInfo& port);

/// Reads the buffer `stem` ("out.wave") from where its sources lie; otherwise as read_port_buffer. Throws Error(port_files) also if there
/// is not one source for each channel, or if a sign is asked of codes or a complement of anything else.
capture::Array read_encoded(const std::filesystem::path& folder, std::string_view stem, const capture::Array& expected,
                            const std::vector<ChannelSource>& sources, const PortInfo& port, ReadNotes& notes);

}  // namespace rainref::port_dump
