// Seeded bugs as edits of the ports in examples/ports: what a file of mutants says, and the shaders that its edits make.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "ports/runner/npy.h"

namespace port_runner {

/// One textual change: `find` occurs exactly once in the file, below the ports' folder, and becomes `replace`.
struct Edit {
  std::string file, find, replace;
};
struct Mutant {
  int id;
  std::string effect, pass, variant, wrong, expected;
  std::string pack;  ///< that it is judged by: "puddle-corrected", or the one that the file names
  std::vector<Edit> edits;
};
/// Throws FileError naming the file, and the mutant.
std::vector<Mutant> read_mutants(const fs::path& file);

/// The texts of the files that the edits change, by file. Throws FileError naming file, id and text where one does not occur
/// exactly once.
std::map<std::string, std::string> edited_files(const Mutant& mutant, const fs::path& ports);

/// Compiles mutants' shaders in a folder of its own that goes with it.
class Compiler {
 public:
  /// `glslang`: glslangValidator; `ports`: examples/ports.
  Compiler(std::string glslang, fs::path ports);
  Compiler(const Compiler&) = delete;
  Compiler& operator=(const Compiler&) = delete;
  ~Compiler();
  /// SPIR-V of a shader, "puddle/shade_corrected.comp", as the mutant's edits make it; `name` is its own. Throws Error with the
  /// compiler's words, and as edited_files does. May be called by several threads.
  fs::path compile(const std::string& shader, const Mutant& mutant, const std::string& name) const;

 private:
  std::string glslang_;
  fs::path ports_, folder_;
};

}  // namespace port_runner
