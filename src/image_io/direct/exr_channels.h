// The order in which an EXR's channels are given. The file has them by name.
#pragma once

#include <vector>

#include <OpenEXR/ImfChannelList.h>

#include "image_io/codec.h"

namespace rainref::image_io::direct {

/// Layer by layer; within a layer red, green, blue, alpha, depth before others, however they are spelled, else by name. This is
/// OpenImageIO's order. Throws std::runtime_error if there is no channel, or one has fewer samples than the picture has texels.
std::vector<StoredChannel> exr_channels(const Imf::ChannelList& channels);

/// The type of a channel of exr_channels.
Imf::PixelType pixel_type(const StoredChannel& channel);

}  // namespace rainref::image_io::direct
