// A pack and the programs of a port, as the runner needs them: which bytes go to which binding, and what comes back.
//
// Binding convention, the same for every pass. Descriptor set 0; binding 0 is the uniform block (std140), then the
// inputs and the outputs in the order of the program's lists:
//   input image     combined image sampler, with the manifest's addresses, border and filters ("none": nearest)
//   input records   std430 storage buffer: an array of the records
//   output image    storage image in the buffer's format
//   output records  std430 storage buffer: the count in the first of four words, the records from byte 16
// An input that the case does not have is bound as one texel, or one record, of zeros.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

#include "ports/runner/npy.h"

namespace port_runner {

/// A storage format of packs.
struct Format {
  VkFormat vulkan;
  std::string type;  ///< of the NPY file
  std::uint32_t channels, bytes_per_texel;
};

struct Level {
  std::uint32_t width, height;
  std::string file;
};
/// An input or an output of a case.
struct Buffer {
  std::string name;
  bool is_records = false;
  Format format{};            ///< of an image
  std::vector<Level> levels;  ///< of an image, finest first
  std::string record_type;    ///< of records: their NPY type
  std::size_t record_bytes = 0, count = 0;
  std::string file;  ///< of records, or of the finest level
  std::string address_u, address_v, filter, mip_filter;
  std::vector<float> border;
};
struct Case {
  std::string id, pass, formula;
  std::string uniform_file;
  std::size_t uniform_bytes = 0;
  std::vector<Buffer> inputs, outputs;
};
struct Pack {
  fs::path folder;
  std::vector<Case> cases;  ///< in order of execution
};
/// Reads PACK/manifest.json; throws Error naming the key.
Pack read_pack(const fs::path& folder);

/// A specialization constant taken from the manifest: an address rule (clamp 0, repeat 1, border 2, mirror 3), or
/// whether the case has the input (0, 1).
struct Fact {
  std::uint32_t id;
  std::string key, input;  ///< key: address_u, address_v or present
};
struct Program {
  fs::path spirv;
  std::vector<std::string> inputs, outputs;
  std::vector<Fact> constants;
  bool one_group = false;  ///< one workgroup; otherwise one invocation for each texel of the first output
  std::uint32_t group[2] = {8, 8};
  std::uint32_t capacity = 0;  ///< room for records in an output of them
};
/// DIR/bindings.json: formula with revision, as in the manifest, to program. Throws Error naming the key.
std::map<std::string, Program> read_programs(const fs::path& folder);
/// The value of a fact for this case; throws Error.
std::int32_t value(const Fact& fact, const Case& of);

}  // namespace port_runner
