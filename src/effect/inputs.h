// The files that a scene names.
#pragma once

#include <string>
#include <vector>

#include "image_io/read.h"
#include "scene/config.h"

namespace rainref::effect {

/// A file that a scene named, as it was decoded.
struct InputFile {
  std::string key, path, decoded_hash;
  bool lossy;
};
/// All of them, and what is doubtful about them, a sentence each.
struct Inputs {
  std::vector<InputFile> files;
  std::vector<std::string> warnings;
};

/// Reads the picture that `key` names, NPY or what image_io::read takes, and adds it to `inputs`. A file that the scene names lies beside
/// the scene; one from the command line where the user stands. Throws Error naming the key where it cannot be read.
image_io::Picture read_input(const scene::Config& config, const std::string& key, Inputs& inputs);

/// Throws Error(usage) where `key` names a file although the value of the key `why` leaves no use for it.
void refuse_unused(const scene::Config& config, const std::string& key, const std::string& why);

}  // namespace rainref::effect
