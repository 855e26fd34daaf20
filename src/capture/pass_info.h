// What a pass is, for people, packs and reports: declared once by each effect.
#pragma once

#include <string>
#include <vector>

#include "scene/uniform_block.h"

namespace rainref::capture {

/// A buffer that passes read or write.
struct BufferInfo {
  std::string name;
  std::string format;    ///< a storage format's name, "records", or the scene key that chooses it
  std::string sentence;  ///< meaning of the channels, with units
};

struct PassInfo {
  std::string name;
  std::string sentence;
  std::vector<std::string> variants;  ///< empty: every variant runs it
  std::vector<std::string> reads, writes;
  std::string judge;  ///< envelope, bits, keyed or input_only; with the variant where it differs
  std::vector<scene::UniformBlock> uniforms;
};

/// An effect's passes in the order of execution, its buffers, and the records among them.
struct EffectInfo {
  std::vector<PassInfo> passes;
  std::vector<BufferInfo> buffers;
  std::vector<scene::UniformBlock> records;
};

}  // namespace rainref::capture
