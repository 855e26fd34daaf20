// How much memory there is, so that a scene that cannot fit is refused before it is built.
#pragma once

#include <cstddef>
#include <string>

namespace rainref {

/// Bytes of physical memory of this machine.
std::size_t physical_memory();
/// "1.5 GiB", "12.0 MiB".
std::string memory_text(std::size_t bytes);

}  // namespace rainref
