// zlib's format (RFC 1950, 1951), written: repeats within 32 KiB, in the fixed code.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace rainref::image_io {

std::vector<std::byte> zlib_bytes(std::span<const std::byte> data);

}  // namespace rainref::image_io
