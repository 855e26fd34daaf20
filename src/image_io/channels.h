// Selects the channels of a file that become red, green, blue and alpha.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace rainref::image_io {

/// The part before a channel's last dot, or "".
std::string_view layer_of(std::string_view name);
/// The upper-case letter at the end of a channel's name, or 0 if it is a longer word.
char letter_of(std::string_view name);

/// The kind of content to read from a file.
enum class Content : std::uint8_t {
  colour,    ///< four channels
  quantity,  ///< one number per texel
  depth      ///< one number per texel that may be named like a depth and be infinite
};

/// For each of red, green, blue, alpha: the index of a file channel, or a constant.
struct ChannelPick {
  static constexpr int zero = -1, one = -2;
  std::array<int, 4> source;
};

/// Picks four channels of one layer. A layer is the part of a name before its last dot. If `layer` is empty, the channels without a dot are
/// used or, if there are none, the layer of the first channel. Within the layer, the names decide, upper or lower case: R G B, else X Y Z,
/// else U V, else the only channel that is not A, which is replicated (grey). A missing name of R G B or X Y Z gives 0. Alpha is A, else 1.
///
/// Throws Error(usage) starting with `file` if the layer does not exist or its names are none of these.
ChannelPick pick_channels(std::string_view file, std::span<const std::string> names, std::string_view layer);

/// Picks the channel of a file's depth, replicated; alpha is 1. It is the first existing one of, in upper or lower case: Z; Z of a layer
/// "depth"; Z of another layer; depth; V; the only channel of a layer "depth", alpha aside. Z beside X and Y belongs to a vector, and V
/// beside U to a position. If none exists, and for a quantity, it picks as pick_channels does; red must then be a channel of the file.
///
/// Throws Error(usage) starting with `file` if two channels have the same rank, and as pick_channels does.
ChannelPick pick_quantity(std::string_view file, std::span<const std::string> names, bool is_depth);

}  // namespace rainref::image_io
