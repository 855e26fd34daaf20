// System errors by number.
#pragma once

#include <string>
#include <system_error>

namespace rainref {

/// The category of numbers of errno, with the system's text for each. Its errors compare as those of std::generic_category().
const std::error_category& system_failures();

/// The system's text for an errno.
inline std::string reason_of(int error) { return system_failures().message(error); }

/// Throws std::system_error with the system's text for an errno.
[[noreturn]] inline void throw_system_error(int error) { throw std::system_error(error, system_failures()); }

}  // namespace rainref
