// A pack, as the runner needs it: which bytes a case takes, and what it gives.
#pragma once

#include <cstdint>
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
  std::vector<std::string> reads, writes;  ///< of the pass; a case may lack some
  std::string uniform_file;
  std::size_t uniform_bytes = 0;
  std::vector<Buffer> inputs, outputs;
};
struct Pack {
  fs::path folder;
  std::vector<Case> cases;  ///< in order of execution
};
/// Reads PACK/manifest.json; throws FileError naming the file and the key.
Pack read_pack(const fs::path& folder);

}  // namespace port_runner
