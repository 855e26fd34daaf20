// The hash of a file that memory need not hold.
#pragma once

#include <filesystem>

#include "base/hash.h"
#include "base/read_file.h"

namespace rainref {

/// file_hash of a regular file's bytes. Throws as read_file does.
Hash128 hash_of_file(const std::filesystem::path& path, const MostBytes& most);

}  // namespace rainref
