// Rays in floats as rays in doubles.
#pragma once

#include <cstddef>

namespace rainref::bench {

/// Component k of 16 origins and directions to 16 doubles at to + k stride, directions after origins.
void widen_packet(const float (&origin)[3][16], const float (&direction)[3][16], double* to, std::size_t stride);

}  // namespace rainref::bench
