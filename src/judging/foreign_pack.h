// A pack of an effect that is none of rainref's own: inputs of its author's run, and what trusted shaders make of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "capture/pack_write.h"
#include "rainref/executor.h"

namespace rainref::judging {

struct ForeignPackRequest {
  std::filesystem::path effect;  ///< the description (foreign/effect_file.h)
  std::filesystem::path inputs;  ///< <effect>.<pass>/<frame>.<step>/ with uniforms.bin and in.<name>.npy of each run
  std::filesystem::path output;
};
struct ForeignPack {
  capture::PackWriter::Total total;
  std::vector<std::string> passes;
  std::vector<std::string> warnings;  ///< passes of which the pack says nothing
};

/// Executes every run that the inputs' folder has, in the order of execution, and writes the pack. An input without a file is what its
/// pass gave, where the description says from which. Throws Error(port_files) naming the file for what is missing or not as described, for
/// a shader that writes texels of other invocations, and for one that stores what is no number; Error(io).
ForeignPack make_foreign_pack(const ForeignPackRequest& request, const parallel::Executor& executor);

}  // namespace rainref::judging
