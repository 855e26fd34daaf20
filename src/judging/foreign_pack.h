// A pack of a foreign effect: the inputs of a run by its author, and the outputs that trusted shaders give for them.
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
  std::vector<std::string> warnings;  ///< passes that the pack does not test
};

/// Executes every run in the inputs' folder, in the order of execution, and writes the pack. An input without a file is the output of the
/// pass that the description names. Throws Error(port_files) naming the file if something is missing or not as described, if a shader
/// writes texels of other invocations, or if it stores NaN; Error(io).
ForeignPack make_foreign_pack(const ForeignPackRequest& request, const parallel::Executor& executor);

}  // namespace rainref::judging
