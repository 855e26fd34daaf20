// Reads packs and captures: the whole manifest, arrays one case at a time.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/hash.h"
#include "capture/pass_case.h"
#include "scene/uniform_block.h"

namespace rainref::capture {

/// A file in the manifest. The path is relative and stays inside the pack.
struct PackFileEntry {
  std::string path;
  std::size_t bytes = 0;
  std::string xxh3;  ///< as `xxhsum -H2` prints it
};

/// An array in the manifest, without values.
struct PackArray {
  std::string name;
  Array shape;                        ///< levels empty
  std::array<double, 2> range{0, 1};  ///< of the stored values
  std::string unit, meaning;
  std::vector<PackFileEntry> levels;  ///< one file for each level
};
struct PackInput : PackArray {
  CaseInput rules;  ///< name, address, border and filters; the array has no values
};
struct PackOutput : PackArray {
  CaseOutput rules;  ///< name, rounding and judge; the array has no values
};

struct PackCase {
  std::string id, pass;
  int frame = 0, step = 0, level = -1;
  float time = 0, dt = 0;
  PackFileEntry uniforms;
  std::vector<std::byte> block;  ///< the uniform block's bytes from its members' values; 0 elsewhere
  std::vector<PackInput> inputs;
  std::vector<PackOutput> outputs;
};

struct PackPass {
  std::string name, formula, sentence;
  std::vector<std::string> reads, writes;
  scene::UniformBlock block;
  std::map<std::string, std::string> unexercised{};  ///< alternatives that the scene declares as never taken, and why
};

/// Source of an input of a pass; `from` is "host" or a pass.
struct PackEdge {
  std::string pass, input, from;
  bool previous = false;
};

/// An open pack. Every error names the pack and what was expected and found: Error(io) if the folder does not exist or cannot be read;
/// Error(port_files) if the manifest or a file is missing, malformed, of a newer version, or does not match the manifest's hash.
class Pack {
 public:
  /// Reads and checks the manifest.
  explicit Pack(std::filesystem::path folder);

  const std::filesystem::path& folder() const { return folder_; }
  std::string effect, variant, scene, producer;  ///< producer: the version that wrote it
  int golden_generation = 0;
  std::string golden_hash;                                  ///< "" in a pack of an older version
  bool with_inputs = false;                                 ///< false: a capture of outputs only
  std::vector<std::pair<std::string, std::string>> config;  ///< every key with its value as JSON, in order
  std::vector<PackPass> passes;                             ///< in the order of execution
  std::vector<PackEdge> edges;
  std::vector<PackCase> cases;  ///< in the order of execution
  /// For a foreign effect: the files of its reference, the description first (foreign/effect_file.h).
  std::vector<PackFileEntry> reference;

  /// The pass of this name; otherwise Error(usage) with the nearest name.
  const PackPass& pass(std::string_view name) const;
  /// A case from the manifest alone: shapes and rules without values, a level for each file, the uniforms from their values.
  PassCase described(const PackCase& entry) const;
  /// Reads a case with all its values, each file verified.
  PassCase read(const PackCase& entry) const;
  /// Reads one array.
  Array read(const PackArray& array) const;
  std::vector<std::byte> read_file(const PackFileEntry& file) const;

  /// A file in the folder that the manifest does not name, or "". Ignores a file named `besides`.
  std::string file_beside(std::string_view besides = "") const;

 private:
  std::filesystem::path folder_;
};

}  // namespace rainref::capture
