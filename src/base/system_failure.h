// System errors by number.
#pragma once

#include <system_error>

namespace rainref {

/// Throws std::system_error with the system's text for an errno.
[[noreturn]] inline void throw_system_error(int error) { throw std::system_error(error, std::generic_category()); }

}  // namespace rainref
