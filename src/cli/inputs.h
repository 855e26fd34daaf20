// The files that a scene names.
#pragma once

#include <string>
#include <vector>

#include "cli/registry.h"
#include "image_io/read.h"

namespace rainref::cli {

/// Reads the picture that `key` names, NPY or what image_io::read takes, and adds it to `inputs`. A file that the scene names lies beside
/// the scene; one from the command line where the user stands. Throws Error naming the key where it cannot be read.
image_io::Picture read_input(const scene::Config& config, const std::string& key, std::vector<InputFile>& inputs);

/// Throws Error(usage) where `key` names a file although the value of the key `why` leaves no use for it.
void refuse_unused(const scene::Config& config, const std::string& key, const std::string& why);

}  // namespace rainref::cli
