// Identifies this program.
#pragma once

#include <optional>

#include "base/hash.h"

namespace rainref::cache {

/// The hash of the file that holds this code, a program or a shared library; every build has a different hash. None if the system does not
/// name the file, or it cannot be read.
std::optional<Hash128> program_hash();

}  // namespace rainref::cache
