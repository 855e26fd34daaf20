// Errors of the system, by their number.
#pragma once

#include <system_error>

namespace rainref {

/// Throws std::system_error with what the system says of an errno.
[[noreturn]] inline void throw_system_error(int error) { throw std::system_error(error, std::generic_category()); }

}  // namespace rainref
