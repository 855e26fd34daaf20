// Reading packs and captures: the manifest at once, arrays one case at a time.
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

/// A file as the manifest names it. The path is relative and stays inside the pack.
struct PackFileEntry {
  std::string path;
  std::size_t bytes = 0;
  std::string xxh3;  ///< as `xxhsum -H2` prints it
};

/// An array as the manifest describes it, without its values.
struct PackArray {
  std::string name;
  Array shape;                        ///< levels empty
  std::array<double, 2> range{0, 1};  ///< of the stored values
  std::string unit, meaning;
  std::vector<PackFileEntry> levels;  ///< one file for each level
};
struct PackInput : PackArray {
  CaseInput rules;  ///< name, address, border and filters; array without values
};
struct PackOutput : PackArray {
  CaseOutput rules;  ///< name, rounding and judge; array without values
};

struct PackCase {
  std::string id, pass;
  int frame = 0, step = 0, level = -1;
  float time = 0, dt = 0;
  PackFileEntry uniforms;
  std::vector<std::byte> block;  ///< the uniform block's bytes as its members' values say; 0 elsewhere
  std::vector<PackInput> inputs;
  std::vector<PackOutput> outputs;
};

struct PackPass {
  std::string name, formula, sentence;
  std::vector<std::string> reads, writes;
  scene::UniformBlock block;
  std::map<std::string, std::string> unexercised{};  ///< alternatives that the scene says are never taken, and why
};

/// Where an input of a pass comes from; `from` is "host" or a pass.
struct PackEdge {
  std::string pass, input, from;
  bool previous = false;
};

/// An opened pack. Every error names the pack and what was expected and found: Error(io) where there is no folder or
/// it cannot be read; Error(port_files) where the manifest or a file is missing, malformed, of a newer version, or not
/// what the manifest's hash says.
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
  /// Of an effect that is none of rainref's own: the files that say what computes it, the description first (foreign/effect_file.h).
  std::vector<PackFileEntry> reference;

  /// The pass of this name; Error(usage) naming the nearest one.
  const PackPass& pass(std::string_view name) const;
  /// A case as the manifest describes it: shapes and rules without values, a level for each file, the uniforms as their values say.
  PassCase described(const PackCase& entry) const;
  /// Reads a case with all its values, each file verified.
  PassCase read(const PackCase& entry) const;
  /// Reads one array.
  Array read(const PackArray& array) const;
  std::vector<std::byte> read_file(const PackFileEntry& file) const;

  /// A file below the folder that the manifest does not name, or "". One of the name `besides` does not count.
  std::string file_beside(std::string_view besides = "") const;

 private:
  std::filesystem::path folder_;
};

}  // namespace rainref::capture
