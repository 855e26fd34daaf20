// What the readers have in common: types of samples, and rows of some of a file's channels.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "image_io/codec.h"

namespace rainref::image_io::direct {

/// The channels of a picture without names, by their number: Y, else the first ones of R G B A channel4 channel5 ... `type` is as in
/// StoredChannel.
std::vector<StoredChannel> plain_channels(int count, const std::string& type, std::size_t bytes);

/// "linear" for an encoding with exponent 1 after rounding to hundredths, else for example "Gamma2.2".
std::string gamma_name(double gamma);

/// Copies the channels from `first` to before `end` of a row of texels, which holds all channels of `picture`, to `out`.
void copy_channels(const StoredPicture& picture, std::size_t first, std::size_t end, const std::byte* row, std::byte* out);

}  // namespace rainref::image_io::direct
