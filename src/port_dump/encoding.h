// A port's own form of a buffer: what port.json says about channels, numbers, files and members of records.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rainref::port_dump {

struct PortInfo;

/// A channel of a port's file, times a number.
struct ChannelTerm {
  std::string file;  ///< the name of the port's buffer, as in out.<file>; "": the buffer's own
  int channel = 0;
  double scale = 1;  ///< finite, not 0
};

/// What gives a channel of a buffer: terms[0].scale * channel + ... + bias.
struct ChannelSource {
  enum class Form : std::uint8_t {
    plain,       ///< one channel as it is
    negated,     ///< the port keeps minus the value
    complement,  ///< one minus a channel; exact for codes of 8 bits
    computed     ///< any other sum
  };
  std::vector<ChannelTerm> terms{ChannelTerm()};  ///< one to most_terms
  double bias = 0;
  Form form = Form::plain;

  static constexpr std::size_t most_terms = 4;
};

/// A port's own form of a buffer: sources of an image, or members of records.
struct Encoding {
  std::vector<ChannelSource> channels;  ///< one for each channel of the image; empty: it is a list
  std::vector<std::string> members;     ///< the members that the port's records have, in its order
};
/// By the buffer's name.
using Encodings = std::map<std::string, Encoding>;

/// Parses a sum of channels, each with or without a number, and of one number: "x", "-y", "1-g", "newest.x", "0.5*x+0.5", "x - 0.02*y".
/// A channel is x y z w or r g b a, after an optional file and a point. False for anything else.
bool parse_source(std::string_view text, ChannelSource& source);

/// "wave" of "out.wave" and of "out.wave.L2".
std::string buffer_of(std::string_view stem);

/// The stems of the files that hold the buffer `stem`: itself, or those of its sources.
std::vector<std::string> stems_of(std::string_view stem, const PortInfo& port);

}  // namespace rainref::port_dump
