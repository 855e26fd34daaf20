// Which channels of a file become red, green, blue and alpha.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace rainref::image_io {

/// What stands before a channel's last dot, or "".
std::string_view layer_of(std::string_view name);
/// The upper-case letter that a channel's name ends in, or 0 when it is a longer word.
char letter_of(std::string_view name);

/// What a file is read for.
enum class Content : std::uint8_t {
  colour,    ///< four channels
  quantity,  ///< one number a texel
  depth      ///< one number a texel that may have a depth's name and be infinite
};

/// For each of red, green, blue, alpha: the index of a file channel, or a constant.
struct ChannelPick {
  static constexpr int zero = -1, one = -2;
  std::array<int, 4> source;
};

/// Picks four channels of one layer. A layer is what stands before a name's last dot; `layer` empty means the channels
/// without a dot or, when there are none, the layer of the first channel. Within the layer, names decide, upper or
/// lower case: R G B, else X Y Z, else U V, else the only channel that is not A, which is replicated (grey). A name
/// missing from R G B or X Y Z gives 0. Alpha is A, else 1.
///
/// Throws Error(usage) starting with `file` when the layer is not there or its names are none of these.
ChannelPick pick_channels(std::string_view file, std::span<const std::string> names, std::string_view layer);

/// The channel that a file's depth is in, replicated; alpha is 1. By name, upper or lower case, the first of these that there is: Z; Z of
/// a layer "depth"; Z of another layer; depth; V; the only channel of a layer "depth", alpha aside. Z beside X and Y is a vector's, V
/// beside U a place's. Where there is none, and for a quantity: what pick_channels gives, whose red is then one that the file has.
///
/// Throws Error(usage) starting with `file` when two channels have the same claim, and as pick_channels.
ChannelPick pick_quantity(std::string_view file, std::span<const std::string> names, bool is_depth);

}  // namespace rainref::image_io
