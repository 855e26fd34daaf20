// Which program this is.
#pragma once

#include <optional>

#include "base/hash.h"

namespace rainref::cache {

/// The hash of the file that holds this code, a program's or a shared library's: another build, another hash. None where the system
/// does not say which file that is, or it cannot be read.
std::optional<Hash128> program_hash();

}  // namespace rainref::cache
