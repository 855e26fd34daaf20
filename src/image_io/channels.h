// Which channels of a file become red, green, blue and alpha.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

namespace rainref::image_io {

/// What stands before a channel's last dot, or "".
std::string_view layer_of(std::string_view name);
/// The upper-case letter that a channel's name ends in, or 0 when it is a longer word.
char letter_of(std::string_view name);

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

}  // namespace rainref::image_io
